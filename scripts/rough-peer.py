#!/usr/bin/env python3
"""Compares `asperity rough` with the boundary-element code tamaas on self-affine maps.

    OMP_NUM_THREADS=1 python3 scripts/rough-peer.py [--sizes 512 1024 2048] [--seeds 1 2 3] [--laws elastic saturated]
        [--out FILE]

Needs Python 3.10, numpy 1.24, scipy 1.10 and tamaas 2.7 or later (pip install numpy scipy tamaas); measured with tamaas 2.9.0 and
numpy 2.4. Seconds are CPU seconds of either program; "times slower" is
those of the boundary elements over those of `asperity rough` with every closure, reading and writing included. Maps: H = 0.8, rms slope 0.1, flat spectrum above a quarter of
the period, cut-off N/16, periodic, E* = 1 GPa in both programs. Elastic: tamaas against published and sneddon (and
fitted where --coefficient names a file). Saturated at H: tamaas' Kato solver against johnson. `calibrated` has no
counterpart there: an elastic or saturated half-space knows no hardening.

The elastic solver stops at --tolerance; 1e-6 instead of 1e-8 moves no printed digit of the area (--tolerance 1e-8 shows).
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
SATURATED_TOLERANCE = 1e-3


def surface(n, seed):
    """Heights in units of the period, of rms slope 0.1."""
    generator = tm.SurfaceGeneratorFilter2D([n, n])
    spectrum = tm.Isopowerlaw2D()
    spectrum.q0, spectrum.q1, spectrum.q2, spectrum.hurst = 4, 4, n // 16, 0.8
    generator.spectrum, generator.random_seed = spectrum, seed
    z = generator.buildSurface()
    return z * 0.1 / tm.Statistics2D.computeSpectralRMSSlope(z)


def solve(z, pressure, tolerance, hardness=None):
    """Contact area ratio and CPU seconds of the boundary-element solution; pressure and hardness in E*."""
    n = z.shape[0]
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    start = time.process_time()
    if hardness is None:
        solver = tm.PolonskyKeerRey(
            model, z, tolerance, tm.PolonskyKeerRey.pressure, tm.PolonskyKeerRey.pressure
        )
        solver.max_iter = 20000
        solver.solve(pressure)
    else:
        # its error falls slowly below 1e-3; the area no longer changes in the third digit
        solver = tm.KatoSaturated(model, z, SATURATED_TOLERANCE, hardness)
        solver.max_iter = 3000
        solver.solve(pressure)
    return float((np.asarray(model.traction) > 0).mean()), time.process_time() - start


def children():
    """CPU seconds of the programs started so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def asperity(binary, z, pressure, hardness, coefficient):
    """Rows of table.csv by closure, and CPU seconds of the whole run."""
    n = z.shape[0]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        np.save(folder / "z.npy", z * n * PIXEL)
        named = f'coefficient = "{pathlib.Path(coefficient).resolve()}"\n' if coefficient else ""
        (folder / "scene.toml").write_text(
            f'closure = "all"\n{named}[surface]\nfile = "z.npy"\npixel_size = ["1 um", "1 um"]\nheight_unit = "m"\nlevel = "mean"\n'
            f'periodic = true\n[material]\nyoungs_modulus = "{MODULUS * (1 - POISSON**2)} Pa"\npoissons_ratio = {POISSON}\n'
            f'hardness = "{hardness * MODULUS} Pa"\n[load]\npressure = "{pressure * MODULUS} Pa"\n[output]\nmaps = false\n'
        )
        before = children()
        subprocess.run(
            [binary, "rough", folder / "scene.toml", "--out", folder / "out", "--quiet"],
            check=True,
            capture_output=True,
        )
        seconds = children() - before
        with open(folder / "out/table.csv") as table:
            return {row["closure"]: row for row in csv.DictReader(table)}, seconds


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024, 2048])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--loads", type=float, nargs="+", default=[0.002, 0.01], help="p/E*")
    parser.add_argument(
        "--laws", nargs="+", choices=["elastic", "saturated"], default=["elastic", "saturated"]
    )
    parser.add_argument("--tolerance", type=float, default=1e-6, help="of the elastic solver")
    parser.add_argument("--hardness", type=float, default=0.03, help="H/E* of the saturated comparison")
    parser.add_argument("--coefficient")
    parser.add_argument("--binary", default="target/release/asperity")
    parser.add_argument("--out", type=pathlib.Path, help="file for the table")
    flags = parser.parse_args()
    report = [
        "| map | seed | p/E* | law | A/A0 BEM | closure | A/A0 | over BEM | P_m over BEM | s BEM | s all closures | times slower |",
        "|-|-|-|-|-|-|-|-|-|-|-|-|",
    ]
    print("\n".join(report))
    for n in flags.sizes:
        for seed in flags.seeds:
            z = surface(n, seed)
            for pressure in flags.loads:
                ours, own = asperity(flags.binary, z, pressure, flags.hardness, flags.coefficient)
                for law in flags.laws:
                    hardness = flags.hardness if law == "saturated" else None
                    name = law if hardness is None else f"saturated at {hardness} E*"
                    closures = ["published", "fitted", "sneddon"] if hardness is None else ["johnson"]
                    area, seconds = solve(z, pressure, flags.tolerance, hardness)
                    for closure in (c for c in closures if c in ours):
                        found = float(ours[closure]["contact_area_ratio"])
                        report.append(
                            f"| {n}² | {seed} | {pressure} | {name} | {area:.4f} | {closure} | {found:.4f} | {found / area:.2f} | "
                            f"{area / found:.2f} | {seconds:.1f} | {own:.2f} | {seconds / own:.0f} |"
                        )
                        print(report[-1], flush=True)
    if flags.out:
        part = flags.out.with_suffix(".part")
        said = f"`scripts/rough-peer.py`, tamaas {tm.__version__}"
        part.write_text(f"<!-- written by {said} -->\n\n" + "\n".join(report) + "\n")
        part.replace(flags.out)


if __name__ == "__main__":
    main()
