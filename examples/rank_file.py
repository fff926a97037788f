"""Reads `ranks.h5`, which `dovetail mesh PART --ranks N --format xdmf` writes: what one process of a parallel solver
has. Used by 13_poisson_petsc.py and 14_poisson_dolfinx.py."""

import h5py
import numpy as np


def read_share(path, process, processes):
    """Plain arrays for one process: the ranks of the file in blocks, one rank each when there are as many.

    owned   how many of its vertices the process owns
    ids     numbers of its vertices, from 0 over all processes: those that it owns, which are contiguous, then those
            that its elements need of other processes, growing
    points  (vertices, 3), where they are
    nodes   (vertices), their numbers in the mesh, which are the same for any number of ranks
    cells   (elements, 4), numbers of vertices; each element is in one process
    sides   (sides, 3), triangles on the CAD model, as numbers of vertices
    cad     (sides), the CAD face of each
    """
    with h5py.File(path, "r") as file:
        def begins(of):
            first = file["ranks/first_" + of][:]
            return [int(first[(len(first) - 1) * p // processes]) for p in (process, process + 1)]

        (first, end), (first_cell, end_cell), (first_side, end_side) = map(begins, ("vertex", "cell", "side"))
        cells = file["viz/topology/cells"][first_cell:end_cell]
        used = np.unique(cells)
        others = used[(used < first) | (used >= end)]
        points, nodes = file["geometry/vertices"], file["vertices/mesh_node"]
        return {
            "owned": end - first,
            "ids": np.concatenate([np.arange(first, end), others]),
            "points": np.concatenate([points[first:end], points[others]]),
            "nodes": np.concatenate([nodes[first:end], nodes[others]]),
            "cells": cells,
            "sides": file["sides/vertices"][first_side:end_side],
            "cad": file["sides/cad"][first_side:end_side],
        }


def places(share, vertices):
    """Where vertices given by number are among those of the process."""
    order = np.argsort(share["ids"])
    return order[np.searchsorted(share["ids"], vertices, sorter=order)]


def write_by_nodes(path, nodes, values):
    """Values of the vertices that each process owns, into a NumPy file of all, in the order of the mesh's numbers."""
    from mpi4py import MPI

    parts = MPI.COMM_WORLD.gather((nodes, values))
    if parts is not None:
        nodes, values = (np.concatenate(arrays) for arrays in zip(*parts))
        np.save(path, values[np.argsort(nodes)])
