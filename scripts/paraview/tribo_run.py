# SPDX-License-Identifier: MIT
"""Opens a run of Tribo in ParaView: particles as boxes of their size, coloured by material or by a field, rigid blocks, cracks
and joints if there are any, and the time.

As a macro: Macros > Import new macro, select the file run.pvd (blocks.pvd of a run of blocks alone) in the pipeline, start the macro.
From a shell:  paraview --script=tribo_run.py          with the folder of the run in the variable TRIBO_RUN
               pvpython tribo_run.py FOLDER PICTURE [FIELD [TIME]]    draws a picture
The blocks of the run are named as the materials and their bodies: the inspector "Multi-block" shows and hides them.
"""

import html
import json
import os
import re
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


def colour_by_material(display, names, used):
    """Colours by the number of the material, with the names beside the colours. `used`: names of the materials with particles."""
    simple.ColorBy(display, ("POINTS", "material"))
    colours = simple.GetColorTransferFunction("material")
    colours.InterpretValuesAsCategories = 1
    colours.AnnotationsInitialized = 1
    annotations, shades = [], []
    palette = [(0.30, 0.45, 0.69), (0.87, 0.52, 0.32), (0.33, 0.66, 0.41), (0.77, 0.31, 0.32), (0.51, 0.45, 0.70),
               (0.58, 0.47, 0.38), (0.85, 0.55, 0.76), (0.55, 0.55, 0.55), (0.80, 0.73, 0.45), (0.39, 0.71, 0.80)]
    for number, name in enumerate(names, 1):
        if name in used or not used:
            annotations += [str(number), name]
            shades += palette[(number - 1) % len(palette)]
    if annotations:
        colours.Annotations, colours.IndexedColors = annotations, shades


def file_of(folder, name):
    """A reader of a collection of the folder; None if there is no such file."""
    path = os.path.join(folder, name + ".pvd")
    label = f"{os.path.basename(os.path.abspath(folder or '.'))} {name}"
    return simple.PVDReader(registrationName=label, FileName=path) if os.path.exists(path) else None


def show_others(folder, view):
    """Shows blocks as surfaces with their edges, cracks and joints as lines; returns the first reader and whether the model is plane."""
    first, flat = None, True
    for name, width in (("blocks", 1), ("cracks", 3), ("joints", 3)):
        reader = file_of(folder, name)
        if reader is None:
            continue
        display = simple.Show(reader, view)
        display.SetRepresentationType("Surface With Edges" if name == "blocks" else "Surface")
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = (0.75, 0.73, 0.68) if name == "blocks" else (0.1, 0.1, 0.1)
        display.EdgeColor, display.LineWidth = (0.2, 0.2, 0.2), width
        display.Ambient, display.Diffuse = 0.6, 0.4
        low, high = reader.GetDataInformation().GetBounds()[4:6]
        first, flat = first or reader, flat and high - low < 1e-12
    return first, flat


def materials_with_particles(path):
    """The materials that the files of a run.pvd have blocks for; contact laws count as materials, but have no particles."""
    folder = os.path.dirname(path)
    with open(path, encoding="utf-8") as collection:
        files = re.findall(r'file="([^"]*)"', collection.read())
    used = set()
    for name in files[-1:]:
        with open(os.path.join(folder, name), encoding="utf-8") as blocks:
            used |= {html.unescape(word) for word in re.findall(r' name="([^"]*)"', blocks.read())}
    return used


def show_particles(reader, record, field, view):
    """Shows a reader of a run.pvd; returns its display and whether the model is plane."""
    reader.UpdatePipeline()
    low, high = reader.GetDataInformation().GetBounds()[4:6]
    flat = high - low < 1e-12
    display = simple.Show(reader, view)
    show_as_boxes(display, flat)
    if field == "material":
        colour_by_material(display, record.get("materials", []), materials_with_particles(str(reader.FileName).strip("[]'")))
    else:
        simple.ColorBy(display, ("POINTS", field))
        display.RescaleTransferFunctionToDataRange(True, False)
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(simple.GetColorTransferFunction(field), view)
    bar.TitleFontSize = bar.LabelFontSize = 8
    in_unit = record.get("unit_of", {}).get(field)
    bar.Title = f"{field} [{in_unit}]" if in_unit and in_unit != "-" else field
    return display, flat


def open_run(path, field="material", particles=None):
    """Shows a run. `path`: its folder or one of its .pvd files; `field`: `material` or an array of the particles; `particles`: a
    reader of run.pvd if there is one already."""
    folder = os.path.dirname(path) if path.endswith(".pvd") else path
    record = record_of(folder or ".")
    view = simple.GetActiveViewOrCreate("RenderView")
    reader, display, flat = particles or file_of(folder, "run"), None, False
    if reader is not None:
        display, flat = show_particles(reader, record, field, view)
    other, flat_others = show_others(folder, view)
    if reader is None:
        reader, flat = other, flat_others
    if reader is None:
        raise OSError(f"there is no run.pvd or blocks.pvd in '{folder or '.'}'")
    unit = record.get("model", {}).get("unit of time", "")
    label = simple.AnnotateTimeFilter(registrationName="time", Input=reader)
    label.Format = "time {time:g} " + unit
    simple.Show(label, view).FontSize = 8
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    if flat:
        view.InteractionMode = "2D"
    else:  # from the front, the right and above; z points up
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = (0.8, -1.6, 0.9), (0, 0, 0), (0, 0, 1)
    simple.ResetCamera(view)
    simple.SetActiveSource(reader)
    return reader, display, view


def main():
    if len(sys.argv) > 2:  # pvpython
        reader, display, view = open_run(sys.argv[1], *sys.argv[3:4])
        if len(sys.argv) > 4:
            scene, times = simple.GetAnimationScene(), list(reader.TimestepValues)
            scene.AnimationTime = min(times, key=lambda t: abs(t - float(sys.argv[4])))
            simple.Render(view)
            if display is not None and sys.argv[3] != "material":
                display.RescaleTransferFunctionToDataRange(False, True)
            simple.ResetCamera(view)
        simple.SaveScreenshot(sys.argv[2], view, ImageResolution=[1200, 800])
        return
    active = simple.GetActiveSource()
    path = str(getattr(active, "FileName", "")).strip("[]'")
    if path.endswith("run.pvd"):
        open_run(path, particles=active)
    elif path.endswith(".pvd"):
        open_run(path)
    elif os.environ.get("TRIBO_RUN"):
        open_run(os.environ["TRIBO_RUN"])
    else:
        print("Select the run.pvd or blocks.pvd of a run in the pipeline, or set the variable TRIBO_RUN to the folder of a run.")


main()
