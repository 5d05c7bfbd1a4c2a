#!/usr/bin/env python3
"""Presses random lines of ridges by plane-strain finite elements, by a half-space uniform along one axis, and by the closures.

    python3 scripts/rough-ridges.py [--seeds 5] [--accuracy draft] [--binary PROGRAM] [--out FILE]

A line of 400 um is a sum of cosines of random amplitude (Hurst exponent 0.8, waves of 20 to 80 um), so that it repeats as its
own mirror image: the finite elements get it as [[profile]] between frictionless walls, the others as a map of the line and its
image, 0.05 um between points, in a few equal rows. Mean slope 4 degrees; steel, elastic, perfectly plastic and hardening. All
carry the same force. A row of the first table is one line and metal; ridges touch where their force is above 0, the mean gap is
that of the plane to the surface outside the contact and in it. The second is the contact width of every closure over that of
the finite elements, least to greatest over the lines.

Needs Python 3.10, numpy 1.24 and the build (cargo build --release).
"""

import argparse
import csv
import json
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
LENGTH = 400.0  # um
POINTS = 8000
WAVES = np.arange(10, 41)  # half waves a line
HURST = 0.8
SLOPE = 4.0  # mean, degrees
ELASTIC = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3}
# name, metal, nominal pressure in MPa, closure of the half-space
METALS = [
    ("elastic", ELASTIC, 800, "half-space"),
    (
        "σ_y 300 MPa",
        ELASTIC | {"yield_stress": "300 MPa", "hardening_exponent": 0},
        300,
        "half-space-plastic",
    ),
    (
        "σ_y 300 MPa, n 0.3",
        ELASTIC | {"yield_stress": "300 MPa", "hardening_exponent": 0.3},
        300,
        "half-space-plastic",
    ),
]
CLOSURES = ["published", "fitted", "johnson", "sneddon", "calibrated"]


def line(seed):
    """Places and heights of a line that begins and ends in a valley, as [[profile]] cuts it, um."""
    x = np.linspace(0.0, LENGTH, POINTS + 1)
    waves = np.cos(np.pi * np.outer(x, WAVES) / LENGTH) * WAVES ** -(HURST + 0.5)
    random = np.random.default_rng(seed)
    z = np.ones_like(x)
    while max(z[0], z[-1]) > -0.5 * z.std():
        z = waves @ random.normal(size=WAVES.size)
    return x, z * np.tan(np.radians(SLOPE)) / np.abs(np.gradient(z, x)).mean()


def rows(file):
    """Rows of a csv file."""
    with open(file, newline="") as text:
        return list(csv.DictReader(text))


def run(program, *words):
    """Runs the program, and ends this one where it fails."""
    done = subprocess.run([str(word) for word in (program, *words, "--force", "--quiet")])
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, words))} ended with {done.returncode}")


def material(metal):
    """The table of a scene."""
    lines = [f"{key} = {json.dumps(value)}" for key, value in metal.items()]
    return "[material]\n" + "\n".join(lines) + "\n"


def finite_elements(flags, folder, x, z, metal, pressure):
    """Contact width over length, its stated error, touching ridges, all ridges, and mean gap in um."""
    np.savetxt(folder / "line.csv", np.c_[x, z], delimiter=",", header="x_um,z_um", comments="")
    (folder / "crush.toml").write_text(
        f'symmetry = "plane-strain"\nlateral = "symmetric"\naccuracy = "{flags.accuracy}"\n{material(metal)}'
        f'[[profile]]\nfile = "line.csv"\ntolerance = "1 nm"\n[substrate]\ndepth = "{LENGTH} um"\n'
        f'[tool]\nshape = "plane"\n[loading]\nforce = "{pressure * LENGTH * 1e-3} N/mm"\n'
        '[output]\nevery = 1000000\nfields = ["pressure"]\n'
    )
    out = folder / "crushed"
    run(flags.binary, "crush", folder / "crush.toml", "--out", out)
    summary = json.loads((out / "summary.json").read_text())
    last = max(int(row["increment"]) for row in rows(out / "asperities.csv"))
    ridges = [row for row in rows(out / "asperities.csv") if int(row["increment"]) == last]
    touching = sum(float(row["force_N_per_mm"]) > 0 for row in ridges)
    surface = rows(sorted(out.glob("surface_*.csv"))[-1])
    r, height = (np.array([float(row[name]) for row in surface]) for name in ("r_um", "z_um"))
    gap = (-summary["peak_depth_um"] - height).clip(0.0)
    mean = float((np.diff(r) * (gap[1:] + gap[:-1]) / 2).sum() / (r[-1] - r[0]))
    return (
        summary["contact_width_um"] / LENGTH,
        summary["errors"]["contact_area"],
        touching,
        len(ridges),
        mean,
    )


def others(flags, folder, z, metal, pressure):
    """Rows of table.csv by closure, of the line and its image in equal rows."""
    pixel = LENGTH / POINTS
    np.save(folder / "z.npy", np.tile(np.r_[z[:-1], z[:0:-1]] * 1e-6, (8, 1)))
    (folder / "rough.toml").write_text(
        f'closure = "all"\njudge = true\n[surface]\nfile = "z.npy"\npixel_size = ["{pixel} um", "{pixel} um"]\n'
        f'height_unit = "m"\nlevel = "mean"\nperiodic = true\n{material(metal)}[load]\npressure = "{pressure} MPa"\n'
        "[output]\nmaps = false\nspectrum = false\n[half_space]\nload_points = 1\nleak = false\n"
    )
    run(flags.binary, "rough", folder / "rough.toml", "--out", folder / "pressed")
    return {row["closure"]: row for row in rows(folder / "pressed/table.csv")}


def measured(flags, seed, name, metal, pressure, judge):
    """A row of the first table, and the width of every closure over that of the finite elements."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        x, z = line(seed)
        width, error, touching, ridges, gap = finite_elements(flags, folder, x, z, metal, pressure)
        every = others(flags, folder, z, metal, pressure)
    space = every[judge]
    found, patches, mean = (float(space[key]) for key in ("contact_area_ratio", "asperities", "mean_gap_um"))
    # a patch in the map has its image, unless it lies on a wall
    row = (
        f"| {seed} | {name} | {pressure} | {100 * width:.2f} ± {100 * error * width:.2f} | {100 * found:.2f} | {found / width:.3f} | "
        f"{touching} of {ridges} | {patches / 2:g} | {gap:.3f} | {mean:.3f} | {mean / gap:.3f} |"
    )
    areas = {closure: every.get(closure, {}).get("contact_area_ratio") for closure in CLOSURES}
    return row, {closure: float(area) / width for closure, area in areas.items() if area}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--accuracy", default="draft")
    parser.add_argument("--binary", type=pathlib.Path, default=ROOT / "target/release/asperity")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "verification/results/rough-ridges.md")
    flags = parser.parse_args()
    version = subprocess.run([flags.binary, "--version"], capture_output=True, text=True, check=True)
    text = [
        f"<!-- written by `scripts/rough-ridges.py`, {version.stdout.strip()}, {flags.accuracy} -->",
        "",
        "| line | metal | MPa | width FE, % | width half-space, % | ratio | ridges FE | ridges half-space | mean gap FE, µm | mean gap half-space, µm | ratio |",
        "|-|-|-|-|-|-|-|-|-|-|-|",
    ]
    ratios = {}
    for name, metal, pressure, judge in METALS:
        for seed in range(1, flags.seeds + 1):
            row, closures = measured(flags, seed, name, metal, pressure, judge)
            print(row, flush=True)
            text.append(row)
            for closure, ratio in closures.items():
                ratios.setdefault((closure, name), []).append(ratio)
    text += ["", "## Contact width of the closures over that of the finite elements", ""]
    text += ["| closure | " + " | ".join(name for name, *_ in METALS) + " |", "|-" * (1 + len(METALS)) + "|"]
    for closure in CLOSURES:
        cells = [ratios.get((closure, name)) for name, *_ in METALS]
        shown = " | ".join(f"{min(cell):.2f} to {max(cell):.2f}" if cell else "" for cell in cells)
        text.append(f"| `{closure}` | {shown} |")
    part = flags.out.with_suffix(".part")
    part.write_text("\n".join(text) + "\n")
    part.replace(flags.out)


if __name__ == "__main__":
    main()
