#!/usr/bin/python3
"""An example that solves a Poisson problem: the solution tends to the exact one as the mesh gets finer, and is the same
for one process, four, and for other processes than the file has ranks: check_solution.py DRIVER PART MPIEXEC EXAMPLE"""

import re
import sys
import tempfile

import numpy as np

from meshes import make_mesh, run_on

driver, part, mpiexec, example = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    coarse, fine = 2, 1.4  # half as large squared: linear elements should have half the error
    runs = [(coarse, 1, 1), (coarse, 4, 4), (coarse, 4, 3), (fine, 1, 1)]
    meshes = {
        (size, ranks): make_mesh(driver, part, f"{folder}/{size}_{ranks}", ranks, size)
        for size, ranks in {(size, ranks) for size, ranks, _ in runs}
    }
    solutions = []
    errors = []
    for size, ranks, processes in runs:
        said = run_on(mpiexec, processes, example, meshes[size, ranks], f"{folder}/solution.npy")
        print(f"size {size}, of {ranks} ranks: {said}", end="")
        told = re.fullmatch(r"(\d+) vertices on (\d+) processes: \d+ steps, largest error (\S+)\n", said)
        if told is None:
            sys.exit("these are not the words that were expected")
        counted, on, error = told.groups()
        solutions.append(np.load(f"{folder}/solution.npy"))
        errors.append(float(error))
        if int(on) != processes or int(counted) != len(solutions[-1]) or not errors[-1] < 0.03:
            sys.exit("the solution is wrong")
if not errors[-1] < 0.75 * errors[0]:
    sys.exit("the solution does not tend to the exact one")
alone = solutions[0]
if len(alone) < 1000 or np.ptp(alone) < 1:
    sys.exit("there is no solution to compare")
for other in solutions[1:-1]:
    difference = np.abs(alone - other).max() if alone.shape == other.shape else np.inf
    print(f"largest difference from one process: {difference:.1e}")
    if not difference < 1e-8:
        sys.exit("the number of processes changes the solution")
