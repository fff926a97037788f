#!/usr/bin/python3
"""Runs an example that writes mesh.su2 and checks the file: check_su2.py EXAMPLE FILE"""

import os
import subprocess
import sys
import tempfile


def section(lines, key, rows_of):
    """The rows after "KEY= n", as numbers."""
    at = next(i for i, line in enumerate(lines) if line.startswith(key + "="))
    count = int(lines[at].split("=")[1])
    return [rows_of(line.split()) for line in lines[at + 1:at + 1 + count]]


def integers(words):
    return [int(word) for word in words]


def volume(points, corners):
    a, b, c, d = (points[v] for v in corners)
    u, v, w = ([q - p for p, q in zip(a, x)] for x in (b, c, d))
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
            u[2] * (v[0] * w[1] - v[1] * w[0])) / 6


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], sys.argv[2], folder], check=True)
    with open(os.path.join(folder, "mesh.su2")) as file:
        lines = file.read().splitlines()
    assert os.listdir(folder) == ["mesh.su2"]

elements = section(lines, "NELEM", integers)
points = section(lines, "NPOIN", lambda words: [float(word) for word in words])
markers, triangles = set(), []
for i, line in enumerate(lines):
    if line.startswith("MARKER_TAG="):
        markers.add(line.split("=")[1])
        triangles += section(lines[i:], "MARKER_ELEMS", integers)
assert len(markers) == int(next(line for line in lines if line.startswith("NMARK=")).split("=")[1]) > 1
assert all(kind == 10 for kind, *_ in elements) and all(kind == 5 for kind, *_ in triangles)
assert all(volume(points, corners) > 0 for _, *corners in elements)

faces = {}  # of one element: the boundary
for _, a, b, c, d in elements:
    for face in ((a, b, c), (a, b, d), (a, c, d), (b, c, d)):
        key = tuple(sorted(face))
        faces[key] = faces.get(key, 0) + 1
boundary = sorted(key for key, count in faces.items() if count == 1)
assert boundary == sorted(tuple(sorted(corners)) for _, *corners in triangles), "markers are not the boundary"
print(len(elements), "tetrahedra,", len(triangles), "triangles in", len(markers), "markers")
