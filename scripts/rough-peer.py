#!/usr/bin/env python3
"""Compares `asperity rough` with the boundary-element code tamaas on eight self-affine maps, and its closures with its half-space.

    python3 scripts/rough-peer.py [--pixels 512] [--large 2048] [--binary PROGRAM] [--out FILE]

Needs Python 3.10, numpy 1.24, scipy 1.10 and tamaas 2.7 or later (pip install numpy scipy tamaas); measured with tamaas 2.9.0.
About seven minutes of one core. Seconds are CPU seconds of one thread: of the solver alone for tamaas, of the whole run with
reading and writing for `asperity rough`, one after the other. Maps: rms slope 0.1, periodic, shortest wave 16 pixels, E* = 1 GPa
in both programs; Hurst exponent, roll-off and load differ. Both solve the same pixels, so that areas differ by convergence
alone: tamaas' elastic solver stops at --tolerance, its saturated one (Kato's) at --saturated-tolerance or its iterations, and
the residual is computed here from its pressures, by the formula of docs/src/theory/half-space.md. One map is solved on --large
points too, the saturated one in --large-iterations at most, which leaves it less converged than ours: the ratio is a lower
bound. The last tables are memory and seconds of the program alone, on maps that it makes itself, and the area of every
closure over that of the half-space with the same metal, from `--judge`.
"""

import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import time

# before numpy and tamaas read it: seconds are those of one thread
os.environ["OMP_NUM_THREADS"] = os.environ["RAYON_NUM_THREADS"] = "1"

import numpy as np
import tamaas as tm

ROOT = pathlib.Path(__file__).resolve().parent.parent
MODULUS = 1e9  # E*, Pa
POISSON = 0.3
PIXEL = 1e-6  # m
SLOPE = 0.1
HARDNESS = 3.0  # over the nominal pressure, of the saturated comparison
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
# of those, the ones that are solved with a limit of pressure, and the one that is solved on many points
SATURATED = [1, 2]
LARGE = 1
# name, bound, and the scene that a row of the last table measures: pixels, closure, judge, leak
COSTS = [
    ("all closures and the judge, 1024² periodic, s", 4, 1024, "all", "true", "false"),
    ("leak, 2048² periodic, from heights to flux, s", 30, 2048, "half-space", "false", "true"),
    ("memory, 4096² periodic, GB", 2, 4096, "half-space", "false", "false"),
]


def surface(n, hurst, rolloff, seed):
    """Heights in units of the period, of rms slope 0.1."""
    generator = tm.SurfaceGeneratorFilter2D([n, n])
    spectrum = tm.Isopowerlaw2D()
    spectrum.q0, spectrum.q1, spectrum.q2, spectrum.hurst = rolloff, rolloff, n // 16, hurst
    generator.spectrum, generator.random_seed = spectrum, seed
    z = generator.buildSurface()
    return z * SLOPE / tm.Statistics2D.computeSpectralRMSSlope(z)


def residual(z, model, pressure, limit):
    """How far pressures are from complementarity: the sum of p|g| over the load times the rms height."""
    n = z.shape[0]
    p = np.asarray(model.traction).clip(0.0, limit)
    p *= pressure / p.mean()
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(n, 1 / n)[:, None], np.fft.rfftfreq(n, 1 / n))
    q[0, 0] = np.inf
    gap = np.fft.irfft2(2 / q * np.fft.rfft2(p), s=z.shape) - z
    gap -= gap[(p > 0) & (p < limit * (1 - 1e-9))].mean()
    below = (gap < 0) & (p < limit * (1 - 1e-9))
    wrong = (p * gap)[gap > 0].sum() - (np.maximum(p, p[p > 0].mean()) * gap)[below].sum()
    return wrong / (p.sum() * z.std())


def solve(z, pressure, tolerance, iterations, limit=np.inf):
    """Contact area ratio, residual and CPU seconds of tamaas; pressure and its limit in E*."""
    n = z.shape[0]
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    start = time.process_time()
    if np.isinf(limit):
        kind = tm.PolonskyKeerRey.pressure
        solver = tm.PolonskyKeerRey(model, z, tolerance, kind, kind)
    else:
        solver = tm.KatoSaturated(model, z, tolerance, limit)
    solver.max_iter = iterations
    solver.solve(pressure)
    seconds = time.process_time() - start
    return float((np.asarray(model.traction) > 0).mean()), residual(z, model, pressure, limit), seconds


def run(binary, scene, folder):
    """Rows of table.csv by closure, CPU seconds and largest memory in GB of one run of `asperity rough`."""
    (folder / "scene.toml").write_text(scene)
    command = [binary, "rough", folder / "scene.toml", "--out", folder / "out", "--force", "--quiet"]
    with subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL) as process:
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"asperity rough ended with {process.returncode}")
    with open(folder / "out/table.csv") as table:
        rows = {row["closure"]: row for row in csv.DictReader(table)}
    return rows, used.ru_utime + used.ru_stime, used.ru_maxrss * 1e-6


def scene(closure, surface, pressure, judge="false", leak="false"):
    """A scene of the metal of the comparison; pressure in E*."""
    return (
        f'closure = "{closure}"\njudge = {judge}\n[surface]\nperiodic = true\n{surface}[material]\n'
        f'youngs_modulus = "{MODULUS * (1 - POISSON**2)} Pa"\npoissons_ratio = {POISSON}\n'
        f'hardness = "{HARDNESS * pressure * MODULUS} Pa"\n[load]\npressure = "{pressure * MODULUS} Pa"\n'
        f"[output]\nmaps = false\n[half_space]\nload_points = 1\nleak = {leak}\n"
    )


def asperity(flags, z, pressure, closure, judge="false"):
    """Rows of table.csv by closure, and CPU seconds of the whole run."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        np.save(folder / "z.npy", z * z.shape[0] * PIXEL)
        surface = 'file = "z.npy"\npixel_size = ["1 um", "1 um"]\nheight_unit = "m"\nlevel = "mean"\n'
        return run(flags.binary, scene(closure, surface, pressure, judge), folder)[:2]


def compared(flags, k, n, law, iterations):
    """A row of the comparison with tamaas."""
    hurst, rolloff, load = MAPS[k]
    z, pressure = surface(n, hurst, rolloff, flags.seed + k), load * SLOPE
    limit = HARDNESS * pressure if law == "saturated" else np.inf
    closure = "half-space-plastic" if law == "saturated" else "half-space"
    tolerance = flags.saturated_tolerance if law == "saturated" else flags.tolerance
    ours, own = asperity(flags, z, pressure, closure)
    found, reached = (float(ours[closure][key]) for key in ["contact_area_ratio", "residual"])
    area, error, seconds = solve(z, pressure, tolerance, iterations, limit)
    return (
        f"| {n}² no. {k + 1} | {hurst} | {rolloff} | {load} | {law} | {area:.5f} | {found:.5f} | "
        f"{100 * (found / area - 1):+.4f} % | {error:.1e} | {reached:.1e} | {seconds:.1f} | {own:.2f} | {seconds / own:.0f} |"
    )


def judged(flags, k, n):
    """A row of areas over that of the half-space."""
    hurst, rolloff, load = MAPS[k]
    every, _ = asperity(flags, surface(n, hurst, rolloff, flags.seed + k), load * SLOPE, "all", "true")
    closures = ["published", "fitted", "johnson", "sneddon"]
    ratios = [every.get(c, {}).get("area_over_half_space") for c in closures]
    shown = " | ".join(f"{float(r):.2f}" if r else "-" for r in ratios)
    return f"| {n}² no. {k + 1} | {hurst} | {rolloff} | {load} | {HARDNESS} | {shown} |"


def cost(flags, name, bound, n, closure, judge, leak):
    """A row of what the program alone needs, on a map that it makes itself with the slope of the others."""
    surface = (
        f'[surface.generate]\nkind = "self-affine"\nhurst = 0.8\nrolloff = "{n // 4} um"\ncutoff = "16 um"\n'
        f'mean_slope_deg = 5\nsize = ["{n} um", "{n} um"]\npixels = [{n}, {n}]\nseed = 1\n'
    )
    with tempfile.TemporaryDirectory() as folder:
        text = scene(closure, surface, 0.02 * SLOPE, judge, leak)
        _, seconds, memory = run(flags.binary, text, pathlib.Path(folder))
    return f"| {name} | {memory if name.startswith('memory') else seconds:.2f} | {bound} |"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--pixels", type=int, default=512)
    parser.add_argument("--large", type=int, default=2048, help="pixels of the map that shows the speed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tolerance", type=float, default=1e-8, help="of the elastic solver")
    parser.add_argument("--iterations", type=int, default=3000)
    parser.add_argument("--saturated-tolerance", type=float, default=1e-6)
    parser.add_argument("--large-iterations", type=int, default=200, help="of the saturated solver")
    parser.add_argument("--binary", type=pathlib.Path, default=ROOT / "target/release/asperity")
    parser.add_argument("--out", type=pathlib.Path, help="file for the tables")
    flags = parser.parse_args()
    report = []

    def say(lines):
        for line in lines:
            report.append(line)
            print(line, flush=True)

    # first, before this process has grown: what a child starts with counts as its memory
    costs = [cost(flags, *words) for words in COSTS]
    say(
        [
            "| map | H | roll-off | p/(E* h') | law | A/A0 tamaas | A/A0 half-space | difference | residual tamaas | residual half-space | s tamaas | s asperity | ratio |",
            "|-|-|-|-|-|-|-|-|-|-|-|-|-|",
        ]
    )
    for k in range(len(MAPS)):
        say([compared(flags, k, flags.pixels, "elastic", flags.iterations)])
    for k in SATURATED:
        say([compared(flags, k, flags.pixels, "saturated", flags.iterations)])
    say([compared(flags, LARGE, flags.large, "elastic", flags.iterations)])
    say([compared(flags, LARGE, flags.large, "saturated", flags.large_iterations)])
    say(["", "What the program needs, one core:", "", "| | measured | at most |", "|-|-|-|", *costs])
    say(["", "Area of a closure over that of the half-space with the same metal:", ""])
    say(
        [
            "| map | H | roll-off | p/(E* h') | H/p | published | fitted | johnson | sneddon |",
            "|-|-|-|-|-|-|-|-|-|",
        ]
    )
    for k in range(len(MAPS)):
        say([judged(flags, k, flags.pixels)])
    if flags.out:
        program = subprocess.run([flags.binary, "--version"], check=True, capture_output=True, text=True)
        said = f"`scripts/rough-peer.py`, {program.stdout.strip()}, tamaas {tm.__version__}"
        part = flags.out.with_suffix(".part")
        part.write_text(f"<!-- written by {said} -->\n\n" + "\n".join(report) + "\n")
        part.replace(flags.out)


if __name__ == "__main__":
    main()
