#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Opens the files of a run with VTK, which ParaView uses: `test_paraview.py TRIBO SOURCE_DIR`.

Checks that the collection and its pieces open, that blocks have the names of the materials, and that arrays have names,
types, units and global identities.
"""

import os
import re
import subprocess
import sys
import tempfile

import vtk

from checks import Checks

program, source = map(os.path.abspath, sys.argv[1:3])
check = Checks()

model = """<JANFEAInput version='3'>
<Header><Analysis>{analysis}</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
<MPMHeader><TimeStep>0.001</TimeStep><MaxTime>0.01</MaxTime><ArchiveTime>0.004</ArchiveTime><GIMP/><MultiMaterialMode/>{header}
<Output grid='mass velocity'/></MPMHeader>
<Mesh><Grid xmin='0' xmax='8' ymin='0' ymax='4'{deep}><Horiz nx='8'/><Vert ny='4'/>{depth}</Grid></Mesh>
<MaterialPoints>
<Body matname='soft &amp; "wet"' vx='1'><{shape} xmin='1' xmax='3' ymin='1' ymax='3'{box}/></Body>
<Body matname='rock'><{shape} xmin='3' xmax='6' ymin='1' ymax='3'{box}/></Body>
{other}
</MaterialPoints>
<Material Type='NeoHookean' Name='soft &amp; "wet"'><rho>1000</rho><E>1e6</E><nu>0.3</nu></Material>
<Material Type='LinearElastic' Name='rock'><rho>2000</rho><E>1e6</E><nu>0.3</nu></Material>
</JANFEAInput>
"""
plane = dict(other="", analysis=10, deep="", depth="", box="", shape="Rect")
space = dict(other="", analysis=12, deep=" zmin='0' zmax='4'", depth="<Depth nz='4'/>", box=" zmin='1' zmax='3'", shape="Box")
names = ['soft & "wet"', "rock"]
units = dict(velocity="m/s", displacement="m", stress="Pa", size="m", domain="m", material=None)


def read(reader, path):
    """What a reader of VTK makes of a file; any error that it reports fails the test."""
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    reader.SetFileName(path)
    reader.Update()
    check(not errors and reader.GetErrorCode() == 0, f"VTK opens {path}")
    return reader.GetOutput()


def unit(array):
    return array.GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL())


def check_block(data, dimension, real):
    count, points, field = data.GetNumberOfPoints(), data.GetPointData(), data.GetFieldData()
    check(count == (16 if dimension == 2 else 64) * (1 if points.GetArray("material").GetValue(0) == 1 else 1.5), "particles")
    check(data.GetNumberOfVerts() == count, "a vertex for each particle")
    texts = field.GetAbstractArray("material names")
    check([texts.GetValue(k) for k in range(texts.GetNumberOfValues())] == names, "names of all materials")
    check(points.GetGlobalIds() and points.GetGlobalIds().GetName() == "id", "global identities")
    for k in range(points.GetNumberOfArrays()):
        check(points.GetArray(k).GetName() and points.GetArray(k).GetNumberOfTuples() == count, "names and sizes of arrays")
    for name, wanted in units.items():
        check(unit(points.GetArray(name)) == wanted, f"unit of {name}: {unit(points.GetArray(name))}")
    check(points.GetArray("stress").GetComponentName(3) == "XY", "names of components")
    check(data.GetPoints().GetDataType() == vtk.VTK_DOUBLE, "positions in double precision")
    for name in ("velocity", "stress"):
        check(points.GetArray(name).GetDataType() == real, f"precision of {name}")
    size = points.GetArray("size")
    for i in range(count):
        edges, axes = size.GetTuple3(i), points.GetArray("domain").GetTuple(i)
        for d in range(3):
            axis = axes[d * dimension : (d + 1) * dimension] if d < dimension else ()
            check(abs(edges[d] - 2 * sum(a * a for a in axis) ** 0.5) < 1e-6, "size of a particle")
    return [int(points.GetGlobalIds().GetValue(i)) for i in range(count)], field.GetArray("TimeValue").GetValue(0)


def check_run(folder, dimension, real):
    listed = re.findall(r'timestep="([^"]*)" part="0" file="([^"]*)"', open(f"{folder}/run.pvd").read())
    check(len(listed) >= 3, f"times of output: {listed}")
    for time, file in listed:
        blocks = read(vtk.vtkXMLMultiBlockDataReader(), f"{folder}/{file}")
        check(blocks.GetNumberOfBlocks() == 2, "a block for each material")
        ids = []
        for k, name in enumerate(names):
            check(blocks.GetMetaData(k).Get(vtk.vtkCompositeDataSet.NAME()) == name, f"name of the block of {name}")
            own, at = check_block(blocks.GetBlock(k), dimension, real)
            check(at == float(time), "time of the field data")
            ids += own
        check(sorted(ids) == list(range(len(ids))), "each particle once")
    grid = read(vtk.vtkXMLImageDataReader(), f"{folder}/grid/" + os.path.basename(listed[-1][1]).replace(".vtm", ".vti"))
    check(grid.GetPointData().GetArray("velocity").GetNumberOfTuples() == grid.GetNumberOfPoints(), "nodal field")


def check_bodies(folder):
    """Two bodies of the second material are blocks within its block."""
    blocks = read(vtk.vtkXMLMultiBlockDataReader(), f"{folder}/particles/run_000000.vtm")
    name = lambda data, k: data.GetMetaData(k).Get(vtk.vtkCompositeDataSet.NAME())
    check([name(blocks, k) for k in range(blocks.GetNumberOfBlocks())] == names, "a block for each material")
    rock = blocks.GetBlock(1)
    check([name(rock, k) for k in range(rock.GetNumberOfBlocks())] == ["rock 1", "rock 2"], "a block for each body")
    check([rock.GetBlock(k).GetNumberOfPoints() for k in range(2)] == [24, 4], "particles of each body")


with tempfile.TemporaryDirectory(prefix="tribo-paraview-") as scratch:
    os.chdir(scratch)
    for label, dimension, words, header, real in (("plane", 2, plane, "", vtk.VTK_FLOAT), ("space", 3, space, "", vtk.VTK_FLOAT),
                                                  ("double", 2, plane, "<DoublePrecision/>", vtk.VTK_DOUBLE)):
        with open(f"{label}.xml", "w") as file:
            file.write(model.format(header=header, **words))
        done = subprocess.run([program, "run", "--quiet", "-o", label, f"{label}.xml"], capture_output=True, text=True)
        check(done.returncode == 0, f"the run {label}: {done.stderr}")
        check_run(label, dimension, real)
    with open("bodies.xml", "w") as file:
        other = "<Body matname='rock'><Rect xmin='7' xmax='8' ymin='1' ymax='2'/></Body>"
        file.write(model.format(header="", **{**plane, "other": other}))
    done = subprocess.run([program, "run", "--quiet", "-o", "bodies", "bodies.xml"], capture_output=True, text=True)
    check(done.returncode == 0, f"the run of bodies: {done.stderr}")
    check_bodies("bodies")
print(f"{check.passed} checks passed")
