#!/usr/bin/env python3
"""Draws von Mises stress and the plastic zone of a crush on its deformed section.

    python3 scripts/render.py out/single-asperity -o section.png
    python3 scripts/render.py out/single-asperity --increment last --zoom 2 -o unloaded.png

Needs Python 3.10 or later. Reads `fields.pvd` with PyVista (pip install pyvista, 0.49 or later, which brings VTK and Matplotlib) and draws with
Matplotlib, so that no display and no graphics card is needed. A body of revolution is mirrored at its axis.
"""

import argparse
import csv
import dataclasses
import pathlib
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pyvista as pv
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch, Rectangle
from matplotlib.tri import Triangulation

ELASTIC = "#e8edf2"  # metal that has never yielded
AGAIN = "#d55e00"  # metal that yields again while the tool retreats
FLOWS = 2  # of plastic_zone: 0 never yielded, 1 has yielded, 2 flows now
NEEDED = {"displacement_um", "von_mises_MPa", "plastic_strain", "plastic_zone", "contact_pressure_MPa"}
STRAIN_LEVELS = [0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5]


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("results", type=pathlib.Path, help="folder of a crush, or its fields.pvd")
    parser.add_argument(
        "-o",
        "--output",
        type=pathlib.Path,
        default=pathlib.Path("section.png"),
        help="PNG, SVG or PDF to write",
    )
    parser.add_argument(
        "--increment", default="peak", help="peak (default), last, or the number of a field file"
    )
    parser.add_argument(
        "--zoom", type=float, default=1.0, help="above 1: a smaller part of the section around the contact"
    )
    parser.add_argument("--dpi", type=int, default=160, help="dots per inch of a PNG (default 160)")
    return parser.parse_args()


def read_curve(folder):
    """The rows of curve.csv by increment; empty where there is none."""
    path = folder / "curve.csv"
    if not path.exists():
        return {}
    with open(path, newline="") as file:
        return {int(row["increment"]): row for row in csv.DictReader(file)}


def increments_of(path):
    """Increments of the field files of a collection, in the order of its times."""
    return [int(number) for number in re.findall(r"fields_(\d+)\.vtu", path.read_text())]


def choose(increments, wanted, curve):
    """The place of the increment to draw among those that have a field file."""
    if wanted == "last":
        return len(increments) - 1
    if wanted == "peak":
        loading = [k for k, i in enumerate(increments) if curve.get(i, {}).get("phase", "load") == "load"]
        return loading[-1] if loading else len(increments) - 1
    if wanted.isdigit() and int(wanted) in increments:
        return increments.index(int(wanted))
    sys.exit(
        f"there are no fields of increment {wanted}: choose peak, last or one of {', '.join(map(str, increments))}"
    )


def cell_outlines(mesh):
    """A polyline around each cell, curved sides by five points."""
    s = np.linspace(0.0, 1.0, 5)[:, None]
    lines = []
    for cell in mesh.cell:
        points = cell.points[:, :2]
        for k in range(4):
            a, b = points[k], points[(k + 1) % 4]
            middle = points[4 + k] if len(points) == 8 else 0.5 * (a + b)
            lines.append((1 - s) * (1 - 2 * s) * a + 4 * s * (1 - s) * middle + s * (2 * s - 1) * b)
    return lines


@dataclasses.dataclass
class Section:
    """The deformed section, cut into flat triangles; of a body of revolution both halves."""

    triangulation: Triangulation
    stress: np.ndarray  # von Mises at the points, MPa
    strain: np.ndarray  # accumulated plastic strain at the points
    zone: np.ndarray  # of each triangle: 0 never yielded, 1 has yielded, 2 flows now
    outlines: list  # a polyline for each side of each element
    tool: float | None  # height of the tool's face, None out of contact
    centre: float  # the part to draw: its middle,
    size: float  # half its width,
    top: float
    bottom: float

    def inside(self):
        """Which points lie in the part to draw."""
        x, y = self.triangulation.x, self.triangulation.y
        return (np.abs(x - self.centre) < self.size) & (y > self.bottom)


def window(deformed, zone, revolved, zoom):
    """Centre, half width and lowest height of the part to draw: what has yielded or is pressed, and its surroundings."""
    pressed = deformed.points[deformed.point_data["contact_pressure_MPa"] > 0]
    if (zone > 0).any():
        low, high, bottom, *_ = deformed.extract_cells(np.flatnonzero(zone > 0)).bounds
        margin = 1.25
    elif len(pressed):
        low, high, bottom, margin = pressed[:, 0].min(), pressed[:, 0].max(), 0.0, 2.5
    else:
        low, high, bottom, _, *_ = deformed.bounds
        margin = 1.0
    if revolved:
        low = -high
    size = max(margin * 0.5 * (high - low), -1.05 * bottom) / zoom
    size = min(size, max(deformed.bounds[1], -deformed.bounds[2]))
    return 0.5 * (low + high), size, -size


def colour_bar(axis, filled, label):
    """A colour bar exactly as high as the picture beside it."""
    bar = axis.figure.colorbar(filled, cax=axis.inset_axes([1.015, 0.0, 0.025, 1.0]))
    bar.set_label(label)
    return bar


def section(mesh, revolved, zoom):
    """The section of a field file."""
    deformed = mesh.copy()
    deformed.points = deformed.points + mesh.point_data["displacement_um"]
    centre, size, bottom = window(deformed, mesh.cell_data["plastic_zone"], revolved, zoom)
    surface = deformed.extract_surface(nonlinear_subdivision=3, algorithm=None).triangulate()
    points, triangles = surface.points[:, :2], surface.faces.reshape(-1, 4)[:, 1:]
    values = [surface.point_data["von_mises_MPa"], surface.point_data["plastic_strain"]]
    values.append(surface.cell_data["plastic_zone"])
    outlines = cell_outlines(deformed)
    if revolved:
        triangles = np.vstack([triangles, triangles[:, ::-1] + len(points)])
        points = np.vstack([points, points * [-1.0, 1.0]])
        values = [np.tile(v, 2) for v in values]
        outlines = outlines + [line * [-1.0, 1.0] for line in outlines]
    pressed = deformed.points[mesh.point_data["contact_pressure_MPa"] > 0, 1]
    triangulation = Triangulation(points[:, 0], points[:, 1], triangles)
    tool = pressed.max() if len(pressed) else None
    top = max(deformed.bounds[3], 0.0) + 0.1 * size
    return Section(triangulation, *values, outlines, tool, centre, size, top, bottom)


def draw_stress(axis, cut):
    """Von Mises stress as filled contours."""
    levels = np.linspace(0.0, cut.stress[cut.inside()].max(), 41)
    filled = axis.tricontourf(cut.triangulation, cut.stress, levels=levels, cmap="magma")
    bar = colour_bar(axis, filled, "von Mises stress (MPa)")
    bar.set_ticks(matplotlib.ticker.MaxNLocator(6).tick_values(0.0, levels[-1])[:-1])


def draw_plastic_zone(axis, cut, unloading):
    """The plastic zone by its accumulated strain; hatched where metal yields again while the tool retreats."""
    plain = ListedColormap([ELASTIC])
    axis.tripcolor(cut.triangulation, facecolors=np.zeros(len(cut.zone)), cmap=plain)
    largest = max(cut.strain[cut.inside()].max(), STRAIN_LEVELS[1])
    levels = [level for level in STRAIN_LEVELS if level <= largest]
    norm = BoundaryNorm([*levels, 10 * levels[-1]], 256)
    style = {"levels": levels, "norm": norm, "cmap": "viridis_r", "extend": "max"}
    bar = colour_bar(
        axis, axis.tricontourf(cut.triangulation, cut.strain, **style), "accumulated plastic strain (%)"
    )
    bar.set_ticks(levels, labels=[f"{100 * level:g}" for level in levels])
    least = f"elastic, or below {100 * levels[0]:g} %"
    legend = [Patch(facecolor=ELASTIC, edgecolor="#b8c2cc", label=least)]
    if unloading and (cut.zone == FLOWS).any():
        t = cut.triangulation
        flowing = Triangulation(t.x, t.y, t.triangles[cut.zone == FLOWS])
        style = {"levels": [0.5, 1.5], "colors": "none", "hatches": ["////"]}
        axis.tricontourf(flowing, np.ones(len(t.x)), **style).set_edgecolor(AGAIN)
        legend.append(
            Patch(facecolor="white", edgecolor=AGAIN, hatch="////", label="yields again in unloading")
        )
    axis.legend(handles=legend, loc="lower right", framealpha=0.95)


def draw_frame(axis, cut, ink):
    """Element sides, the tool, and the axes."""
    axis.add_collection(LineCollection(cut.outlines, colors=ink, linewidths=0.5))
    left, right = cut.centre - cut.size, cut.centre + cut.size
    if cut.tool is not None:
        style = {"color": "#9aa3ad", "zorder": 3, "linewidth": 0}
        axis.add_patch(Rectangle((left, cut.tool), right - left, cut.top - cut.tool, **style))
        middle = 0.5 * (cut.tool + cut.top)
        axis.text(cut.centre, middle, "rigid tool", ha="center", va="center", color="white", zorder=4)
    axis.set(aspect="equal", xlim=(left, right), ylim=(cut.bottom, cut.top), ylabel="z (µm)")
    axis.spines[["top", "right"]].set_visible(False)


def draw(cut, unloading, title, x_label):
    """The figure: stress, and below it the plastic zone where there is one."""
    plt.rcParams.update({"font.size": 11, "font.family": "sans-serif", "hatch.linewidth": 0.6})
    panels = 2 if (cut.zone > 0).any() else 1
    height = 8.0 * (cut.top - cut.bottom) / (2 * cut.size)
    size = (9.6, panels * (height + 0.5) + 0.7)
    figure, axes = plt.subplots(panels, 1, figsize=size, layout="constrained", sharex=True, squeeze=False)
    axes = axes[:, 0]
    draw_stress(axes[0], cut)
    draw_frame(axes[0], cut, "#ffffff30")
    if panels == 2:
        draw_plastic_zone(axes[1], cut, unloading)
        draw_frame(axes[1], cut, "#00000020")
    axes[0].set_title(title, loc="left", fontsize=12)
    axes[-1].set_xlabel(x_label)
    return figure


def caption(row):
    """Depth and force of a row of the curve."""
    if not row:
        return ""
    unit = "N" if "force_N" in row else "N/mm"
    force = float(row["force_N"] if unit == "N" else row["force_N_per_mm"])
    verb = "unloading" if row["phase"] == "unload" else "loading"
    return f"{verb}: depth {float(row['depth_um']):.3g} µm, force {force:.3g} {unit}"


def main():
    args = arguments()
    path = args.results / "fields.pvd" if args.results.is_dir() else args.results
    if not path.exists():
        sys.exit(f"{path} is missing: crush a scene with fields, for example --set output.every=5")
    curve = read_curve(path.parent)
    reader = pv.get_reader(str(path))
    increments = increments_of(path)
    place = choose(increments, args.increment, curve)
    reader.set_active_time_point(place)
    mesh = reader.read()[0]
    missing = sorted(NEEDED - set(mesh.array_names))
    if missing:
        sys.exit(f"the fields lack {', '.join(missing)}: name them in [output] fields")
    row = curve.get(increments[place], {})
    revolved = "force_N_per_mm" not in row and mesh.bounds[0] > -1e-6
    cut = section(mesh, revolved, args.zoom)
    figure = draw(cut, row.get("phase") == "unload", caption(row), "r (µm)" if revolved else "x (µm)")
    figure.savefig(args.output, dpi=args.dpi, bbox_inches="tight")
    print(f"written {args.output}")


if __name__ == "__main__":
    main()
