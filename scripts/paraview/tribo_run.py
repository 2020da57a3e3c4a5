# SPDX-License-Identifier: MIT
"""Opens a run of Tribo in ParaView: particles as boxes of their size, coloured by material or by a field, with the time.

As a macro: Macros > Import new macro, then start the macro and choose the file run.pvd, or select it in the pipeline first.
From a shell:  paraview --script=tribo_run.py          with the folder of the run in the variable TRIBO_RUN
               pvpython tribo_run.py FOLDER PICTURE [FIELD [TIME]]    draws a picture
The blocks of the run are named as the materials and their bodies: the inspector "Multi-block" shows and hides them.
"""

import json
import os
import sys

from paraview import simple


def record_of(folder):
    """The record of a run, with units and names; empty if there is none."""
    try:
        with open(os.path.join(folder, "provenance.json"), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def show_as_boxes(display, flat):
    """Draws each particle as a box with the edges of the array `size`."""
    display.SetRepresentationType("3D Glyphs")
    display.GlyphType = "Box"
    display.Scaling = 1
    display.ScaleMode = "Vector Components"
    display.SelectScaleArray = "size"
    display.ScaleFactor = 1.0
    display.Orient = 0
    if flat:  # boxes without thickness have no normals for light
        display.Ambient, display.Diffuse = 1.0, 0.0


def colour_by_material(display, names):
    """Colours by the number of the material, with the names beside the colours."""
    simple.ColorBy(display, ("POINTS", "material"))
    colours = simple.GetColorTransferFunction("material")
    colours.InterpretValuesAsCategories = 1
    colours.AnnotationsInitialized = 1
    annotations, shades = [], []
    palette = [(0.30, 0.45, 0.69), (0.87, 0.52, 0.32), (0.33, 0.66, 0.41), (0.77, 0.31, 0.32), (0.51, 0.45, 0.70),
               (0.58, 0.47, 0.38), (0.85, 0.55, 0.76), (0.55, 0.55, 0.55), (0.80, 0.73, 0.45), (0.39, 0.71, 0.80)]
    for number, name in enumerate(names, 1):
        annotations += [str(number), name]
        shades += palette[(number - 1) % len(palette)]
    if annotations:
        colours.Annotations, colours.IndexedColors = annotations, shades


def open_run(path, field="material"):
    """Shows a run. `path`: its folder or its run.pvd; `field`: `material` or an array of the particles."""
    folder = os.path.dirname(path) if path.endswith(".pvd") else path
    record = record_of(folder or ".")
    reader = simple.PVDReader(registrationName=os.path.basename(os.path.abspath(folder or ".")), FileName=os.path.join(folder, "run.pvd"))
    return show(reader, record, field)


def show(reader, record, field="material"):
    """Shows a reader of a run.pvd."""
    view = simple.GetActiveViewOrCreate("RenderView")
    reader.UpdatePipeline()
    low, high = reader.GetDataInformation().GetBounds()[4:6]
    flat = high - low < 1e-12
    display = simple.Show(reader, view)
    show_as_boxes(display, flat)
    if field == "material":
        colour_by_material(display, record.get("materials", []))
    else:
        simple.ColorBy(display, ("POINTS", field))
        display.RescaleTransferFunctionToDataRange(True, False)
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(simple.GetColorTransferFunction(field), view)
    bar.TitleFontSize = bar.LabelFontSize = 8
    unit = record.get("model", {}).get("unit of time", "")
    label = simple.AnnotateTimeFilter(registrationName="time", Input=reader)
    label.Format = "time {time:g} " + unit
    simple.Show(label, view).FontSize = 8
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    if flat:
        view.InteractionMode = "2D"
    simple.ResetCamera(view)
    simple.SetActiveSource(reader)
    return reader, display, view


def main():
    if len(sys.argv) > 2:  # pvpython
        reader, display, view = open_run(sys.argv[1], *sys.argv[3:4])
        if len(sys.argv) > 4:
            simple.GetAnimationScene().AnimationTime = float(sys.argv[4])
            simple.Render(view)
            if sys.argv[3] != "material":
                display.RescaleTransferFunctionToDataRange(False, True)
            simple.ResetCamera(view)
        simple.SaveScreenshot(sys.argv[2], view, ImageResolution=[1200, 800])
        return
    active = simple.GetActiveSource()
    if active is not None and "run.pvd" in str(getattr(active, "FileName", "")):
        path = str(active.FileName)
        show(active, record_of(os.path.dirname(path)))
    elif os.environ.get("TRIBO_RUN"):
        open_run(os.environ["TRIBO_RUN"])
    else:
        print("Select a run.pvd in the pipeline, or set the variable TRIBO_RUN to the folder of a run.")


main()
