#!/usr/bin/python3
"""Reads the files of a parallel solver with somebody else's reader and checks that the ranks make one mesh:
check_rank_files.py FORMAT FOLDER RANKS. Prints one line of counts; exit status 0 when all is well."""

import itertools
import os
import subprocess
import sys

import numpy as np

from vtk_reading import read_by_vtk


def fail(what):
    sys.exit(f"not one mesh: {what}")


EDGES = {3: [(0, 1), (1, 2), (2, 0)], 4: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]}  # VTK's order


def check_middles(nodes, corners, places):
    """Each edge has one node in its middle, near it, and no other edge has that."""
    edges = EDGES[corners]
    ends = np.concatenate([nodes[:, edge] for edge in edges])
    middles = np.concatenate([nodes[:, corners + k] for k in range(len(edges))])
    a, b = places[ends[:, 0]], places[ends[:, 1]]
    if np.any(np.linalg.norm(places[middles] - (a + b) / 2, axis=1) > 0.25 * np.linalg.norm(b - a, axis=1)):
        fail("a node is not in the middle of its edge")
    found = np.unique(np.column_stack((np.sort(ends, axis=1), middles)), axis=0)
    if len(np.unique(found[:, :2], axis=0)) != len(found) or len(np.unique(found[:, 2])) != len(found):
        fail("edges and the nodes in their middles")


def check_ranks(ranks):
    """Each rank: points, their ids and whether another owns them; elements by place, their ids and whether they are
    ghosts."""
    vertices = sum(int((~rank["foreign"]).sum()) for rank in ranks)
    elements = sum(int((~rank["ghost"]).sum()) for rank in ranks)
    places = np.full((vertices, 3), np.nan)
    next_vertex = next_element = 0
    for number, rank in enumerate(ranks):
        own = rank["ids"][~rank["foreign"]]
        if not np.array_equal(own, np.arange(next_vertex, next_vertex + len(own))):
            fail(f"ids of vertices of rank {number}")
        cells = rank["cell_ids"][~rank["ghost"]]
        if not np.array_equal(cells, np.arange(next_element, next_element + len(cells))):
            fail(f"ids of elements of rank {number}")
        next_vertex += len(own)
        next_element += len(cells)
        places[own] = rank["points"][~rank["foreign"]]
    named, seen = [], {}
    for number, rank in enumerate(ranks):
        if not np.array_equal(places[rank["ids"]], rank["points"]):
            fail(f"rank {number} has a vertex elsewhere than its owner")
        ids = rank["ids"][rank["cells"]]
        named.append(ids[~rank["ghost"]])
        seen.update((int(i), tuple(sorted(e))) for i, e in zip(rank["cell_ids"][~rank["ghost"]], named[-1]))
    for number, rank in enumerate(ranks):
        ids = rank["ids"][rank["cells"]]
        if any(seen[int(i)] != tuple(sorted(e)) for i, e in zip(rank["cell_ids"][rank["ghost"]], ids[rank["ghost"]])):
            fail(f"a ghost of rank {number} is another element for its owner")
    named = np.concatenate(named)
    corners = {3: 3, 4: 4, 6: 3, 10: 4}[named.shape[1]]
    if named.shape[1] > corners:
        check_middles(named, corners, places)
    named = named[:, :corners]
    p = places[named]
    if named.shape[1] == 4:
        measures = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6
    else:
        measures = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    if np.any(measures <= 0):
        fail("elements turned inside out")
    sides = np.sort(np.concatenate([np.delete(named, k, axis=1) for k in range(corners)]), axis=1)
    uses = np.unique(sides, axis=0, return_counts=True)[1]
    if np.any(uses > 2):
        fail("sides with more than two elements")
    copies = sum(int(rank["foreign"].sum()) for rank in ranks)
    ghosts = sum(int(rank["ghost"].sum()) for rank in ranks)
    print(f"{elements} elements, {vertices} vertices, {int((uses == 1).sum())} boundary sides, measure "
          f"{measures.sum():.9f}, {copies} copies, {ghosts} ghosts")


def check_types(grid, nodes):
    """VTK's of simplices, by the number of nodes."""
    if {grid.GetCellType(i) for i in range(len(nodes))} != {{3: 5, 4: 10, 6: 22, 10: 24}[nodes.shape[1]]}:
        fail("types of cells")


def check_pvtu(folder, count):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

    def arrays(grid):
        points, cells = grid.GetPointData(), grid.GetCellData()
        offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
        nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(len(offsets) - 1, -1)
        check_types(grid, nodes)
        return {"points": vtk_to_numpy(grid.GetPoints().GetData()),
                "ids": vtk_to_numpy(points.GetGlobalIds()),
                "foreign": vtk_to_numpy(points.GetArray("vtkGhostType")) == 1,
                "cells": nodes,
                "cell_ids": vtk_to_numpy(cells.GetGlobalIds()),
                "ghost": vtk_to_numpy(cells.GetArray("vtkGhostType")) == 1,
                "owner": vtk_to_numpy(points.GetArray("owner"))}

    ranks = [arrays(read_by_vtk(vtkXMLUnstructuredGridReader(), f"{folder}/ranks_{q:04}.vtu")) for q in range(count)]
    for number, rank in enumerate(ranks):
        if not np.array_equal(rank["owner"] != number, rank["foreign"]):
            fail(f"rank {number}: ghost types and owners differ")
    whole = arrays(read_by_vtk(vtkXMLPUnstructuredGridReader(), f"{folder}/ranks.pvtu"))
    for name in whole:
        if not np.array_equal(whole[name] if name != "cells" else whole["ids"][whole["cells"]],
                              np.concatenate([r[name] if name != "cells" else r["ids"][r["cells"]] for r in ranks])):
            fail(f"the PVTU has other {name} than its files")
    check_ranks(ranks)


def check_xdmf(folder, count):
    """h5py, by the names that the XDMF file and PETSc go by."""
    import xml.etree.ElementTree

    import h5py

    grid = xml.etree.ElementTree.parse(f"{folder}/ranks.xdmf").getroot().find("Domain/Grid")
    with h5py.File(f"{folder}/ranks.h5") as file:
        def values(item):
            name, path = item.text.split(":")
            array = file[path]
            if name != "ranks.h5" or [int(n) for n in item.get("Dimensions").split()] != list(array.shape):
                fail(f"the XDMF file says otherwise of {path}")
            return array[:]

        cells, points = values(grid.find("Topology/DataItem")), values(grid.find("Geometry/DataItem"))
        kinds = {3: "Triangle", 4: "Tetrahedron", 6: "Triangle_6", 10: "Tetrahedron_10"}
        if grid.find("Topology").get("TopologyType") != kinds[cells.shape[1]]:
            fail("what the XDMF file says that elements are")
        if file["viz/topology/cells"].attrs["cell_corners"] != cells.shape[1]:
            fail("what PETSc is told of elements")
        attributes = {a.get("Name"): values(a.find("DataItem")) for a in grid.findall("Attribute")}
        if not np.array_equal(cells, file["viz/topology/cells"][:]) or len(attributes["subdomain"]) != len(cells):
            fail("arrays of other names")
        first_vertex, first_cell = file["ranks/first_vertex"][:], file["ranks/first_cell"][:]
        sides, cad = file["sides/vertices"][:], file["sides/cad"][:]
        if len(first_vertex) != count + 1 or len(sides) != len(cad) or np.any(cad < 0):
            fail("sides or ranks")
        first_side = file["ranks/first_side"][:]
        if len(first_side) != count + 1 or first_side[0] != 0 or first_side[-1] != len(sides):
            fail("where sides of ranks begin")
        for q in range(count):  # each is a side of an element of its rank
            of_rank = cells[first_cell[q]:first_cell[q + 1], :sides.shape[1] + 1]
            of_cells = {tuple(sorted(c)) for cell in of_rank for c in itertools.combinations(cell, sides.shape[1])}
            if not {tuple(sorted(side)) for side in sides[first_side[q]:first_side[q + 1]]} <= of_cells:
                fail(f"rank {q} has sides of no element of it")
        if "sides/patch" in file:  # not of triangles
            names = file["names/patches"].asstr()[:]
            print("sides by patch:", {names[p]: int(n) for p, n in
                                      zip(*np.unique(file["sides/patch"][:], return_counts=True))})
        print("regions:", file["names/regions"].asstr()[:].tolist())
        if len(np.unique(file["vertices/mesh_node"][:])) != len(points):
            fail("numbers of vertices")
    ranks = []
    for q in range(count):
        own = np.arange(first_vertex[q], first_vertex[q + 1])
        of_rank = cells[first_cell[q]:first_cell[q + 1]]
        ids = np.concatenate([own, np.setdiff1d(of_rank, own)])
        local = np.searchsorted(ids, of_rank, sorter=np.argsort(ids))
        ranks.append({"points": points[ids], "ids": ids, "foreign": np.arange(len(ids)) >= len(own),
                      "cells": np.argsort(ids)[local], "cell_ids": np.arange(first_cell[q], first_cell[q + 1]),
                      "ghost": np.zeros(len(of_rank), bool)})
    check_ranks(ranks)


def check_vtkhdf(folder, count):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader

    grid = read_by_vtk(vtkHDFReader(), f"{folder}/ranks.vtkhdf")
    points, cells = grid.GetPointData(), grid.GetCellData()
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    whole = {"points": vtk_to_numpy(grid.GetPoints().GetData()),
             "ids": vtk_to_numpy(points.GetArray("GlobalNodeIds")),
             "foreign": vtk_to_numpy(points.GetArray("vtkGhostType")) == 1,
             "cells": vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(len(offsets) - 1, -1),
             "cell_ids": vtk_to_numpy(cells.GetArray("GlobalCellIds")),
             "ghost": vtk_to_numpy(cells.GetArray("vtkGhostType")) == 1}
    if vtk_to_numpy(points.GetArray("owner")).max() != count - 1:
        fail("owners")
    check_types(grid, whole["cells"])
    check_ranks([whole])  # VTK reads all partitions into one


def check_agreement(folder, count):
    """PVTU, XDMF, VTKHDF and MFEM of one mesh say the same of each element and vertex, and that of the subdomains' own
    VTU."""
    import h5py
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

    def arrays(reader, name):
        grid = read_by_vtk(reader, f"{folder}/{name}")
        points, cells = grid.GetPointData(), grid.GetCellData()
        return ((lambda array: vtk_to_numpy(points.GetArray(array))),
                (lambda array: vtk_to_numpy(cells.GetArray(array))),
                vtk_to_numpy(grid.GetPoints().GetData()),
                vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1))

    with h5py.File(f"{folder}/ranks.h5") as file:
        points, cells = file["geometry/vertices"][:], file["viz/topology/cells"][:]
        nodes = file["vertices/mesh_node"][:]
        elements = {name: file[f"cells/{name}"][:] for name in ("mesh_element", "subdomain", "region")}
        first_vertex = file["ranks/first_vertex"][:]
        sides = np.unique(file["sides/cad"][:], return_counts=True)
    for reader, name in ((vtkXMLPUnstructuredGridReader(), "ranks.pvtu"), (vtkHDFReader(), "ranks.vtkhdf")):
        of_points, of_cells, places, connectivity = arrays(reader, name)
        ids = of_points("GlobalNodeIds")
        if not np.array_equal(places, points[ids]):
            fail(f"points of {name} and ranks.h5")
        if not np.array_equal(ids[connectivity], cells[of_cells("GlobalCellIds")]):
            fail(f"elements of {name} and ranks.h5")
        owners = np.searchsorted(first_vertex, ids, side="right") - 1
        if not np.array_equal(of_points("mesh_node"), nodes[ids]):
            fail(f"mesh_node of {name} and ranks.h5")
        if not np.array_equal(of_points("owner"), owners) or owners.max() != count - 1:
            fail(f"owners of {name} and ranks.h5")
        for array, values in elements.items():
            if not np.array_equal(of_cells(array), values[of_cells("GlobalCellIds")]):
                fail(f"{array} of {name} and ranks.h5")
    ranks = [read_mfem(f"{folder}/mesh.{q:06}") for q in range(count)]
    if not np.array_equal(np.concatenate([rank["points"][rank["cells"]] for rank in ranks]), points[cells]):
        fail("elements of MFEM's files and ranks.h5")
    _, of_cells, _, _ = arrays(vtkXMLPUnstructuredGridReader(), "mesh.pvtu")
    for array in ("subdomain", "region"):
        if not np.array_equal(of_cells(array)[elements["mesh_element"]], elements[array]):
            fail(f"{array} of mesh.pvtu and ranks.h5")
    print("sides by cad:", dict(zip(map(int, sides[0]), map(int, sides[1]))))


def mfem_edges(cells):
    """The edges as MFEM numbers them: as they are first met in its tetrahedra, whose own are in this order."""
    numbers = {}
    for cell in cells:
        for a, b in ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)):
            numbers.setdefault(tuple(sorted((cell[a], cell[b]))), len(numbers))
    return numbers


def read_mfem(path):
    """What mfem::ParMesh reads: words one after the other, where comments may stand between sections. With a grid
    function of nodes, cells have those in the middle of their edges too, in VTK's order."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if not text.startswith("MFEM mesh v1.2\n"):
        fail(f"the first line of {path}")
    space = "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P2\nVDim: 3\nOrdering: 1\n"
    is_quadratic = space in text  # these MFEM reads by lines
    lines = text.replace(space, "\n").split("\n")[1:]
    words = iter(" ".join(line for line in lines if not line.startswith("#")).split())

    def expect(*names):
        for name in names:
            if (found := next(words)) != name:
                fail(f"{path} has {found} where {name} should be")

    def table(columns):
        return np.array([int(next(words)) for _ in range(int(next(words)) * columns)], int).reshape(-1, columns)

    expect("dimension", "3", "elements")
    elements = table(6)
    expect("boundary")
    boundary = table(5)
    expect("vertices")
    count = corners = int(next(words))
    cells, edges = elements[:, 2:], {}
    if is_quadratic:
        edges = {edge: corners + number for edge, number in mfem_edges(cells).items()}
        count += len(edges)
        middles = [[edges[tuple(sorted(edge))] for edge in cells[:, ends]] for ends in EDGES[4]]
        cells = np.column_stack([cells, *middles])
    else:
        expect("3")
    points = np.array([float(next(words)) for _ in range(3 * count)]).reshape(-1, 3)
    if np.any(elements[:, 1] != 4) or np.any(boundary[:, 1] != 2):
        fail(f"{path} has other cells than tetrahedra, or other sides than triangles")
    expect("mfem_serial_mesh_end", "communication_groups", "number_of_groups")
    sharers = [tuple(int(next(words)) for _ in range(int(next(words)))) for _ in range(int(next(words)))]
    totals = {}
    for of in ("vertices", "edges", "faces"):
        expect(f"total_shared_{of}")
        totals[of] = int(next(words))
    shared = {}
    for group in sharers[1:]:
        of_group = shared[group] = {}
        for of, columns in (("vertices", 1), ("edges", 2), ("faces", 4)):
            expect(f"shared_{of}")
            of_group[of] = table(columns)
            totals[of] -= len(of_group[of])
    expect("mfem_mesh_end")
    if any(totals.values()) or next(words, None) is not None:
        fail(f"{path} does not have as much as it says")
    if len(np.unique(elements[:, 2:])) != corners:
        fail(f"{path} has vertices of no element")
    return {"points": points, "cells": cells, "middles": edges, "attributes": elements[:, 0], "boundary": boundary,
            "self": sharers[0], "shared": shared}


def check_mfem(folder, count):
    """The reader above; what ranks share must be in the same order everywhere, and be all that is at the same place."""
    files = [read_mfem(f"{folder}/mesh.{q:06}") for q in range(count)]
    for q, file in enumerate(files):
        foreign = file["foreign"] = np.zeros(len(file["points"]), bool)
        faces = {tuple(sorted(np.delete(cell[:4], k))) for cell in file["cells"] for k in range(4)}
        edges = {tuple(sorted((cell[a], cell[b]))) for cell in file["cells"] for a in range(4) for b in range(a)}
        if file["self"] != (q,):
            fail(f"rank {q} says it is {file['self']}")
        for group, here in file["shared"].items():
            if q not in group or list(group) != sorted(set(group)) or not len(here["vertices"]) + len(here["edges"]):
                fail(f"rank {q}: group {group}")
            if len(here["faces"]) and (len(group) != 2 or np.any(here["faces"][:, 0] != 2)):
                fail(f"rank {q}: faces of {group}")
            here["faces"] = here["faces"][:, 1:]
            for of, known in (("edges", edges), ("faces", faces)):
                if not all(tuple(sorted(vertices)) in known for vertices in here[of]):
                    fail(f"rank {q} has no such {of} as it shares with {group}")
            here["nodes"] = [*here["vertices"].ravel(), *(file["middles"][tuple(sorted(edge))] for edge in here["edges"]
                                                          if file["middles"])]
            foreign[here["nodes"]] = group[0] < q
    first = 0
    for q, file in enumerate(files):
        file["ids"] = np.full(len(file["points"]), -1)
        own = np.flatnonzero(~file["foreign"])
        file["ids"][own] = np.arange(first, first + len(own))
        first += len(own)
        for group, here in file["shared"].items():
            if group[0] < q:
                there = files[group[0]]["shared"].get(group)
                if there is None or len(there["nodes"]) != len(here["nodes"]):
                    fail(f"rank {q} and {group[0]} differ in what {group} share")
                file["ids"][here["nodes"]] = files[group[0]]["ids"][there["nodes"]]
    for q, file in enumerate(files):
        for group, here in file["shared"].items():
            for other in group:
                there = files[other]["shared"].get(group)
                if there is None or any(not np.array_equal(file["ids"][here[of]], files[other]["ids"][there[of]])
                                        for of in ("vertices", "edges", "faces")):
                    fail(f"rank {q} and {other} differ in what {group} share")
    # All that elements of two ranks have in common is shared.
    for of, columns in (("vertices", 1), ("edges", 2), ("faces", 3)):
        holders = {}
        for q, file in enumerate(files):
            local = {tuple(sorted(file["ids"][list(c)])) for cell in file["cells"]
                     for c in itertools.combinations(cell[:4], columns)}
            for key in local:
                holders.setdefault(key, []).append(q)
        listed = {tuple(sorted(file["ids"][v])): group for file in files
                  for group, here in file["shared"].items() for v in here[of]}
        if listed != {key: tuple(group) for key, group in holders.items() if len(group) > 1}:
            fail(f"not all {of} that ranks share are listed, or in another group")
    sides = np.concatenate([np.sort(file["ids"][file["boundary"][:, 2:]], axis=1) for file in files])
    if len(np.unique(sides, axis=0)) != len(sides):
        fail("a boundary element is there twice")
    first = 0
    for file in files:
        file["cell_ids"] = np.arange(first, first + len(file["cells"]))
        file["ghost"] = np.zeros(len(file["cells"]), bool)
        first += len(file["cells"])
    check_ranks(files)
    values, counts = np.unique(np.concatenate([file["boundary"][:, 0] for file in files]), return_counts=True)
    print("boundary elements by attribute:", dict(zip(values.tolist(), counts.tolist())), "materials:",
          np.unique(np.concatenate([file["attributes"] for file in files])).tolist())


def check_openfoam(folder, count):
    """OpenFOAM's own checkMesh, on all processors at once, and on the whole that reconstructParMesh makes of these."""
    environment = dict(os.environ, WM_PROJECT_DIR="/usr/share/openfoam", OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_btl_vader_single_copy_mechanism="none",
                       OMPI_MCA_mpi_yield_when_idle="1")

    def run(*command):
        done = subprocess.run([*command, "-case", folder], env=environment, capture_output=True, text=True, check=False)
        print(done.stdout, done.stderr)
        return done.returncode == 0 and (command[0] == "reconstructParMesh" or "Mesh OK." in done.stdout)

    if count > 1:
        if not run("mpirun", "--oversubscribe", "-n", str(count), "checkMesh", "-parallel", "-constant", "-allTopology"):
            fail("checkMesh is not content")
        if not run("reconstructParMesh", "-constant"):
            fail("reconstructParMesh is not content")
    if not run("checkMesh", "-constant", "-allTopology"):
        fail("checkMesh is not content with the whole")


if __name__ == "__main__":
    globals()[f"check_{sys.argv[1]}"](sys.argv[2], int(sys.argv[3]))
