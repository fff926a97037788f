#!/usr/bin/python3
"""Is a mesh in HDF5 files of pieces the one of a PVTU? check_hdf5_pieces.py FOLDER STEM PVTU. Reads every file by h5py
and by VTK, and the XDMF file as its own reader. Prints a line of counts; exit status 0 when all are the same mesh."""

import os
import sys
import xml.etree.ElementTree as xml

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPUnstructuredGridReader

from vtk_reading import read_by_vtk


def fail(what):
    sys.exit(f"not the same mesh: {what}")


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


def grid_of_vtk(mesh):
    cells = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(mesh.GetNumberOfCells(), -1)
    return {"points": vtk_to_numpy(mesh.GetPoints().GetData()), "ids": array(mesh.GetPointData(), "GlobalNodeIds"),
            "cells": cells, "subdomain": array(mesh.GetCellData(), "subdomain"),
            "region": array(mesh.GetCellData(), "region"),
            "types": {mesh.GetCellType(i) for i in range(mesh.GetNumberOfCells())}}


def grids_of_file(path):
    """One per piece, by h5py."""
    with h5py.File(path) as file:
        grid, pieces = file["VTKHDF"], file["pieces"]
        point = cell = corner = offset = 0
        for k in range(len(grid["NumberOfPoints"])):
            points, cells = int(grid["NumberOfPoints"][k]), int(grid["NumberOfCells"][k])
            corners = int(grid["NumberOfConnectivityIds"][k])
            if not np.array_equal(grid["Offsets"][offset:offset + cells + 1],
                                  np.arange(cells + 1) * (corners // cells)):
                fail(f"offsets in {path}")
            ids = grid["PointData/GlobalNodeIds"][point:point + points]
            own = points - int(pieces["skeleton_points"][k])
            if not np.array_equal(ids[points - own:], int(pieces["first_point"][k]) + np.arange(own)):
                fail(f"numbers of points of piece {k} in {path}")
            subdomain = grid["CellData/subdomain"][cell:cell + cells]
            if np.any(subdomain != pieces["subdomain"][k]):
                fail(f"subdomain of piece {k} in {path}")
            yield {"points": grid["Points"][point:point + points], "ids": ids, "subdomain": subdomain,
                   "cells": grid["Connectivity"][corner:corner + corners].reshape(cells, -1),
                   "region": grid["CellData/region"][cell:cell + cells],
                   "types": set(grid["Types"][cell:cell + cells]), "first": int(pieces["first_element"][k])}
            point, cell, corner, offset = point + points, cell + cells, corner + corners, offset + cells + 1
        if (point, cell, corner, offset) != tuple(len(grid[name]) for name in
                                                  ("Points", "Types", "Connectivity", "Offsets")):
            fail(f"arrays of {path} are longer than its pieces")


def item_of(element, folder):
    """The values of an XDMF item: a dataset, or rows of one."""
    extent = [int(n) for n in element.get("Dimensions").split()]
    if element.get("ItemType") == "HyperSlab":
        slab, whole = element.findall("DataItem")
        start, stride, count = np.array([int(n) for n in slab.text.split()]).reshape(3, -1)
        if np.any(stride != 1) or list(count) != extent:
            fail("a slab in the XDMF file")
        return item_of(whole, folder)[tuple(slice(a, a + n) for a, n in zip(start, count))]
    name, path = element.text.split(":")
    with h5py.File(os.path.join(folder, name)) as file:
        if list(file[path].shape) != extent or file[path].dtype.itemsize != int(element.get("Precision")):
            fail(f"extent of {element.text} in the XDMF file")
        return file[path][()]


def grids_of_xdmf(folder, stem):
    root = xml.parse(os.path.join(folder, stem + ".xdmf")).getroot()
    for grid in root.findall("./Domain/Grid/Grid"):
        topology = grid.find("Topology")
        values = {each.get("Name"): item_of(each.find("DataItem"), folder) for each in grid.findall("Attribute")}
        kind = {"Tetrahedron": 10, "Tetrahedron_10": 24, "Triangle": 5, "Triangle_6": 22}[topology.get("TopologyType")]
        yield {"points": item_of(grid.find("Geometry/DataItem"), folder), "ids": values["GlobalNodeIds"],
               "cells": item_of(topology.find("DataItem"), folder).reshape(int(topology.get("NumberOfElements")), -1),
               "subdomain": values["subdomain"], "region": values["region"], "types": {kind}}


def joined(grids):
    whole, before = {}, 0
    for grid in grids:
        if grid.get("first", before) != before:
            fail("numbers of elements")
        before += len(grid["cells"])
        for name in ("points", "ids", "subdomain", "region"):
            whole.setdefault(name, []).append(grid[name])
        whole.setdefault("cells", []).append(grid["ids"][grid["cells"]])
        whole["types"] = whole.get("types", set()) | grid["types"]
    return {name: values if name == "types" else np.concatenate(values) for name, values in whole.items()}


def compare(found, expected, what):
    """Elements by number, and the place of each point wherever it is said."""
    places = np.full((expected["ids"].max() + 1, 3), np.nan)
    places[expected["ids"]] = expected["points"]
    if found["ids"].max() != expected["ids"].max() or len(np.unique(found["ids"])) != len(np.unique(expected["ids"])):
        fail(f"points of {what}")
    if not np.array_equal(places[found["ids"]], found["points"]):
        fail(f"a point of {what} is elsewhere")
    for name in ("cells", "subdomain", "region"):
        if not np.array_equal(found[name], expected[name]):
            fail(f"{name} of {what}")
    if found["types"] != expected["types"]:
        fail(f"types of {what}")


def compare_skeletons(folder, vtu_folder):
    """The sides by the global numbers of their points, with where they are."""
    def sides_of(points, ids, corners, cells):
        names = [name for name in ("cad_face", "cad_curve", "patch", "subdomain", "front_subdomain")
                 if cells.GetArray(name)]
        rows = np.column_stack([ids[corners]] + [array(cells, name) for name in names if name != "front_subdomain"] +
                               [array(cells, "front_subdomain") if "front_subdomain" in names
                                else np.full(len(corners), -1)])
        return rows, points[corners]

    expected = []
    for name in ("surface.vtp", "interfaces.vtp", "lines.vtp"):
        path = os.path.join(vtu_folder, name)
        if os.path.exists(path):
            sides = read_by_vtk(vtkXMLPolyDataReader(), path)
            cells = sides.GetPolys() if sides.GetNumberOfPolys() else sides.GetLines()
            corners = vtk_to_numpy(cells.GetConnectivityArray()).reshape(sides.GetNumberOfCells(), -1)
            expected.append(sides_of(vtk_to_numpy(sides.GetPoints().GetData()),
                                     array(sides.GetPointData(), "GlobalNodeIds"), corners, sides.GetCellData()))
    mesh = read_by_vtk(vtkHDFReader(), os.path.join(folder, "skeleton.vtkhdf"))
    corners = vtk_to_numpy(mesh.GetCells().GetConnectivityArray()).reshape(mesh.GetNumberOfCells(), -1)
    found = sides_of(vtk_to_numpy(mesh.GetPoints().GetData()), array(mesh.GetPointData(), "GlobalNodeIds"), corners,
                     mesh.GetCellData())

    def in_order(rows, places):
        order = np.lexsort(rows.T)
        return rows[order], places[order]

    for a, b in zip(in_order(*found), in_order(*(np.concatenate(part) for part in zip(*expected)))):
        if not np.array_equal(a, b):
            fail("sides of the skeleton")
    return len(corners)


def measure(mesh):
    places = np.full((mesh["ids"].max() + 1, 3), np.nan)
    places[mesh["ids"]] = mesh["points"]
    if mesh["types"] & {10, 24}:
        a, b, c, d = (places[mesh["cells"][:, k]] for k in range(4))
        return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6
    a, b, c = (places[mesh["cells"][:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def main():
    folder, stem, pvtu = sys.argv[1:]
    expected = grid_of_vtk(read_by_vtk(vtkXMLPUnstructuredGridReader(), pvtu))
    expected["cells"] = expected["ids"][expected["cells"]]
    files = sorted(name for name in os.listdir(folder) if name.startswith(stem + "_") and name.endswith(".vtkhdf"))
    paths = [os.path.join(folder, name) for name in files]
    found = joined(grid for path in paths for grid in grids_of_file(path))
    compare(found, expected, "h5py")
    compare(joined(grid_of_vtk(read_by_vtk(vtkHDFReader(), path)) for path in paths), expected, "VTK")
    compare(joined(grids_of_xdmf(folder, stem)), expected, "the XDMF file")
    sides = compare_skeletons(folder, os.path.dirname(pvtu))
    print(f"{len(files)} files, {len(found['cells'])} elements, {found['ids'].max() + 1} points, {sides} sides, "
          f"measure {measure(found):.9f}")


main()
