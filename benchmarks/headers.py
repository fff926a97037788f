#!/usr/bin/python3
"""What it costs to include a header: the compiler's time and memory, parsed and checked only, median of repeats.

  headers.py [--compiler g++] [--repeats 3] [--at-most-megabytes N] [HEADER...]

HEADER is a path under include/ (default: the umbrella and the stages it includes). With a limit, ends with an
error when a header needs more memory than that.
"""
import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

INCLUDE = pathlib.Path(__file__).resolve().parent.parent / "include"
UMBRELLA = "dovetail/dovetail.hpp"


def included_by_umbrella():
    return re.findall(r'#include "(.*)"', (INCLUDE / UMBRELLA).read_text())


def cost(compiler, header):
    """Seconds of processor time and megabytes (10^6 bytes) of one compilation."""
    with tempfile.TemporaryDirectory() as folder:
        unit = pathlib.Path(folder) / "unit.cpp"
        unit.write_text(f'#include "{header}"\n')
        command = [compiler, "-std=c++20", f"-I{INCLUDE}", "-fsyntax-only", str(unit)]
        process = subprocess.Popen(command)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"{header} does not compile")
    # The driver's peak is its child's: wait4 counts a process with those it waited for.
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    arguments.add_argument("--compiler", default="g++")
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--at-most-megabytes", type=float)
    arguments.add_argument("headers", nargs="*")
    given = arguments.parse_args()
    too_heavy = []
    print("| header | seconds | MB |\n|---|---|---|")
    for header in given.headers or [UMBRELLA, *included_by_umbrella()]:
        runs = [cost(given.compiler, header) for _ in range(given.repeats)]
        seconds, megabytes = (statistics.median(column) for column in zip(*runs))
        print(f"| {header} | {seconds:.2f} | {megabytes:.0f} |", flush=True)
        if given.at_most_megabytes and megabytes > given.at_most_megabytes:
            too_heavy.append(header)
    if too_heavy:
        sys.exit(f"more than {given.at_most_megabytes:.0f} MB: {', '.join(too_heavy)}")


if __name__ == "__main__":
    main()
