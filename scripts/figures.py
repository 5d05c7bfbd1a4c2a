#!/usr/bin/env python3
"""Draws Fig. 6 of the paper (three sets of four asperities) and the claims of its section 3.2.

    for s in slopes-1-4 slopes-5-8 slopes-9-12; do
        cargo run --release -- crush meshes/$s.toml; cargo run --release -- crush meshes/$s-plane-strain.toml
    done
    python3 scripts/figures.py out --to fig6.png
    cargo run --release -p asperity-verification --example several -- approach.csv
    python3 scripts/figures.py --approach approach.csv --to approach.svg

Needs Python 3.10 and matplotlib 3.8 or later. Prints a table of works and elastic shares, and whether each statement of the paper is
borne out. Elastic zones under total crushing (Fig. 5) are drawn by scripts/render.py from the fields of a crush.
"""

import argparse
import csv
import json
import pathlib
import sys

SETS = [
    ("slopes-1-4", "1-4° ground", "#0072b2", "-"),
    ("slopes-5-8", "5-8° milled", "#d55e00", "--"),
    ("slopes-9-12", "9-12° sanded", "#009e73", ":"),
]
SYMMETRIES = [
    ("", "axisymmetric: a cone and rings", "N"),
    ("-plane-strain", "plane strain: parallel ridges", "N/mm"),
]


def curve(folder: pathlib.Path) -> tuple[list[float], list[float]]:
    """Depth (um) and force of a crush, loading then unloading."""
    with open(folder / "curve.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    force = next(key for key in rows[0] if key.startswith("force"))
    return [float(r["depth_um"]) for r in rows], [float(r[force]) for r in rows]


def total_work(summary: dict) -> float:
    return next(value for key, value in summary.items() if key.startswith("total_work"))


def statements(works: list[float], shares: list[float]) -> list[tuple[str, bool]]:
    """The statements of section 3.2 on the three sets, in order of slope."""
    return [
        (
            "the plastic share grows with the slope",
            all(a > b for a, b in zip(shares, shares[1:], strict=False)),
        ),
        ("the total work falls with the slope", all(a > b for a, b in zip(works, works[1:], strict=False))),
        ("elastic work outweighs plastic work in every set", all(share > 0.5 for share in shares)),
    ]


def draw_approach(pyplot, path: pathlib.Path, to: pathlib.Path) -> None:
    """Three ridges over three times one, against the pitch in depths of the substrate."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    figure, axis = pyplot.subplots(figsize=(5.6, 4.0), constrained_layout=True)
    marks = zip(["#0072b2", "#d55e00", "#009e73"], ["o", "s", "^"], strict=True)
    for depth, (colour, mark) in zip(sorted({float(r["depth_um"]) for r in rows}), marks, strict=False):
        own = [r for r in rows if float(r["depth_um"]) == depth]
        axis.semilogy(
            [float(r["pitch_over_depth"]) for r in own],
            [100 * float(r["difference"]) for r in own],
            color=colour,
            marker=mark,
            label=f"substrate {depth:.0f} µm deep",
        )
    axis.axhline(1, color="grey", linewidth=0.8, linestyle="--")
    axis.set(xlabel="pitch over depth of the substrate", ylabel="|F₃/(3 F₁) - 1|, largest (%)")
    axis.grid(alpha=0.3, which="both")
    axis.legend(frameon=False)
    figure.savefig(to, dpi=150)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "results",
        type=pathlib.Path,
        nargs="?",
        default=pathlib.Path("out"),
        help="folder that holds slopes-1-4, slopes-5-8, … (default out)",
    )
    parser.add_argument("--approach", type=pathlib.Path, help="draw this table of three ridges instead")
    parser.add_argument("--to", type=pathlib.Path, default=pathlib.Path("fig6.png"), help="picture to write")
    arguments = parser.parse_args()
    try:
        import matplotlib
    except ImportError:
        print("matplotlib is missing: python3 -m pip install 'matplotlib>=3.8'", file=sys.stderr)
        return 1
    matplotlib.use("Agg")
    from matplotlib import pyplot

    if arguments.approach:
        draw_approach(pyplot, arguments.approach, arguments.to)
        print(f"written {arguments.to}")
        return 0
    figure, axes = pyplot.subplots(1, 2, figsize=(11, 4.4), constrained_layout=True)
    print("| set | symmetry | total work | elastic share |\n|-|-|-|-|")
    verdicts = []
    for axis, (suffix, title, unit) in zip(axes, SYMMETRIES, strict=True):
        works, shares = [], []
        for name, label, colour, style in SETS:
            folder = arguments.results / (name + suffix)
            if not (folder / "curve.csv").exists():
                print(
                    f"{folder}/curve.csv is missing: crush meshes/{name}{suffix}.toml first", file=sys.stderr
                )
                return 1
            depth, force = curve(folder)
            axis.plot(depth, force, color=colour, linestyle=style, label=label)
            summary = json.loads((folder / "summary.json").read_text())
            works.append(total_work(summary))
            shares.append(summary["elastic_fraction"])
            print(
                f"| {label} | {title} | {works[-1]:.4g} µJ{'' if unit == 'N' else '/mm'} | {100 * shares[-1]:.1f} % |"
            )
        verdicts += [(title, text, holds) for text, holds in statements(works, shares)]
        axis.set(
            xlabel="depth h (µm)", ylabel=f"force F ({unit})", title=title, xlim=(0, None), ylim=(0, None)
        )
        axis.grid(alpha=0.3)
        axis.legend(frameon=False)
    for title, text, holds in verdicts:
        print(f"{title}: {text}: {'borne out' if holds else 'contradicted'}")
    figure.savefig(arguments.to, dpi=150)
    print(f"written {arguments.to}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
