#!/usr/bin/env python3
"""The exponent m of unloading, F = F_j (1 - u/u_j)^m, from cones that `asperity crush` presses and unloads.

    python3 scripts/unloading-exponent.py [--binary target/release/asperity] [--accuracy draft]

Needs Python 3.10 or later and nothing else.

For a circular contact of radius a the stiffness at the start of unloading is 2 E* a = m F_j/u_j, so m = 2 E* a u_j/F_j with
u_j = depth - residual depth. The measured stiffness over 2 E* a stands beside it: it must be near 1 for that to hold.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

SCENE = """symmetry = "axisymmetric"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
yield_stress = "{yield_stress} MPa"
hardening_exponent = {exponent}
[[asperity]]
height = "20 um"
slope_deg = {slope}
[tool]
shape = "plane"
[loading]
depth = "{depth} um"
unload = true
[output]
every = 0
"""
MODULUS = 210e3 / (1 - 0.3**2)  # E*, MPa


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--slopes", type=float, nargs="+", default=[2, 5, 10])
    parser.add_argument("--accuracy", default="draft")
    parser.add_argument("--binary", default="target/release/asperity")
    flags = parser.parse_args()
    print("| slope, degrees | yield stress, MPa | n | m | stiffness / 2 E* a | elastic share of the work |")
    print("|-|-|-|-|-|-|")
    found = []
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "cone.toml"
        for slope in flags.slopes:
            for stress, exponent in [(300, 0.1), (300, 0.3), (700, 0.3)]:
                depth = 2 * math.tan(math.radians(slope)) / math.tan(math.radians(10))
                values = dict(slope=slope, yield_stress=stress, exponent=exponent, depth=round(depth, 4))
                scene.write_text(SCENE.format(**values))
                command = [
                    flags.binary,
                    "crush",
                    scene,
                    "--accuracy",
                    flags.accuracy,
                    "--out",
                    f"{folder}/out",
                ]
                subprocess.run([*command, "--quiet"], check=True)
                summary = json.loads(pathlib.Path(folder, "out/summary.json").read_text())
                radius = math.sqrt(summary["contact_area_um2"] / math.pi)
                stiffness = 2 * MODULUS * radius * 1e-6  # N/um
                back = summary["peak_depth_um"] - summary["residual_depth_um"]
                m = stiffness * back / summary["peak_force_N"]
                found.append(m)
                measured = summary["unloading_stiffness_N_per_um"] / stiffness
                share = summary["elastic_fraction"]
                print(
                    f"| {slope:g} | {stress} | {exponent} | {m:.3f} | {measured:.3f} | {share:.3f} |",
                    flush=True,
                )
    print(
        f"\nm = {statistics.mean(found):.3f} ± {statistics.stdev(found):.3f} (standard deviation of {len(found)} cones)"
    )


if __name__ == "__main__":
    main()
