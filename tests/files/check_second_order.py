"""Reads a PVTU file of second-order elements of a unit ball or sphere with VTK: NODES different nodes, each at one
place, and by VTK's own shape functions positive Jacobians and the MEASURE.
Usage: check_second_order.py FILE NODES MEASURE"""
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

reader = vtkXMLPUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
mesh = reader.GetOutput()
ids = vtk_to_numpy(mesh.GetPointData().GetArray("GlobalNodeIds"))
points = vtk_to_numpy(mesh.GetPoints().GetData())
problems = []
if len(numpy.unique(ids)) != int(sys.argv[2]):
    problems.append(f"{len(numpy.unique(ids))} nodes")
if len(numpy.unique(ids)) != len(numpy.unique(numpy.column_stack((ids, points)), axis=0)):
    problems.append("a node is at two places")
types = {mesh.GetCellType(i) for i in range(mesh.GetNumberOfCells())}
if types not in ({24}, {22}):
    problems.append(f"cell types {types}")
solid = types == {24}
# Of degree 3 for tetrahedra; for triangles three points.
if solid:
    places = [(0.25, 0.25, 0.25), (1 / 6, 1 / 6, 1 / 6), (0.5, 1 / 6, 1 / 6), (1 / 6, 0.5, 1 / 6), (1 / 6, 1 / 6, 0.5)]
    weights = [-0.8 / 6] + 4 * [0.45 / 6]
else:
    places = [(1 / 6, 1 / 6, 0), (2 / 3, 1 / 6, 0), (1 / 6, 2 / 3, 0)]
    weights = 3 * [1 / 6]
dimension = 3 if solid else 2
nodes = 10 if solid else 6
measure = 0.0
least = numpy.inf
slopes = []
for place in places:
    values = [0.0] * (dimension * nodes)
    mesh.GetCell(0).InterpolateDerivs(place, values)
    slopes.append(numpy.array(values).reshape(dimension, nodes))
for i in range(mesh.GetNumberOfCells()):
    cell = mesh.GetCell(i)
    at = points[[cell.GetPointId(k) for k in range(nodes)]]
    for slope, weight in zip(slopes, weights):
        columns = slope @ at
        if solid:
            jacobian = numpy.linalg.det(columns)
        else:
            normal = numpy.cross(columns[0], columns[1])
            jacobian = numpy.linalg.norm(normal) * numpy.sign(normal @ at.mean(axis=0))
        measure += weight * jacobian
        least = min(least, jacobian)
if not least > 0:
    problems.append(f"least Jacobian {least}")
if abs(measure / float(sys.argv[3]) - 1) > 3e-4:
    problems.append(f"measure {measure}")
print("\n".join(problems))
sys.exit(1 if problems else 0)
