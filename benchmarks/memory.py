#!/usr/bin/python3
"""Measures the memory of `dovetail mesh` as the mesh grows: memory.py BUILD MODEL [options]

Runs the driver at sizes that give the wanted numbers of elements, two workers, nothing written, and samples the peak
of the parent process. It prints a markdown table: elements, background elements, sides of the fine skeleton, the peaks
of the parent and of the largest worker, and the parent's peak beside the bound that it is held to,

    150 MB + 150 bytes per background element + 60 bytes per side of the skeleton.

Memory hardly depends on what else the machine does.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time

from pipeline import Failure, find_size, read_json

MB = 1e6


def bound_of_parent(background_elements, sides):
    return 150 * MB + 150 * background_elements + 60 * sides


def peak_of(process):
    """Bytes, of the process that meshes: the command itself, or its child where it watches one; 0 when it has ended."""
    peak = 0
    try:
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as children:
            family = [process.pid, *map(int, children.read().split())]
        for member in family:
            with open(f"/proc/{member}/status", encoding="ascii") as status:
                peak = max(peak, *(1024 * int(line.split()[1]) for line in status if line.startswith("VmHWM")), 0)
    except (FileNotFoundError, ProcessLookupError):
        pass
    return peak


def measure(driver, model, size, folder, limit):
    report = os.path.join(folder, "report.json")
    command = [driver, "mesh", model, "--size", repr(size), "--format", "none", "--workers", "2", "--quiet",
               "--out", os.path.join(folder, "out"), "--report", report]
    end = time.monotonic() + limit
    peak = 0
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
        while process.poll() is None:
            peak = max(peak, peak_of(process))
            if time.monotonic() > end:
                process.kill()
                raise Failure(f"no mesh of size {size} within {limit} s")
            time.sleep(0.05)
    if process.returncode != 0:
        raise Failure(f"{' '.join(command)}: exit status {process.returncode}")
    return peak, read_json(report)


def counters_of(report, stage):
    """Of a stage of the run; steps of other stages may have its name."""
    generate = next(part for part in report["details"]["children"] if part["name"] == "generate")
    return next(part["counters"] for part in generate["children"] if part["name"] == stage)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("build")
    options.add_argument("model")
    options.add_argument("--elements", default="5e6,20e6,50e6", help="wanted numbers, by commas (default %(default)s)")
    options.add_argument("--limit", type=float, default=3600, help="seconds per run (default %(default)s)")
    given = options.parse_args()
    driver = os.path.join(given.build, "app", "dovetail")
    print("| elements | background | sides | parent, MB | bound, MB | largest worker, MB |")
    print("|---|---|---|---|---|---|")
    for elements in map(float, given.elements.split(",")):
        with tempfile.TemporaryDirectory() as folder:
            size = find_size(driver, given.model, elements, folder, given.limit)
            peak, report = measure(driver, given.model, size, folder, given.limit)
        sides = counters_of(report, "skeleton")["triangles"]
        background = report["background_elements"]
        worker = counters_of(report, "meshing")["peak_rss_bytes"]
        print(f"| {report['elements']:,} | {background:,} | {sides:,.0f} | {peak / MB:.0f} | "
              f"{bound_of_parent(background, sides) / MB:.0f} | {worker / MB:.0f} |", flush=True)


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"memory.py: {failure}")
