"""Meshes of a CAD file for solvers, and programs on several processes."""

import subprocess
import sys


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))} fails:\n{done.stdout}{done.stderr}")
    return done.stdout


def make_mesh(driver, part, folder, ranks, size=2):
    """The HDF5 file of a mesh in 12 subdomains for a number of ranks."""
    run(driver, "mesh", part, "--size", size, "--subdomains", 12, "--ranks", ranks, "--format", "xdmf", "--out", folder,
        "--quiet")
    return f"{folder}/ranks.h5"


def run_on(mpiexec, processes, *command):
    return run(mpiexec, "-n", processes, "/usr/bin/python3", *command)
