#!/usr/bin/python3
"""Pictures of an output folder: render.py OUT [--to FOLDER] [--axis y] [--at 0.5] [--view 1,-1.3,0.8] ...

Writes surface.png (the boundary by patch), cut.png (elements behind a plane, by subdomain), exploded.png (the
decomposition, pulled apart) and worst.png (the elements with the smallest dihedral angles) with VTK, which needs a
display: without one, run it as `xvfb-run -a scripts/render.py OUT`, or use `dovetail view OUT --png PICTURE.png`. Faces on the sides of the bounding box are left
out of the surface when there is something inside (--box keeps them). Of a mesh of triangles it writes pieces.png: the
triangles by subdomain, with the lines between the subdomains and the CAD curves.

    render.py MESH.vtu ... --to PICTURE.png [--only pieces,cut,exploded] ...

puts meshes beside each other in one picture, each by the array `region`, as `write_vtu` has it: the pieces of a mesh of
triangles, with the lines between them, or elements behind a plane, or regions pulled apart (--only: one word per mesh).
Elements that are regions of their own are grey.
"""

import argparse
import glob
import os
import sys

import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401 (VTK's object factories)
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkOutlineSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import (
    vtkXMLPolyDataReader, vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader)
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

SIDES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def read(reader, path):
    if not os.path.exists(path):
        sys.exit(f"render: {path} is missing")
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def cells_of(cells, corners):
    return vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, corners)


def cell_array(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))


def distinct_colours(numbers):
    """One soft colour per number; neighbouring numbers get different hues (golden angle)."""
    hue = (np.asarray(numbers) * 0.381966 + 0.58) % 1.0
    value = 0.80 + 0.15 * ((np.asarray(numbers) % 3) / 2)
    channels = [(hue * 6 + shift) % 6 for shift in (5, 3, 1)]
    rgb = np.stack([value * (1 - 0.45 * np.clip(np.minimum(k, 4 - k), 0, 1)) for k in channels], axis=-1)
    return (255 * rgb).astype(np.uint8)


def surface_actor(points, triangles, colours, edges=True, opacity=1.0):
    """Triangles (indices into points), each with its colour; shape (n, 3) both."""
    used, local = np.unique(triangles, return_inverse=True)
    cells = vtkCellArray()
    offsets = np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, True),
                  numpy_to_vtkIdTypeArray(local.astype(np.int64).ravel(), True))
    poly, coordinates = vtkPolyData(), vtkPoints()
    coordinates.SetData(numpy_to_vtk(points[used], True))
    poly.SetPoints(coordinates)
    poly.SetPolys(cells)
    poly.GetCellData().SetScalars(
        numpy_to_vtk(np.ascontiguousarray(colours), True, vtkUnsignedCharArray().GetDataType()))
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(poly)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    actor.GetProperty().SetEdgeVisibility(edges)
    actor.GetProperty().SetEdgeColor(0.15, 0.15, 0.2)
    actor.GetProperty().SetLineWidth(0.6)
    actor.GetProperty().SetOpacity(opacity)
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetDiffuse(0.75)
    return actor


def line_actor(points, segments, width=2.5):
    """Segments (indices into points; shape (n, 2)) as thick dark lines."""
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 2 * len(segments) + 1, 2, dtype=np.int64), True),
                  numpy_to_vtkIdTypeArray(segments.astype(np.int64).ravel(), True))
    poly, coordinates = vtkPolyData(), vtkPoints()
    coordinates.SetData(numpy_to_vtk(points, True))
    poly.SetPoints(coordinates)
    poly.SetLines(cells)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(poly)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.05, 0.05, 0.1)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().SetLighting(False)
    return actor


def outline_actor(points):
    source = vtkOutlineSource()
    low, high = points.min(axis=0), points.max(axis=0)
    source.SetBounds(*np.stack([low, high], axis=1).ravel())
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.4, 0.4, 0.45)
    return actor


def require_display():
    """VTK ends the process where X does not answer."""
    if vtkRenderWindow().IsA("vtkXOpenGLRenderWindow") and not os.environ.get("DISPLAY"):
        sys.exit("render: VTK needs a display; run this by `xvfb-run -a`, or use `dovetail view --png`, which needs none")


def save(panels, path, options):
    """Panels, each of actors and a direction to the eye, beside each other."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*options.size)
    for place, (actors, view) in enumerate(panels):
        renderer = vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        renderer.SetViewport(place / len(panels), 0, (place + 1) / len(panels), 1)
        for actor in actors:
            renderer.AddActor(actor)
        window.AddRenderer(renderer)
        camera = renderer.GetActiveCamera()
        camera.SetFocalPoint(0, 0, 0)
        camera.SetPosition(*view)
        camera.SetViewUp(0, 0, 1) if abs(view[0]) + abs(view[1]) > 1e-9 else camera.SetViewUp(0, 1, 0)
        renderer.ResetCamera()
        camera.Zoom(options.zoom)
        renderer.ResetCameraClippingRange()
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    values = vtk_to_numpy(image.GetPointData().GetScalars())  # a view, not a copy
    values[:] = np.round(np.round(values / 255 * (2**options.bits - 1)) / (2**options.bits - 1) * 255)
    writer = vtkPNGWriter()
    writer.SetCompressionLevel(9)
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()
    print(path)


def on_box(points, triangles):
    """Which triangles lie in a side of the bounding box."""
    low, high = points.min(axis=0), points.max(axis=0)
    tolerance = 1e-9 * np.linalg.norm(high - low)
    corners = points[triangles]
    return np.any(np.all(np.abs(corners - low) < tolerance, axis=1) |
                  np.all(np.abs(corners - high) < tolerance, axis=1), axis=1)


def picture_surface(surface, options):
    points, triangles = points_of(surface), cells_of(surface.GetPolys(), 3)
    colours = distinct_colours(cell_array(surface, "patch"))
    box = on_box(points, triangles)
    inside = np.ones(len(box), bool)
    if not options.box and 0 < box.sum() < len(box):
        extent = np.ptp(points[triangles[~box]].reshape(-1, 3), axis=0).max()
        if extent < 0.9 * np.ptp(points, axis=0).max():  # something small inside a far-field box
            inside = ~box
    return [surface_actor(points, triangles[inside], colours[inside])] + \
        ([] if inside.all() else [outline_actor(points[triangles[inside]].reshape(-1, 3))])


def behind_plane(points, elements, options, view):
    """The elements whose centres are behind the plane."""
    axis = "xyz".index(options.axis)
    low, high = points[:, axis].min(), points[:, axis].max()
    centres = points[elements][:, :, axis].mean(axis=1)
    plane = low + options.at * (high - low)
    return np.flatnonzero(centres > plane if view[axis] < 0 else centres < plane)


def outer_faces(elements, kept, keys_of):
    """The faces that one of the kept elements has alone, and these elements; faces are told by their points' keys."""
    faces = np.concatenate([elements[kept][:, side] for side in SIDES])
    owners = np.tile(kept, 4)
    keys = np.sort(keys_of[faces], axis=1)
    order = np.lexsort(keys.T[::-1])
    same = np.all(keys[order][1:] == keys[order][:-1], axis=1)
    single = np.ones(len(order), bool)
    single[1:] &= ~same
    single[:-1] &= ~same
    return faces[order[single]], owners[order[single]]


def picture_cut(volume, options):
    """The elements whose centres are behind the plane, by their outer faces."""
    points, elements = points_of(volume), cells_of(volume.GetCells(), 4)
    ids = vtk_to_numpy(volume.GetPointData().GetGlobalIds())
    faces, owners = outer_faces(elements, behind_plane(points, elements, options, options.view), ids)
    colours = distinct_colours(cell_array(volume, "subdomain")[owners])
    return [surface_actor(points, faces, colours), outline_actor(points)]


def picture_exploded(surface, interfaces, options):
    """Each subdomain's faces, moved away from the middle of the mesh."""
    parts = [(points_of(surface), cells_of(surface.GetPolys(), 3), cell_array(surface, "subdomain"))]
    if interfaces is not None:
        points, triangles = points_of(interfaces), cells_of(interfaces.GetPolys(), 3)
        for side in ("subdomain", "front_subdomain"):
            parts.append((points, triangles, cell_array(interfaces, side)))
    corners = np.concatenate([points[triangles] for points, triangles, _ in parts])
    owners = np.concatenate([owner for _, _, owner in parts])
    return [exploded_actor(corners, owners, distinct_colours(owners), options)]


def exploded_actor(corners, owners, colours, options):
    """Triangles by their corners, shape (n, 3, 3), those of each owner moved away from the middle."""
    middle = (corners.min(axis=(0, 1)) + corners.max(axis=(0, 1))) / 2
    counts = np.bincount(owners)
    sums = np.stack([np.bincount(owners, corners.mean(axis=1)[:, k]) for k in range(3)], axis=1)
    centres = sums / np.maximum(counts, 1)[:, None]
    moved = corners + options.explode * (centres[owners] - middle)[:, None, :]
    triangles = np.arange(3 * len(corners)).reshape(-1, 3)
    return surface_actor(moved.reshape(-1, 3), triangles, colours, edges=len(corners) < 400000)


def picture_pieces(mesh, lines):
    """A mesh of triangles by subdomain, and its lines."""
    colours = distinct_colours(cell_array(mesh, "subdomain"))
    actors = [surface_actor(points_of(mesh), cells_of(mesh.GetCells(), 3), colours)]
    if lines is not None:
        actors.append(line_actor(points_of(lines), cells_of(lines.GetLines(), 2)))
    return actors


def colours_of_regions(regions):
    """Grey where an element is a region of its own."""
    colours = distinct_colours(regions)
    colours[np.bincount(regions)[regions] == 1] = 225
    return colours


def lines_between(triangles, regions):
    """Edges that no other triangle of the same region has."""
    edges = np.sort(np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])]), axis=1)
    keys = np.column_stack([edges, np.tile(regions, 3)])
    found, counts = np.unique(keys, axis=0, return_counts=True)
    return np.unique(found[counts == 1][:, :2], axis=0)


def panel_of_file(path, kind, options):
    """A mesh in one file by its regions: its actors and the direction to the eye."""
    mesh = read(vtkXMLUnstructuredGridReader(), path)
    points, regions = points_of(mesh), cell_array(mesh, "region")
    solid = mesh.GetCellType(0) == 10
    cells = cells_of(mesh.GetCells(), 4 if solid else 3)
    view = [0, 0, 1] if np.ptp(points[:, 2]) == 0 else options.view
    colours = colours_of_regions(regions)
    if kind == "pieces" and not solid:
        return [surface_actor(points, cells, colours), line_actor(points, lines_between(cells, regions), width=1.8)], view
    if kind == "cut" and solid:
        faces, owners = outer_faces(cells, behind_plane(points, cells, options, view), np.arange(len(points)))
        return [surface_actor(points, faces, colours[owners])], view
    if kind == "exploded":
        if solid:
            found = [outer_faces(cells, np.flatnonzero(regions == r), np.arange(len(points))) for r in np.unique(regions)]
            cells = np.concatenate([faces for faces, _ in found])
            owners = np.concatenate([owner for _, owner in found])
            regions, colours = regions[owners], colours[owners]
        return [exploded_actor(points[cells], regions, colours, options)], view
    sys.exit(f"render: there is no picture {kind} of {path}")


def smallest_dihedral(p):
    """Degrees, per element; p has shape (elements, 4, 3)."""
    normals = [np.cross(p[:, b] - p[:, a], p[:, c] - p[:, a]) for a, b, c in SIDES]
    normals = [n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None] for n in normals]
    cosines = [-np.sum(normals[i] * normals[j], axis=1) for i in range(4) for j in range(i)]
    return np.degrees(np.arccos(np.clip(np.max(cosines, axis=0), -1, 1)))


def picture_worst(volume, surface, options):
    """The worst elements, red the worst, in the faint boundary; each is drawn larger when it is small."""
    points, elements = points_of(volume), cells_of(volume.GetCells(), 4)
    angles = np.concatenate([smallest_dihedral(points[part]) for part in
                             np.array_split(elements, max(1, len(elements) // 500000))])
    worst = np.argsort(angles, kind="stable")[:options.worst]
    for e in worst[:5]:
        place = ", ".join(f"{x:.5g}" for x in points[elements[e]].mean(axis=0))
        print(f"smallest dihedral angle {angles[e]:.2f} deg at ({place})")
    corners = points[elements[worst]]
    centres = corners.mean(axis=1, keepdims=True)
    sizes = np.linalg.norm(corners - centres, axis=2).max(axis=1)
    wanted = 0.012 * np.linalg.norm(np.ptp(points, axis=0))
    corners = centres + (corners - centres) * np.maximum(1, wanted / sizes)[:, None, None]
    triangles = np.concatenate([4 * np.arange(len(worst))[:, None] + np.array(side) for side in SIDES])
    shade = np.clip(angles[np.tile(worst, 4)] / 30, 0, 1)
    colours = np.stack([np.full_like(shade, 220), 40 + 180 * shade, 40 * np.ones_like(shade)], axis=1).astype(np.uint8)
    skin, hull = cells_of(surface.GetPolys(), 3), points_of(surface)
    inside = skin if options.box or on_box(hull, skin).all() else skin[~on_box(hull, skin)]
    faint = surface_actor(hull, inside, np.full((len(inside), 3), 190, np.uint8), edges=False, opacity=0.15)
    return [surface_actor(corners.reshape(-1, 3), triangles, colours), faint, outline_actor(hull)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("given", nargs="+", metavar="OUT|MESH.vtu")
    parser.add_argument("--to", help="folder of the pictures (default: OUT), or the picture of VTU files")
    parser.add_argument("--only", help="which pictures, separated by commas (default: all)")
    parser.add_argument("--axis", default="y", choices="xyz", help="normal of the cutting plane")
    parser.add_argument("--at", type=float, default=0.5, help="its place, as a fraction of the extent")
    parser.add_argument("--explode", type=float, default=0.5, help="how far pieces move away from the middle")
    parser.add_argument("--worst", type=int, default=50, help="number of worst elements")
    parser.add_argument("--view", default="", help="direction to the eye: x,y,z (0.9,-1.4,0.8; of a plane mesh 0,0,1)")
    parser.add_argument("--zoom", type=float, default=1.0)
    parser.add_argument("--size", default="1400x1000", help="pixels")
    parser.add_argument("--bits", type=int, default=8, help="of a colour's channel: fewer make a smaller file")
    parser.add_argument("--box", action="store_true", help="draw faces on the bounding box too")
    options = parser.parse_args()
    require_display()
    options.size = [int(x) for x in options.size.split("x")]
    if options.given[0].endswith(".vtu"):
        options.view = [float(x) for x in (options.view or "0.9,-1.4,0.8").split(",")]
        kinds = (options.only or ",".join(["exploded"] * len(options.given))).split(",")
        if not options.to or len(kinds) != len(options.given):
            sys.exit("render: VTU files need --to PICTURE.png, and --only one word for each")
        panels = [panel_of_file(path, kind, options) for path, kind in zip(options.given, kinds)]
        for actor in (actor for actors, _ in panels for actor in actors):
            actor.GetProperty().SetAmbient(0.4)  # what is turned away from the eye keeps its colour
            actor.GetProperty().SetDiffuse(0.6)
        save(panels, options.to, options)
        return
    if len(options.given) > 1:
        sys.exit("render: one output folder, or VTU files")
    options.folder = options.given[0]
    target = options.to or options.folder
    os.makedirs(target, exist_ok=True)
    of_triangles = not os.path.exists(os.path.join(options.folder, "surface.vtp"))
    wanted = (options.only or ("pieces" if of_triangles else "surface,cut,exploded,worst")).split(",")

    def polydata(name):
        path = os.path.join(options.folder, name)
        return read(vtkXMLPolyDataReader(), path) if os.path.exists(path) else None

    surface = None if wanted == ["pieces"] else read(vtkXMLPolyDataReader(), os.path.join(options.folder, "surface.vtp"))
    volume = None
    if set(wanted) & {"cut", "worst", "pieces"}:
        found = glob.glob(os.path.join(glob.escape(options.folder), "*.pvtu"))
        if not found:
            sys.exit(f"render: there is no .pvtu file in {options.folder}")
        volume = read(vtkXMLPUnstructuredGridReader(), found[0])
    flat = of_triangles and volume is not None and np.ptp(points_of(volume)[:, 2]) == 0
    options.view = [float(x) for x in (options.view or ("0,0,1" if flat else "0.9,-1.4,0.8")).split(",")]
    interfaces = polydata("interfaces.vtp") if "exploded" in wanted else None
    pictures = {
        "surface": lambda: picture_surface(surface, options),
        "cut": lambda: picture_cut(volume, options),
        "exploded": lambda: picture_exploded(surface, interfaces, options),
        "worst": lambda: picture_worst(volume, surface, options),
        "pieces": lambda: picture_pieces(volume, polydata("lines.vtp")),
    }
    for name in wanted:
        if name not in pictures:
            sys.exit(f"render: there is no picture called {name}")
        save([(pictures[name](), options.view)], os.path.join(target, name + ".png"), options)


if __name__ == "__main__":
    main()
