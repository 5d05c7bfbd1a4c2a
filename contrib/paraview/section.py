"""State script for ParaView 5.11 or later: a field of a crush on its deformed section, at the peak of the load.

    pvpython contrib/paraview/section.py out/single-asperity --to peak.png
    pvpython contrib/paraview/section.py out/single-asperity --field plastic-strain --to plastic.png
    paraview --script=contrib/paraview/section.py     # then ASPERITY_RESULTS names the folder, ASPERITY_FIELD the field

Crush with fields first, for example: asperity crush meshes/single-asperity.toml. A body of revolution is mirrored.

The view is that of the program's own picture of one asperity, `section_*.svg`: the same part of the section, the same bands of
colour. Of several asperities it shows what has yielded, not the whole row.
"""

import argparse
import csv
import math
import os
import pathlib
import re
import sys

from paraview import simple

OLDEST = "5.11"
WIDTH = 1200  # dots
KEY = 240  # dots right of the section, for the colour bar
EDGE = 110  # dots around the section, for the axes
# stops of "viridis" and metal that has not yielded, as in the pictures of the program
RISING = ["440154", "472d7b", "3b528b", "2c728e", "21918c", "28ae80", "5ec962", "addc30", "fde725"]
ELASTIC = "dee4ea"


def chosen():
    """The folder of a crush, the field and the picture to write, from the arguments or from the environment."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("results", nargs="?", default=os.environ.get("ASPERITY_RESULTS"), type=pathlib.Path)
    parser.add_argument("--field", choices=FIELDS, default=os.environ.get("ASPERITY_FIELD", "von-mises"))
    parser.add_argument("--to", type=pathlib.Path, help="PNG to write; without it only the view is set up")
    arguments, _ = parser.parse_known_args()
    if arguments.results is None:
        sys.exit("give the folder of a crush, or set ASPERITY_RESULTS to it")
    if not (arguments.results / "fields.pvd").exists():
        sys.exit(
            f"{arguments.results}/fields.pvd is missing: crush a scene with fields (--set output.every=5)"
        )
    return arguments


def peak(folder, times):
    """The last of `times` that lies on the loading branch, and its row of the curve."""
    with open(folder / "curve.csv", newline="") as file:
        rows = {int(row["increment"]): row for row in csv.DictReader(file)}
    # the times of the collection are depths, in the order of its files
    increments = map(int, re.findall(r"fields_(\d+)\.vtu", (folder / "fields.pvd").read_text()))
    loading = [
        (t, i) for t, i in zip(times, increments, strict=True) if rows.get(i, {}).get("phase") == "load"
    ]
    if not loading:
        sys.exit(f"{folder} has no field file of the loading branch")
    time, increment = loading[-1]
    return time, rows[increment]


def colour(text):
    """Red, green and blue from 0 to 1."""
    return [int(text[i : i + 2], 16) / 255 for i in (0, 2, 4)]


def band_colours(count):
    """One colour a band, from the middle of its part of the scale."""
    for i in range(count):
        place = (i + 0.5) / count * (len(RISING) - 1)
        k = min(int(place), len(RISING) - 2)
        low, high = colour(RISING[k]), colour(RISING[k + 1])
        yield [a + (place - k) * (b - a) for a, b in zip(low, high, strict=True)]


def even_edges(largest):
    """Edges of about 26 even bands of 1, 2 or 5 times a power of ten, from 0 to beyond `largest`."""
    power = 10 ** math.floor(math.log10(largest / 26))
    step = next(power * k for k in (1, 2, 5, 10) if largest <= 26 * power * k)
    return [step * i for i in range(math.ceil(largest / step) + 1)]


def strain_edges(largest):
    """Edges that rise by 1, 2, 5 from 0.05 % to beyond `largest`."""
    edges = [0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0]
    return edges[: max(2, 1 + next((i for i, e in enumerate(edges) if e >= largest), len(edges)))]


def paint(display, view, field, title, edges, pale):
    """Colours `display` by `field`, a colour from each edge to the next; `pale`: what is below the first is elastic."""
    table = simple.GetColorTransferFunction(field)
    table.AutomaticRescaleRangeMode = "Never"
    table.ColorSpace, table.Discretize = "RGB", 0
    points = []
    for low, high, band in zip(edges, edges[1:], band_colours(len(edges) - 1), strict=False):
        points += [low + (1e-6 * (high - low) if points else 0.0), *band, high, *band]
    table.RGBPoints = points
    if pale:
        table.UseLogScale = 1
        table.UseBelowRangeColor, table.BelowRangeColor = 1, colour(ELASTIC)
    # ColorBy would stretch the table to the data first, which a logarithmic scale does not bear
    display.ColorArrayName, display.LookupTable = ["POINTS", field], table
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.WindowLocation, bar.Position = "Any Location", [1.0 - 0.8 * KEY / WIDTH, 0.2]
    bar.ScalarBarLength, bar.Orientation = 0.6, "Vertical"
    labels = edges if len(edges) < 14 else edges[:: len(edges) // 6]
    bar.UseCustomLabels, bar.CustomLabels = 1, labels
    bar.AddRangeLabels, bar.AutomaticLabelFormat, bar.LabelFormat = 0, 0, "%-g"
    display.SetScalarBarVisibility(view, True)


def window(body, time):
    """Left, right, lower and upper end of what has yielded, with as much around it as the program's picture shows."""
    left, right, bottom, top, _, _ = body.GetDataInformation().GetBounds()
    limits = left, right, bottom
    yielded = simple.Threshold(Input=body, Scalars=["CELLS", "plastic_zone"])
    yielded.ThresholdMethod, yielded.UpperThreshold = "Above Upper Threshold", 0.5
    yielded.UpdatePipeline(time)
    if yielded.GetDataInformation().GetNumberOfCells():
        left, right, bottom, _, _, _ = yielded.GetDataInformation().GetBounds()
    bottom = max(min(1.15 * bottom, -0.3 * (right - left)), limits[2])
    margin = 0.12 * (right - left)
    left, right = max(left - margin, limits[0]), min(right + margin, limits[1])
    return left, right, bottom, max(top, 0.0) + 0.05 * (right - left)


def look_at(view, ends, names):
    """Puts the window into the view, with axes in µm."""
    left, right, bottom, top = ends
    scale = (WIDTH - KEY - EDGE) / (right - left)  # dots per µm
    height = int(scale * (top - bottom)) + 2 * EDGE
    view.ViewSize = [WIDTH, height]
    view.CameraParallelProjection = 1
    # the key stands right of the section, the axis left of it
    middle = [0.5 * (left + right) + 0.5 * (KEY - EDGE) / scale, 0.5 * (bottom + top), 0.0]
    view.CameraFocalPoint, view.CameraPosition = middle, [*middle[:2], 1.0e4]
    view.CameraParallelScale = 0.5 * height / scale
    grid = view.AxesGrid
    grid.Visibility, grid.ShowGrid = 1, 0
    grid.XTitle, grid.YTitle = names
    grid.UseCustomBounds, grid.CustomBounds = 1, [left, right, bottom, top, 0.0, 0.0]
    grid.AxesToLabel = 3  # the lower and the left one
    for part in ("XTitle", "XLabel", "YTitle", "YLabel"):
        setattr(grid, f"{part}Color", [0.0, 0.0, 0.0])
        setattr(grid, f"{part}FontSize", 16)
    grid.GridColor = [0.0, 0.0, 0.0]


def caption(row, view):
    """Depth and force above the section."""
    unit = "N" if "force_N" in row else "N/mm"
    force = float(row["force_N" if unit == "N" else "force_N_per_mm"])
    text = simple.Text(Text=f"depth {float(row['depth_um']):.3g} µm, force {force:.3g} {unit}")
    shown = simple.Show(text, view)
    shown.Color, shown.FontSize = [0.0, 0.0, 0.0], 18
    shown.WindowLocation = "Upper Left Corner"


def within(body, ends):
    """The part of `body` in the window, so that nothing covers axes and key."""
    left, right, bottom, _ = ends
    # a clip would take quadratic elements for linear ones: cut them finely before
    body = simple.ExtractSurface(Input=body, NonlinearSubdivisionLevel=4)
    for normal, origin in [([1, 0, 0], left), ([-1, 0, 0], right), ([0, 1, 0], bottom)]:
        body = simple.Clip(Input=body, ClipType="Plane", Invert=0)
        body.ClipType.Normal = normal
        body.ClipType.Origin = [origin, origin, 0.0]
    return body


# array of the nodes, title of the key, edges of the bands, whether what has not yielded is pale
FIELDS = {
    "von-mises": ("von_mises_MPa", "von Mises stress (MPa)", even_edges, False),
    "plastic-strain": (
        "plastic_strain",
        "accumulated plastic strain; pale: elastic",
        strain_edges,
        True,
    ),
}


def main():
    if simple.GetParaViewVersion() < tuple(map(int, OLDEST.split("."))):
        sys.exit(f"this is ParaView {simple.GetParaViewVersion()}; {OLDEST} or later is needed")
    arguments = chosen()
    field, title, edges, pale = FIELDS[arguments.field]
    simple._DisableFirstRenderCameraReset()
    reader = simple.PVDReader(FileName=str((arguments.results / "fields.pvd").resolve()))
    reader.UpdatePipelineInformation()
    time, row = peak(arguments.results, list(reader.TimestepValues))
    view = simple.GetActiveViewOrCreate("RenderView")
    simple.GetAnimationScene().AnimationTime = time
    view.ViewTime = time
    view.InteractionMode, view.OrientationAxesVisibility = "2D", 0
    view.UseColorPaletteForBackground, view.Background = 0, [1.0, 1.0, 1.0]
    # the displacement has two components; a warp wants three
    displacement = simple.Calculator(Input=reader, ResultArrayName="moved")
    displacement.Function = "displacement_um_X*iHat + displacement_um_Y*jHat"
    body = simple.WarpByVector(Input=displacement, Vectors=["POINTS", "moved"])
    body.UpdatePipeline(time)
    revolved = "force_N" in row
    if revolved:
        body = simple.Reflect(Input=body, Plane="X", Center=0.0)
        body.UpdatePipeline(time)
    ends = window(body, time)
    shown = within(body, ends)
    shown.UpdatePipeline(time)
    display = simple.Show(shown, view)
    display.Representation = "Surface"
    display.Ambient, display.Diffuse = 1.0, 0.0  # the colours of the key, whatever the light
    paint(display, view, field, title, edges(shown.PointData[field].GetRange()[1]), pale)
    caption(row, view)
    look_at(view, ends, ["r (µm)" if revolved else "x (µm)", "z (µm)"])
    simple.Render(view)
    if arguments.to:
        simple.SaveScreenshot(str(arguments.to), view)
        print(f"written {arguments.to}")


main()
