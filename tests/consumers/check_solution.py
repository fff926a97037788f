#!/usr/bin/python3
"""An example that solves a Poisson problem: the solution is near the exact one, and the same for one process, four,
and for other processes than the file has ranks: check_solution.py DRIVER PART MPIEXEC EXAMPLE"""

import re
import sys
import tempfile

import numpy as np

from meshes import make_mesh, run_on

driver, part, mpiexec, example = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    meshes = {ranks: make_mesh(driver, part, f"{folder}/{ranks}", ranks) for ranks in (1, 4)}
    solutions = []
    for ranks, processes in ((1, 1), (4, 4), (4, 3)):
        said = run_on(mpiexec, processes, example, meshes[ranks], f"{folder}/solution.npy")
        print(f"of {ranks} ranks: {said}", end="")
        told = re.fullmatch(r"(\d+) vertices on (\d+) processes: \d+ steps, largest error (\S+)\n", said)
        if told is None:
            sys.exit("these are not the words that were expected")
        counted, on, error = told.groups()
        solutions.append(np.load(f"{folder}/solution.npy"))
        if int(on) != processes or int(counted) != len(solutions[-1]) or not float(error) < 0.02:
            sys.exit("the solution is wrong")
alone = solutions[0]
if len(alone) < 1000 or np.ptp(alone) < 1:
    sys.exit("there is no solution to compare")
for other in solutions[1:]:
    difference = np.abs(alone - other).max() if alone.shape == other.shape else np.inf
    print(f"largest difference from one process: {difference:.1e}")
    if not difference < 1e-8:
        sys.exit("the number of processes changes the solution")
