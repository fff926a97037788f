#!/usr/bin/python3
"""Measures the memory of `dovetail mesh` as the mesh grows: memory.py BUILD MODEL [options]

Runs the driver at sizes that give the wanted numbers of elements, nothing written, as one process with a worker and as so
many ranks as --ranks says, each with a worker. A process that computes, and with ranks the largest of them, is sampled: its
peak, and the most that it and its worker are seen to have together, where what they share counts once; the larger is a
rank's memory. It prints a markdown table of these beside the bound that the first is held to,

    60 MB + 550 bytes per background element + 60 bytes per side of the skeleton,

and then the constants, none negative, of

    a + b x background elements + c x sides of the skeleton + d x elements of the largest piece

that fit the memory of the ranks best, and the worst residual. Options of the driver that --vary adds, --vary='--coarsening 1'
or --vary='--subdomains 8', vary one of them without the others. Memory hardly depends on what else the machine does.
"""

import argparse
import itertools
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time

import numpy

from pipeline import Failure, find_size, read_json
from ranks_environment import ENVIRONMENT

MB = 1e6


def bound_of_parent(background_elements, sides):
    return 60 * MB + 550 * background_elements + 60 * sides


def children_of(processes):
    found = []
    for process in processes:
        try:
            for of_thread in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
                found += map(int, of_thread.read_text(encoding="ascii").split())
        except (FileNotFoundError, ProcessLookupError):
            pass
    return found


def status_of(process, file, field):
    """Bytes; 0 when the process has ended."""
    try:
        with open(f"/proc/{process}/{file}", encoding="ascii") as lines:
            return max((1024 * int(line.split()[1]) for line in lines if line.startswith(field)), default=0)
    except (FileNotFoundError, ProcessLookupError):
        return 0


def sample(process, ranks):
    """Bytes, of the largest process that computes (the driver's child, or the child of a child of mpirun): its peak, and
    what it has now together with its workers."""
    computing = [process.pid]
    for _ in range(1 if ranks == 1 else 2):
        computing = children_of(computing)
    peak = max((status_of(each, "status", "VmHWM:") for each in computing), default=0)
    together = max((sum(status_of(each, "smaps_rollup", "Pss:") for each in [one, *children_of([one])])
                    for one in computing), default=0)
    return peak, together


def measure(driver, model, size, ranks, options, folder, limit):
    report = os.path.join(folder, "report.json")
    command = [driver, "mesh", model, "--size", repr(size), "--format", "none", "--workers", "1", "--quiet",
               "--out", os.path.join(folder, "out"), "--report", report] + options
    if ranks > 1:
        command = ["mpirun", "-n", str(ranks)] + command + ["--rank-group", "1"]
    end = time.monotonic() + limit
    peak = together = 0
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          env=os.environ | ENVIRONMENT) as process:
        while process.poll() is None:
            now = sample(process, ranks)
            peak, together = max(peak, now[0]), max(together, now[1])
            if time.monotonic() > end:
                process.kill()
                raise Failure(f"no mesh of size {size} within {limit} s")
            time.sleep(0.05)
    if process.returncode != 0:
        raise Failure(f"{' '.join(command)}: exit status {process.returncode}")
    return peak, max(peak, together), read_json(report)  # a peak may be between two samples


def fit(rows, peaks):
    """The constants of least relative error, none negative, and the largest relative residual."""
    rows, peaks = numpy.array(rows, float), numpy.array(peaks, float)
    used = list(range(rows.shape[1]))
    while True:
        found = numpy.linalg.lstsq(rows[:, used] / peaks[:, None], numpy.ones(len(peaks)), rcond=None)[0]
        if found.min() >= 0:
            break
        used.pop(int(found.argmin()))
    constants = numpy.zeros(rows.shape[1])
    constants[used] = found
    return constants, float(numpy.abs(rows @ constants / peaks - 1).max())


def counters_of(report, stage):
    """Of a stage of the run; steps of other stages may have its name."""
    generate = next(part for part in report["details"]["children"] if part["name"] == "generate")
    return next(part["counters"] for part in generate["children"] if part["name"] == stage)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("build")
    options.add_argument("model")
    options.add_argument("--elements", default="5e6,20e6,50e6", help="wanted numbers, by commas (default %(default)s)")
    options.add_argument("--ranks", default="1", help="by commas; 1 is without MPI (default %(default)s)")
    options.add_argument("--vary", action="append", default=[""], help="options of the driver, for more runs")
    options.add_argument("--limit", type=float, default=3600, help="seconds per run (default %(default)s)")
    given = options.parse_args()
    driver = os.path.join(given.build, "app", "dovetail")
    print("| ranks | elements | background | sides | largest piece | computing process, MB | bound, MB | rank, MB |")
    print("|---|---|---|---|---|---|---|---|")
    rows, memory = [], []
    for elements in map(float, given.elements.split(",")):
        with tempfile.TemporaryDirectory() as folder:
            size = find_size(driver, given.model, elements, folder, given.limit)
        for ranks, extra in itertools.product(map(int, given.ranks.split(",")), given.vary):
            with tempfile.TemporaryDirectory() as folder:
                peak, together, report = measure(driver, given.model, size, ranks, shlex.split(extra), folder,
                                                 given.limit)
            sides = counters_of(report, "skeleton")["triangles"]
            background = report["background_elements"]
            largest = round(report["imbalance"] * report["elements"] / report["subdomains"])
            print(f"| {ranks} | {report['elements']:,} | {background:,} | {sides:,.0f} | {largest:,} | {peak / MB:.0f} | "
                  f"{bound_of_parent(background, sides) / MB:.0f} | {together / MB:.0f} |", flush=True)
            rows.append([1, background, sides, largest])
            memory.append(together)
    if len(memory) > 4:
        (a, b, c, d), worst = fit(rows, memory)
        print(f"\na rank: {a / MB:.0f} MB + {b:.0f} bytes per background element + {c:.0f} per side + {d:.0f} per element of "
              f"the largest piece; worst residual {100 * worst:.1f} %")


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"memory.py: {failure}")
