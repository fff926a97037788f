#!/usr/bin/python3
"""PETSc's own reader of HDF5 files, on one process and on four; and the order that it wants tetrahedra in:
check_plex.py DRIVER PART MPIEXEC"""

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


if sys.argv[1] == "--read":
    read(sys.argv[2])
    sys.exit()
driver, part, mpiexec = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    path = make_mesh(driver, part, folder, 4)
    with h5py.File(path, "r") as file:
        corners = file["geometry/vertices"][:][file["viz/topology/cells"][:]]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    for processes in (1, 4):
        said = run_on(mpiexec, processes, __file__, "--read", path)
        print(said, end="")
        counted, measured = re.match(r"(\d+) cells, volume (\S+)\n", said).groups()
        if int(counted) != len(corners) or abs(float(measured) - volume) > 1e-9 * volume:
            sys.exit(f"PETSc reads another mesh than {len(corners)} cells of {volume}")
        if processes == 1 and "inside out: (0, 1, 2, 3)\nright: (1, 0, 2, 3)\n" not in said:
            sys.exit("PETSc wants tetrahedra in another order than cells_for_dmplex has")
