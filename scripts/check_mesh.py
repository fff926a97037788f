#!/usr/bin/python3
"""Checks an output folder with an independent reader (VTK): check_mesh.py OUT [--areas]

Reads OUT/*.pvtu and OUT/surface.vtp and prints one JSON object. Exit status 0 when the mesh is valid:
positive volumes, every interior face shared by exactly two elements (by GlobalNodeIds), one coordinate per
global id, a closed boundary that is the surface file's, triangle by triangle. Of triangles (--dimension 2):
areas, coordinates, none twice, and those of one CAD face beside each other turned alike.
"""

import argparse
import glob
import json
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPUnstructuredGridReader


def read(reader, path):
    problems = []

    def note(_, __, message):
        problems.append(f"VTK cannot read {path}: {message.strip()}")

    note.CallDataType = "string0"
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, note)
    reader.SetFileName(path)
    reader.Update()
    if problems:
        raise SystemExit(json.dumps({"valid": False, "errors": problems}))
    return reader.GetOutput()


def strings(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return [] if array is None else [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def global_points(data):
    """Global ids and coordinates per point."""
    ids = data.GetPointData().GetGlobalIds()
    if ids is None:
        raise SystemExit(json.dumps({"valid": False, "errors": ["no GlobalNodeIds"]}))
    return vtk_to_numpy(ids), vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def connectivity(cells, corners):
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    if not np.all(np.diff(offsets) == corners):
        raise SystemExit(json.dumps({"valid": False, "errors": [f"cells without {corners} corners"]}))
    return vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, corners)


def sort_rows(rows):
    return rows[np.lexsort(rows.T[::-1])]


def count_rows(rows):
    """Distinct rows and how often each occurs, of rows with few columns of non-negative integers."""
    rows = sort_rows(rows)
    first = np.ones(len(rows), bool)
    first[1:] = np.any(rows[1:] != rows[:-1], axis=1)
    starts = np.flatnonzero(first)
    return rows[starts], np.diff(np.append(starts, len(rows)))


def dihedral_angles(p):
    """Degrees, shape (tetrahedra, 6); p has shape (tetrahedra, 4, 3)."""
    normals = [np.cross(p[:, b] - p[:, a], p[:, c] - p[:, a])
               for a, b, c in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))]
    normals = [n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None] for n in normals]
    angles = [np.degrees(np.arccos(np.clip(-np.sum(normals[i] * normals[j], axis=1), -1, 1)))
              for i in range(4) for j in range(i)]
    return np.stack(angles, axis=1)


def euler_characteristic(triangles):
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    distinct, uses = count_rows(edges)
    return len(np.unique(triangles)) - len(distinct) + len(triangles), uses


def shells(triangles):
    """Number of connected components by shared vertices: labels sink to the smallest of their component."""
    vertices, local = np.unique(triangles, return_inverse=True)
    local = local.reshape(triangles.shape)
    label = np.arange(len(vertices))
    while True:
        smallest = label[local].min(axis=1)
        lower = label.copy()
        for corner in range(3):
            np.minimum.at(lower, local[:, corner], smallest)
        lower = lower[lower]
        if np.array_equal(lower, label):
            return len(np.unique(label))
        label = lower


def check_elements(data, corners, errors):
    """Ids, points and elements by local numbers; what elements of any dimension have in common."""
    ids, points = global_points(data)
    elements = connectivity(data.GetCells(), corners)
    if not np.all(vtk_to_numpy(data.GetCellTypesArray()) == {3: 5, 4: 10}[corners]):
        errors.append("cells of more than one kind")
    order = np.argsort(ids, kind="stable")
    same = np.diff(ids[order]) == 0
    moved = same & np.any(points[order][1:] != points[order][:-1], axis=1)
    if np.any(moved):
        errors.append(f"{int(moved.sum())} global ids with more than one coordinate")
    used = np.zeros(len(ids), bool)
    used[elements] = True
    if not used.all():
        errors.append(f"{int((~used).sum())} points are in no element")
    if len(count_rows(np.sort(ids[elements], axis=1))[0]) != len(elements):
        errors.append("elements that occur twice")
    return ids, points, elements


def check_triangles(data, result, errors):
    ids, points, elements = check_elements(data, 3, errors)
    p = points[elements]
    areas = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    if np.any(areas <= 0):
        errors.append(f"{int((areas <= 0).sum())} elements without area")
    named, cad = ids[elements], vtk_to_numpy(data.GetCellData().GetArray("region"))
    passages = np.concatenate([np.column_stack([cad, named[:, a], named[:, b]]) for a, b in ((0, 1), (1, 2), (2, 0))])
    turned = int((count_rows(passages)[1] > 1).sum())
    if turned:
        errors.append(f"{turned} edges that two triangles of a face pass in the same direction")
    result.update(elements=len(elements), vertices=len(np.unique(ids)), area=float(areas.sum()))


def check_volume(data, result, errors):
    ids, points, elements = check_elements(data, 4, errors)
    corners = points[elements]
    volumes = np.einsum("ij,ij->i", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                        corners[:, 3] - corners[:, 0]) / 6
    if np.any(volumes <= 0):
        errors.append(f"{int((volumes <= 0).sum())} elements without positive volume")
    angles = np.concatenate([dihedral_angles(part) for part in
                             np.array_split(corners, max(1, len(corners) // 500000))])
    smallest = angles.min(axis=1)

    named = ids[elements]
    faces = np.concatenate([named[:, s] for s in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
    distinct, uses = count_rows(np.sort(faces, axis=1))
    if np.any(uses > 2):
        errors.append(f"{int((uses > 2).sum())} faces with more than two elements")
    boundary = distinct[uses == 1]

    regions = vtk_to_numpy(data.GetCellData().GetArray("region"))
    subdomains = vtk_to_numpy(data.GetCellData().GetArray("subdomain"))
    result.update(
        elements=len(elements), vertices=len(np.unique(ids)), boundary_triangles=len(boundary),
        volume=float(volumes.sum()), smallest_volume=float(volumes.min()),
        volume_per_region={int(r): float(volumes[regions == r].sum()) for r in np.unique(regions)},
        region_names=strings(data, "region_names"),
        subdomains=len(np.unique(subdomains)),
        largest_subdomain=int(np.bincount(subdomains).max()),
        min_dihedral_deg=float(smallest.min()), max_dihedral_deg=float(angles.max()),
        bad_per_million=float(1e6 * np.mean(smallest < 12)), low_per_million=float(1e6 * np.mean(smallest < 24)))
    return boundary


def check_surface(data, boundary, result, errors):
    ids, points = global_points(data)
    local = connectivity(data.GetPolys(), 3)
    named = ids[local]
    mine = sort_rows(np.sort(named, axis=1))
    if mine.shape != boundary.shape or np.any(mine != sort_rows(boundary)):
        errors.append("surface.vtp is not the boundary of the mesh")
    euler, uses = euler_characteristic(boundary)
    if np.any(uses % 2 == 1):
        errors.append(f"the boundary is open at {int((uses % 2 == 1).sum())} edges")
    result["non_manifold_boundary_edges"] = int((uses > 2).sum())
    result["shells"] = shells(boundary)
    result["euler_characteristic"] = int(euler)

    p = points[local] - points.mean(axis=0)
    normals = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    areas = np.linalg.norm(normals, axis=1) / 2
    enclosed = np.einsum("ij,ij->i", p[:, 0], np.cross(p[:, 1], p[:, 2])).sum() / 6
    if abs(enclosed - result["volume"]) > 1e-9 * max(abs(enclosed), np.ptp(points, axis=0).prod()):
        errors.append(f"the boundary encloses {enclosed}, the elements fill {result['volume']}")
    cad = vtk_to_numpy(data.GetCellData().GetArray("cad_face"))
    patch = vtk_to_numpy(data.GetCellData().GetArray("patch"))
    names = strings(data, "patch_names")
    if np.any(cad < 0) or np.any(patch < 0):
        errors.append("boundary triangles without a CAD face or patch")
    result["area"] = float(areas.sum())
    result["area_per_cad_face"] = {int(f): float(areas[cad == f].sum()) for f in np.unique(cad)}
    result["area_per_patch"] = {names[i] if 0 <= i < len(names) else str(i): float(areas[patch == i].sum())
                                for i in np.unique(patch)}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    arguments.add_argument("folder")
    folder = arguments.parse_args().folder
    found = glob.glob(os.path.join(glob.escape(folder), "*.pvtu"))
    if len(found) != 1:
        raise SystemExit(json.dumps({"valid": False, "errors": [f"{len(found)} .pvtu files in {folder}"]}))
    result, errors = {"file": found[0]}, []
    data = read(vtkXMLPUnstructuredGridReader(), found[0])
    if np.all(vtk_to_numpy(data.GetCellTypesArray()) == 5):
        check_triangles(data, result, errors)
    else:
        boundary = check_volume(data, result, errors)
        check_surface(read(vtkXMLPolyDataReader(), os.path.join(folder, "surface.vtp")), boundary, result, errors)
    print(json.dumps({"valid": not errors, "errors": errors, **result}, indent=1))
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
