#!/usr/bin/python3
"""Linear finite elements on a CAD part with PETSc, by several processes: -laplace(u) = f, u given on the boundary.
Vertices are numbered as PETSc numbers rows: a process owns the rows of its vertices, and nothing is renumbered. For a
part of one solid.

    dovetail mesh part.step --ranks 4 --format xdmf --out part
    mpirun -n 4 examples/13_poisson_petsc.py part/ranks.h5 [SOLUTION.npy]

SOLUTION.npy gets u in the order of the mesh's own numbers."""

import sys

import numpy as np
from petsc4py import PETSc

from rank_file import places, read_share, write_by_nodes


def exact(points, k=np.array([4, 5, 3]) / 37):
    return np.sin(points @ k), k @ k * np.sin(points @ k)


def elements_of(share):
    """Stiffness (elements, 4, 4), volumes and centres of linear elements."""
    corners = share["points"][places(share, share["cells"])]
    edges = corners[:, 1:] - corners[:, :1]
    gradients = np.linalg.inv(edges).transpose(0, 2, 1)
    gradients = np.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
    volumes = np.linalg.det(edges) / 6
    return volumes[:, None, None] * gradients @ gradients.transpose(0, 2, 1), volumes, corners.mean(axis=1)


world = PETSc.COMM_WORLD
share = read_share(sys.argv[1], world.rank, world.size)
owned = share["owned"]
stiffness, volumes, centres = elements_of(share)
cells = share["cells"].astype(PETSc.IntType)

matrix = PETSc.Mat().createAIJ(((owned, None), (owned, None)), comm=world)
matrix.setPreallocationNNZ((40, 20))
matrix.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
# Row after row of each element; what it adds to rows of other processes PETSc sends there.
matrix.setValuesIJV(np.arange(0, 4 * cells.size + 1, 4, cells.dtype), np.repeat(cells, 4, axis=0).ravel(),
                    stiffness.ravel(), rowmap=cells.ravel(), addv=PETSc.InsertMode.ADD_VALUES)
matrix.assemble()
u, load = matrix.createVecs()
load.setValues(cells.ravel(), np.repeat(volumes * exact(centres)[1] / 4, 4), addv=PETSc.InsertMode.ADD_VALUES)
load.assemble()

u.setArray(exact(share["points"][:owned])[0])
boundary = np.unique(share["sides"]).astype(PETSc.IntType)  # of some CAD faces: share["sides"][share["cad"] == face]
matrix.zeroRowsColumns(boundary, x=u, b=load)
u.set(0)

solver = PETSc.KSP().create(world)
solver.setOperators(matrix)
solver.setType(PETSc.KSP.Type.CG)
solver.getPC().setType(PETSc.PC.Type.JACOBI)
solver.setTolerances(rtol=1e-13)
solver.solve(load, u)
if solver.reason < 0:
    sys.exit(f"not solved: {solver.reason}")

error = np.abs(u.array - exact(share["points"][:owned])[0])
largest = world.tompi4py().allreduce(error.max(initial=0), op=max)
PETSc.Sys.Print(f"{matrix.size[0]} vertices on {world.size} processes: {solver.its} steps, largest error {largest:.6e}")
if len(sys.argv) > 2:
    write_by_nodes(sys.argv[2], share["nodes"][:owned], u.array)
