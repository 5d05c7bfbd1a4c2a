#!/usr/bin/env python3
"""Measures where each closure of rough contact holds: its area over that of the half-space with the same metal.

    python3 scripts/rough-closures.py [--binary PROGRAM] [--pixels 512] [--out FILE]

Presses seven surfaces (four self-affine ones with several Hurst exponents and roll-offs, the paper's three kinds; mean slope
4 degrees, periodic) by every closure and both half-spaces, at several nominal pressures p and for several metals without
hardening (hardness 3 yield stresses). The first table has, for each closure and each E tan(beta)/Y, the p/(E*h') at which its
area is within 10 % of the half-space's on all surfaces, and the least and greatest ratio over all of them; E* = E/(1 - nu²),
h' = rms gradient. `sneddon` is judged by the elastic half-space, the others by that with the hardness.

Needs Python 3.10 and the build (cargo build --release).
"""

import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
MODULUS = 210e9
POISSON = 0.3
SLOPE = 4.0
STIFFNESS = [3, 10, 30, 100]  # E tan(beta)/Y
LOADS = [0.003, 0.01, 0.03, 0.1]  # p/(E* h')
SURFACES = [
    ("self-affine", "hurst = 0.8", 4),
    ("self-affine", "hurst = 0.8", 16),
    ("self-affine", "hurst = 0.5", 8),
    ("self-affine", "hurst = 0.3", 4),
    ("ground", "", 0),
    ("milled", "", 0),
    ("sanded", "", 0),
]
CLOSURES = ["sneddon", "calibrated", "johnson", "published", "fitted"]
NEAR = 0.1


def scene(kind, extra, waves, pixels):
    """A scene but for its metal and its load."""
    lines = [f'kind = "{kind}"', f"mean_slope_deg = {SLOPE}", extra]
    if waves:
        lines += [f'rolloff = "{pixels / waves} um"', 'cutoff = "16 um"']
    else:
        lines += ['ra = "1 um"']
    generate = "\n".join(line for line in lines if line)
    return (
        'closure = "all"\njudge = true\n[surface]\nperiodic = true\n[surface.generate]\n'
        f'{generate}\nsize = ["{pixels} um", "{pixels} um"]\npixels = [{pixels}, {pixels}]\nseed = 1\n'
        f'[material]\nyoungs_modulus = "{MODULUS} Pa"\npoissons_ratio = {POISSON}\nhardening_exponent = 0\n'
        'yield_stress = "300 MPa"\n[load]\npressure = "1 MPa"\n[output]\nmaps = false\nspectrum = false\n'
    )


def press(program, folder, name, text, stiffness, load, gradient):
    """Rows of table.csv, and the rms gradient of the surface."""
    path = folder / f"{name}.toml"
    path.write_text(text)
    yielding = MODULUS * math.tan(math.radians(SLOPE)) / stiffness
    pressure = load * MODULUS / (1 - POISSON**2) * (gradient or 0.08)
    out = folder / f"{name}-out"
    changes = ["--set", f"material.yield_stress={yielding} Pa", "--set", f"load.pressure={pressure} Pa"]
    if pressure > 2.4 * yielding:
        return None, gradient
    command = [program, "rough", path, *changes, "--out", out, "--force", "--quiet"]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    with open(out / "table.csv", newline="") as file:
        rows = {row["closure"]: row for row in csv.DictReader(file)}
    return rows, json.loads((out / "summary.json").read_text())["rms_gradient"]


def measure(program, pixels):
    """Ratios of area by closure, stiffness and load, one per surface."""
    ratios = {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for k, (kind, extra, waves) in enumerate(SURFACES):
            text = scene(kind, extra, waves, pixels)
            _, gradient = press(program, folder, f"s{k}", text, STIFFNESS[0], LOADS[0], None)
            for stiffness in STIFFNESS:
                for load in LOADS:
                    rows, _ = press(program, folder, f"s{k}", text, stiffness, load, gradient)
                    for closure in CLOSURES if rows else []:
                        value = rows.get(closure, {}).get("area_over_half_space") or "nan"
                        ratios.setdefault((closure, stiffness, load), []).append(float(value))
    return ratios


def table(ratios):
    """Both tables as markdown."""
    text = "| closure | E tan β/Y | within 10 % on all surfaces at p/(E*h') | least to greatest ratio of area |\n|-|-|-|-|\n"
    for closure in CLOSURES:
        for stiffness in STIFFNESS:
            cells = {load: ratios.get((closure, stiffness, load), []) for load in LOADS}
            near = [load for load, v in cells.items() if v and all(abs(r - 1) <= NEAR for r in v)]
            known = [r for v in cells.values() for r in v if not math.isnan(r)]
            if not known:
                continue
            held = ", ".join(f"{load:g}" for load in near) or "none"
            text += f"| `{closure}` | {stiffness} | {held} | {min(known):.2f} to {max(known):.2f} |\n"
    text += "\n## Medians\n\nArea over that of the half-space, median over the surfaces; empty: beyond the metal's hardness, or the closure cannot carry it.\n\n"
    text += "| closure | E tan β/Y | " + " | ".join(f"p/(E*h') {load:g}" for load in LOADS) + " |\n"
    text += "|-|-|" + "-|" * len(LOADS) + "\n"
    for closure in CLOSURES:
        for stiffness in STIFFNESS:
            values = [
                [r for r in ratios.get((closure, stiffness, load), []) if not math.isnan(r)] for load in LOADS
            ]
            shown = " | ".join(f"{statistics.median(v):.2f}" if v else "" for v in values)
            text += f"| `{closure}` | {stiffness} | {shown} |\n"
    return text


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--binary", type=pathlib.Path, default=ROOT / "target/release/asperity")
    parser.add_argument("--pixels", type=int, default=512)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "verification/results/rough-closures.md")
    flags = parser.parse_args()
    version = subprocess.run(
        [flags.binary, "--version"], capture_output=True, text=True, check=True
    ).stdout.strip()
    body = table(measure(flags.binary, flags.pixels))
    first = f"<!-- written by `scripts/rough-closures.py --pixels {flags.pixels}`, {version}, mean slope {SLOPE:g} degrees -->"
    flags.out.write_text(f"{first}\n\n{body}")


if __name__ == "__main__":
    main()
