#!/usr/bin/python3
"""PETSc's own reader of HDF5 files, on one process and on four; the order that it wants tetrahedra in; and the arrays
that `rank_mesh` has in memory, given to `DMPlexCreateFromCellListParallel`:
check_plex.py DRIVER PART MPIEXEC"""

import ctypes
import os
import re
import sys
import tempfile

import h5py
import numpy as np

from meshes import make_mesh, run_on


def read(path):
    import petsc4py

    petsc4py.init([sys.argv[0], "-dm_plex_create_from_hdf5_xdmf", "-dm_plex_check_geometry"])
    from petsc4py import PETSc

    world = PETSc.COMM_WORLD.tompi4py()
    plex = PETSc.DMPlex().createFromFile(path)
    plex.setFromOptions()  # checks that no cell is turned inside out
    first, end = plex.getHeightStratum(0)
    volume = world.allreduce(sum(plex.computeCellGeometryFVM(cell)[0] for cell in range(first, end)))
    cells = world.allreduce(end - first)
    if world.rank == 0:
        print(f"{cells} cells, volume {volume:.12g}")
    if world.size > 1:
        return
    with h5py.File(path, "r") as file:
        cells = file["viz/topology/cells"][:].astype(PETSc.IntType)
        points = file["geometry/vertices"][:]
    for order in ((0, 1, 2, 3), (1, 0, 2, 3)):
        plex = PETSc.DMPlex().createFromCellList(3, cells[:, order], points)
        try:
            plex.setFromOptions()
            print(f"right: {order}")
        except PETSc.Error:
            print(f"inside out: {order}")


def create(path):
    """Each process gives the elements of its share by ids, and the places of the vertices that it owns. petsc4py does not
    know the function."""
    sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "examples"))
    import petsc4py
    petsc4py.init([sys.argv[0]])
    from mpi4py import MPI
    from petsc4py import PETSc
    from rank_file import read_share

    petsc = ctypes.CDLL("libpetsc_real.so." + ".".join(map(str, PETSc.Sys.getVersion()[:2])))
    integer = ctypes.c_int64 if PETSc.IntType().itemsize == 8 else ctypes.c_int32

    def call(name, *arguments):
        if getattr(petsc, name)(*arguments) != 0:
            sys.exit(f"{name} fails")

    world = MPI.COMM_WORLD
    communicator = ctypes.c_void_p.from_address(MPI._addressof(world))  # a pointer, as it is in Open MPI
    share = read_share(path, world.rank, world.size)
    cells = np.ascontiguousarray(share["cells"][:, (1, 0, 2, 3)], PETSc.IntType)  # as `cells_for_dmplex` has them
    points = np.ascontiguousarray(share["points"][:share["owned"]])
    plex = ctypes.c_void_p()
    call("DMPlexCreateFromCellListParallelPetsc", communicator, integer(3), integer(len(cells)), integer(len(points)),
         integer(-1), integer(4), ctypes.c_int(1), ctypes.c_void_p(cells.ctypes.data), integer(3),
         ctypes.c_void_p(points.ctypes.data), None, None, ctypes.byref(plex))
    call("DMPlexCheckGeometry", plex)  # that no cell is turned inside out
    first, end = integer(), integer()
    call("DMPlexGetHeightStratum", plex, integer(0), ctypes.byref(first), ctypes.byref(end))
    volume, size, place = 0.0, ctypes.c_double(), (ctypes.c_double * 3)()
    for cell in range(first.value, end.value):
        call("DMPlexComputeCellGeometryFVM", plex, integer(cell), ctypes.byref(size), place, None)
        volume += size.value
    counts = world.allreduce(end.value - first.value), world.allreduce(volume)
    if world.rank == 0:
        print("{} cells, volume {:.12g}".format(*counts))


if sys.argv[1] in ("--read", "--create"):
    (read if sys.argv[1] == "--read" else create)(sys.argv[2])
    sys.exit()
driver, part, mpiexec = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    path = make_mesh(driver, part, folder, 4)
    with h5py.File(path, "r") as file:
        corners = file["geometry/vertices"][:][file["viz/topology/cells"][:]]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    for processes, how in ((1, "--read"), (4, "--read"), (1, "--create"), (4, "--create")):
        said = run_on(mpiexec, processes, __file__, how, path)
        print(said, end="")
        counted, measured = re.match(r"(\d+) cells, volume (\S+)\n", said).groups()
        if int(counted) != len(corners) or abs(float(measured) - volume) > 1e-9 * volume:
            sys.exit(f"PETSc has another mesh than {len(corners)} cells of {volume} by {how}")
        if processes == 1 and how == "--read" and "inside out: (0, 1, 2, 3)\nright: (1, 0, 2, 3)\n" not in said:
            sys.exit("PETSc wants tetrahedra in another order than cells_for_dmplex has")
