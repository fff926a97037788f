#!/usr/bin/python3
"""Linear finite elements on a CAD part with DOLFINx, by several processes: -laplace(u) = f, u given on the boundary.
Elements stay with the process that the file has them for. For a part of one solid.

    dovetail mesh part.step --ranks 4 --format xdmf --out part
    mpirun -n 4 examples/14_poisson_dolfinx.py part/ranks.h5 [SOLUTION.npy]

SOLUTION.npy gets u in the order of the mesh's own numbers."""

import sys

import numpy as np
import ufl
from dolfinx import cpp, fem, mesh
from dolfinx.fem.petsc import LinearProblem
from mpi4py import MPI

from rank_file import places, read_share, write_by_nodes


world = MPI.COMM_WORLD
share = read_share(sys.argv[1], world.rank, world.size)
owned = share["owned"]
ends = np.cumsum(world.allgather(len(share["cells"])))  # of the elements of each process


def stay(comm, processes, graph, with_ghosts):
    """A partitioner of DOLFINx: each element stays where it is, and is known where an element has a side with it."""
    owners = np.searchsorted(ends, graph.array, side="right")
    rows = [[world.rank, *set(owners[a:b]) - {world.rank}] for a, b in zip(graph.offsets, graph.offsets[1:])]
    offsets = np.cumsum([0] + [len(row) for row in rows], dtype=np.int32)
    return cpp.graph.AdjacencyList_int32(np.concatenate(rows).astype(np.int32), offsets)


linear = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.tetrahedron, 1))
domain = mesh.create_mesh(world, share["cells"], share["points"][:owned], linear, mesh.GhostMode.none,
                          cpp.mesh.create_cell_partitioner(stay))
domain.topology.create_connectivity(2, 3)

# The triangles on the CAD model, each where DOLFINx has it, and the CAD faces that they are on.
triangles, cad = cpp.io.distribute_entity_data(domain.ufl_domain().ufl_cargo(), 2, share["sides"], share["cad"])
faces = mesh.meshtags_from_entities(domain, 2, cpp.graph.AdjacencyList_int32(triangles), cad)

space = fem.FunctionSpace(domain, ("Lagrange", 1))
k = np.array([4, 5, 3]) / 37
given = fem.Function(space)
given.interpolate(lambda x: np.sin(k @ x))
boundary = faces.indices  # of some CAD faces: faces.find(face)
fixed = fem.dirichletbc(given, fem.locate_dofs_topological(space, 2, boundary))

u, v, x = ufl.TrialFunction(space), ufl.TestFunction(space), ufl.SpatialCoordinate(domain)
source = k @ k * ufl.sin(ufl.dot(ufl.as_vector(k), x))
problem = LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, source * v * ufl.dx, [fixed],
                        petsc_options={"ksp_type": "cg", "ksp_rtol": 1e-13, "pc_type": "jacobi"})
solution = problem.solve()

# The vertex of the file at each unknown: those of an element are in the same order in both lists.
vertices = np.empty(len(solution.x.array), np.int64)
vertices[space.dofmap.list.array] = np.array(domain.geometry.input_global_indices)[domain.geometry.dofmap.array]

largest = world.allreduce(np.abs(solution.x.array - given.x.array).max(initial=0), op=MPI.MAX)
here = slice(0, space.dofmap.index_map.size_local)  # the unknowns that DOLFINx gave to this process
if world.rank == 0:
    print(f"{space.dofmap.index_map.size_global} vertices on {world.size} processes: {problem.solver.its} steps, "
          f"largest error {largest:.6e}")
if len(sys.argv) > 2:
    write_by_nodes(sys.argv[2], share["nodes"][places(share, vertices[here])], solution.x.array[here])
