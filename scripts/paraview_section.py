"""The view that the scripts `paraview-*.py` share: a field on the deformed section, at the peak of the load."""

import argparse
import csv
import os
import pathlib
import sys

from paraview import simple


def results_folder():
    """The folder of a crush and the picture to write, from the arguments or from ASPERITY_RESULTS."""
    parser = argparse.ArgumentParser()
    parser.add_argument("results", nargs="?", default=os.environ.get("ASPERITY_RESULTS"), type=pathlib.Path)
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
    """The last of `times` that lies on the loading branch, and whether the body is one of revolution."""
    with open(folder / "curve.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    loading = {int(row["increment"]) for row in rows if row["phase"] == "load"}
    return max((t for t in times if int(t) in loading), default=times[-1]), "force_N" in rows[0]


def main(field, title, colours):
    """Shows `field` of the nodes."""
    arguments = results_folder()
    reader = simple.PVDReader(FileName=str((arguments.results / "fields.pvd").resolve()))
    reader.UpdatePipelineInformation()
    time, revolved = peak(arguments.results, list(reader.TimestepValues))
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewTime = time
    view.ViewSize = [1200, 800]
    view.InteractionMode = "2D"
    view.OrientationAxesVisibility = 0
    # the displacement has two components; a warp wants three
    displacement = simple.Calculator(Input=reader, ResultArrayName="moved")
    displacement.Function = "displacement_um_X*iHat + displacement_um_Y*jHat"
    body = simple.WarpByVector(Input=displacement, Vectors=["POINTS", "moved"])
    if revolved:
        body = simple.Reflect(Input=body, Plane="X", Center=0.0)
    body.UpdatePipeline(time)
    display = simple.Show(body, view)
    display.Representation = "Surface"
    display.NonlinearSubdivisionLevel = 3
    simple.ColorBy(display, ("POINTS", field))
    table = simple.GetColorTransferFunction(field)
    table.ApplyPreset(colours, True)
    display.RescaleTransferFunctionToDataRange(True, False)
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    display.SetScalarBarVisibility(view, True)
    # what has a tenth of the largest value, and as much around it
    threshold = simple.Threshold(
        Input=body, Scalars=["POINTS", field], ThresholdMethod="Above Upper Threshold"
    )
    threshold.UpperThreshold = 0.1 * body.PointData[field].GetRange()[1]
    threshold.UpdatePipeline(time)
    left, right, bottom, top, _, _ = threshold.GetDataInformation().GetBounds()
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [0.5 * (left + right), 0.5 * (bottom + top), 0.0]
    view.CameraPosition = [*view.CameraFocalPoint[:2], 1.0e4]
    view.CameraParallelScale = 0.6 * max(top - bottom, (right - left) / 1.5)
    simple.Render(view)
    if arguments.to:
        simple.SaveScreenshot(str(arguments.to), view)
        print(f"written {arguments.to}")
