#!/usr/bin/python3
"""What it costs to compile: processor time and memory, median of repeats. A header is parsed and checked only;
a program is compiled at -O2, header-only and with the compiled libraries.

  headers.py [--compiler g++] [--repeats 3] [--flags FILE] [--way header-only|compiled] [--at-most-megabytes N]
             [--at-most-references N] [HEADER|PROGRAM...]

HEADER is a path under include/, PROGRAM one of a .cpp file (default: the umbrella, the headers it includes, and the
first example). FILE has one flag a line; without it Open CASCADE is taken from /usr/include/opencascade. With a
limit, ends with an error when a compilation needs more memory than that, or more than N times the time of a reference: a
short program with <regex> and <iostream>, compiled before and behind it.
"""
import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = ROOT / "include"
UMBRELLA = "dovetail/dovetail.hpp"
EXAMPLE = str(ROOT / "examples/01_mesh_a_cad_file.cpp")
FLAGS = ["-std=c++20", f"-I{INCLUDE}", "-isystem/usr/include/opencascade", "-DTETLIBRARY"]
REFERENCE = """#include <iostream>
#include <regex>
int main(int count, char** words) {
  for (int i = 1; i < count; ++i)
    std::cout << std::regex_replace(words[i], std::regex("([a-z]+)[.]([0-9]*)"), "$2") << std::endl;
}
"""
WAYS = {"header-only": [], "compiled": ["-DDOVETAIL_COMPILED", "-DDOVETAIL_COMPILED_OCCT", "-DDOVETAIL_COMPILED_CGAL"]}


def default_units():
    return [UMBRELLA, *re.findall(r'#include "(.*)"', (INCLUDE / UMBRELLA).read_text()), EXAMPLE]


def cost(command):
    """Seconds of processor time and megabytes (10^6 bytes) of one compilation."""
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"{command[-1]} does not compile")
    # The driver's peak is its child's: wait4 counts a process with those it waited for.
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    arguments.add_argument("--compiler", default="g++")
    arguments.add_argument("--repeats", type=int, default=3)
    arguments.add_argument("--flags", type=pathlib.Path)
    arguments.add_argument("--way", choices=WAYS)
    arguments.add_argument("--at-most-megabytes", type=float)
    arguments.add_argument("--at-most-references", type=float)
    arguments.add_argument("units", nargs="*")
    given = arguments.parse_args()
    flags = given.flags.read_text().split() if given.flags else FLAGS
    too_heavy, too_long = [], []
    print("| compiled | seconds | MB |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        header_unit = pathlib.Path(folder) / "unit.cpp"
        reference = pathlib.Path(folder) / "reference.cpp"
        reference.write_text(REFERENCE)

        def reference_seconds():
            output = os.path.join(folder, "reference.o")
            return cost([given.compiler, "-std=c++20", "-O2", "-c", "-o", output, str(reference)])[0]

        for unit in given.units or default_units():
            is_program = unit.endswith(".cpp")
            header_unit.write_text(f'#include "{unit}"\n')
            source = unit if is_program else str(header_unit)
            what = ["-O2", "-c", "-o", os.path.join(folder, "unit.o")] if is_program else ["-fsyntax-only"]
            for way in [given.way] if given.way else WAYS:
                command = [given.compiler, *flags, *WAYS[way], *what, source]
                before = reference_seconds() if given.at_most_references else 0
                runs = [cost(command) for _ in range(given.repeats)]
                seconds, megabytes = (statistics.median(column) for column in zip(*runs))
                name = f"{os.path.basename(unit) if is_program else unit}, {way}"
                print(f"| {name} | {seconds:.1f} | {megabytes:.0f} |", flush=True)
                if given.at_most_megabytes and megabytes > given.at_most_megabytes:
                    too_heavy.append(name)
                if given.at_most_references:
                    references = seconds / (0.5 * (before + reference_seconds()))
                    print(f"  {references:.2f} times the reference", flush=True)
                    if references > given.at_most_references:
                        too_long.append(name)
    if too_long:
        sys.exit(f"more than {given.at_most_references:g} times the reference: {', '.join(too_long)}")
    if too_heavy:
        sys.exit(f"more than {given.at_most_megabytes:.0f} MB: {', '.join(too_heavy)}")


if __name__ == "__main__":
    main()
