#!/usr/bin/env python3
"""Compares `asperity rough` with the boundary-element code tamaas on eight self-affine maps, and its closures with its half-space.

    OMP_NUM_THREADS=1 RAYON_NUM_THREADS=1 python3 scripts/rough-peer.py [--sizes 512 1024] [--laws elastic saturated] [--out FILE]

Needs Python 3.10, numpy 1.24, scipy 1.10 and tamaas 2.7 or later (pip install numpy scipy tamaas); measured with tamaas 2.9.0.
Seconds are CPU seconds: of the solver alone for tamaas, of the whole run with reading and writing for `asperity rough`. Maps:
rms slope 0.1, periodic, shortest wave 16 pixels, E* = 1 GPa in both programs; Hurst exponent, roll-off and load differ. Both
solve the same pixels, so that areas differ by convergence alone: tamaas' elastic solver stops at --tolerance, its saturated
one (Kato's) at --saturated-tolerance or its iterations, and its own residual is printed. The first table is one line a map and
law; the second the area of every closure over that of the half-space with the same metal, from `--judge`.
"""

import argparse
import csv
import pathlib
import resource
import subprocess
import tempfile
import time

import numpy as np
import tamaas as tm

MODULUS = 1e9  # E*, Pa
POISSON = 0.3
PIXEL = 1e-6  # m
SLOPE = 0.1
# Hurst exponent, roll-off in waves a period, p/(E* h')
MAPS = [
    (0.8, 4, 0.005),
    (0.8, 4, 0.02),
    (0.8, 4, 0.1),
    (0.8, 4, 0.5),
    (0.5, 8, 0.05),
    (0.3, 2, 0.1),
    (0.95, 2, 0.02),
    (0.8, 16, 0.2),
]


def surface(n, hurst, rolloff, seed):
    """Heights in units of the period, of rms slope 0.1."""
    generator = tm.SurfaceGeneratorFilter2D([n, n])
    spectrum = tm.Isopowerlaw2D()
    spectrum.q0, spectrum.q1, spectrum.q2, spectrum.hurst = rolloff, rolloff, n // 16, hurst
    generator.spectrum, generator.random_seed = spectrum, seed
    z = generator.buildSurface()
    return z * SLOPE / tm.Statistics2D.computeSpectralRMSSlope(z)


def solve(z, pressure, flags, hardness=None):
    """Contact area ratio, residual as the solver reports it, and CPU seconds; pressure and hardness in E*."""
    n = z.shape[0]
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    start = time.process_time()
    if hardness is None:
        kind = tm.PolonskyKeerRey.pressure
        solver = tm.PolonskyKeerRey(model, z, flags.tolerance, kind, kind)
        solver.max_iter = 20000
    else:
        solver = tm.KatoSaturated(model, z, flags.saturated_tolerance, hardness)
        solver.max_iter = flags.saturated_iterations
    residual = solver.solve(pressure)
    return float((np.asarray(model.traction) > 0).mean()), residual, time.process_time() - start


def children():
    """CPU seconds of the programs started so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def asperity(binary, z, pressure, hardness, closure, extra=""):
    """Rows of table.csv by closure, and CPU seconds of the whole run."""
    n = z.shape[0]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        np.save(folder / "z.npy", z * n * PIXEL)
        (folder / "scene.toml").write_text(
            f'closure = "{closure}"\n{extra}[surface]\nfile = "z.npy"\npixel_size = ["1 um", "1 um"]\nheight_unit = "m"\nlevel = "mean"\n'
            f'periodic = true\n[material]\nyoungs_modulus = "{MODULUS * (1 - POISSON**2)} Pa"\npoissons_ratio = {POISSON}\n'
            f'hardness = "{hardness * MODULUS} Pa"\n[load]\npressure = "{pressure * MODULUS} Pa"\n[output]\nmaps = false\n'
            f"[half_space]\nload_points = 1\nleak = false\n"
        )
        before = children()
        command = [binary, "rough", folder / "scene.toml", "--out", folder / "out", "--quiet"]
        subprocess.run(command, check=True, capture_output=True)
        seconds = children() - before
        with open(folder / "out/table.csv") as table:
            return {row["closure"]: row for row in csv.DictReader(table)}, seconds


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", type=int, nargs="+", default=[512])
    parser.add_argument(
        "--maps", type=int, nargs="+", default=list(range(len(MAPS))), help="which of the eight"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--laws", nargs="+", choices=["elastic", "saturated"], default=["elastic", "saturated"]
    )
    parser.add_argument("--tolerance", type=float, default=1e-8, help="of the elastic solver")
    parser.add_argument("--saturated-tolerance", type=float, default=1e-5)
    parser.add_argument("--saturated-iterations", type=int, default=3000)
    parser.add_argument("--hardness", type=float, default=3.0, help="H over p, of the saturated comparison")
    parser.add_argument("--binary", default="target/release/asperity")
    parser.add_argument("--out", type=pathlib.Path, help="file for the tables")
    flags = parser.parse_args()
    report = [
        "| map | H | roll-off | p/(E* h') | law | A/A0 tamaas | A/A0 half-space | difference | residual tamaas | residual half-space | s tamaas | s asperity | ratio |",
        "|-|-|-|-|-|-|-|-|-|-|-|-|-|",
    ]
    judged = [
        "| map | H | roll-off | p/(E* h') | H/p | published | fitted | johnson | sneddon | s all and judge |",
        "|-|-|-|-|-|-|-|-|-|-|",
    ]
    print("\n".join(report), flush=True)
    for n in flags.sizes:
        for k in flags.maps:
            hurst, rolloff, load = MAPS[k]
            z = surface(n, hurst, rolloff, flags.seed + k)
            pressure = load * SLOPE
            hardness = flags.hardness * pressure
            name = f"| {n}² no. {k + 1} | {hurst} | {rolloff} | {load} |"
            for law in flags.laws:
                limit = hardness if law == "saturated" else None
                closure = "half-space" if limit is None else "half-space-plastic"
                alone = "judge = false\n"
                ours, own = asperity(flags.binary, z, pressure, hardness, closure, alone)
                found, residual = (float(ours[closure][key]) for key in ["contact_area_ratio", "residual"])
                area, error, seconds = solve(z, pressure, flags, limit)
                report.append(
                    f"{name} {law} | {area:.5f} | {found:.5f} | {100 * (found / area - 1):+.3f} % | {error:.1e} | {residual:.1e} | "
                    f"{seconds:.1f} | {own:.2f} | {seconds / own:.0f} |"
                )
                print(report[-1], flush=True)
            every, seconds = asperity(flags.binary, z, pressure, hardness, "all", "judge = true\n")
            ratios = [
                every.get(c, {}).get("area_over_half_space")
                for c in ["published", "fitted", "johnson", "sneddon"]
            ]
            shown = " | ".join(f"{float(r):.2f}" if r else "-" for r in ratios)
            judged.append(f"{name} {flags.hardness} | {shown} | {seconds:.2f} |")
    report += ["", "Area of a closure over that of the half-space with the same metal:", "", *judged]
    print("\n".join(report[-len(judged) - 3 :]), flush=True)
    if flags.out:
        part = flags.out.with_suffix(".part")
        said = f"`scripts/rough-peer.py`, tamaas {tm.__version__}"
        part.write_text(f"<!-- written by {said} -->\n\n" + "\n".join(report) + "\n")
        part.replace(flags.out)


if __name__ == "__main__":
    main()
