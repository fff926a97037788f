"""Compiles each header of one folder of the library alone, twice included, with the compiled library. What it defines is inline.

    check_alone.py <include directory> <folder under dovetail/> <file with flags> <compiler> <more flags...>

Most of the time would go to the standard's headers. So a header that includes one of the `hubs`, itself or through others, finds that
one precompiled. It sees the same declarations as without: what the hub has comes with its includes anyway, and that each of these
does not lean on what stands before it is seen where it is compiled alone itself.

The compiler may have a launcher in front (ccache: then a header that has not changed costs nothing). Works in the current folder.
With DOVETAIL_ALLOW_MISSING_LIBRARIES set, a header that includes a file of a library that is not there is passed over.
"""
import fcntl
import hashlib
import os
import pathlib
import re
import subprocess
import sys

# What many headers include, the most expensive first (by the characters that the preprocessor leaves).
hubs = ["models/occt/surface", "remesh/mesh_regions", "mesh/distributed_mesh", "parallel/any_communicator", "remesh/surfaces",
        "sizing/erased", "improver/triangles/operation_limits", "mesh/loaded_mesh", "improver/concepts", "models/occt/shape",
        "core/input_file", "core/output_file", "geometry/any_geometry", "mesh/adjacency", "simplification/concepts",
        "graph/csr_graph", "sizing/concepts", "parallel/communicator", "triangulation/triangulation", "core/progress",
        "core/report", "mesh/simplicial_mesh", "core/sequence", "core/error", "core/vector"]

with_library = ["-DDOVETAIL_COMPILED", "-DDOVETAIL_COMPILED_OCCT"]


def included_by(path):
    """The library's headers that a header includes whatever is defined."""
    depth = 0
    for line in path.read_text().splitlines():
        depth += bool(re.match(r"\s*#\s*if", line)) - bool(re.match(r"\s*#\s*endif", line))
        included = re.match(r'\s*#\s*include "(dovetail/[^"]+\.hpp)"', line)
        if included and depth == 0:
            yield included[1]


def closure(root, header, known):
    """A header and all that it includes, itself or through others."""
    if header not in known:
        known[header] = {header}
        known[header].update(*(closure(root, other, known) for other in included_by(root / header)))
    return known[header]


class precompiled_hubs:
    """The hubs, each precompiled when it is first asked for, by whichever of the tests that run at once is the first."""

    def __init__(self, root, command):
        self.root, self.command, self.known = root, command, {}
        self.mark = hashlib.sha256("\0".join(command).encode()).hexdigest()[:12]

    def flags_for(self, header):
        includes = closure(self.root, header, self.known) - {header}
        for hub in hubs:
            if f"dovetail/{hub}.hpp" in includes:
                made = self.make(f"dovetail/{hub}.hpp")
                return ["-include-pch", str(made)] if made else []
        return []

    def make(self, hub):
        """The precompiled hub; none if it does not compile, which its own test tells."""
        folder = pathlib.Path("hubs")
        folder.mkdir(exist_ok=True)
        stem = folder / f"{hub.replace('/', '_')}_{self.mark}"
        made, unit = stem.with_suffix(".pch"), stem.with_suffix(".hpp")
        with open(stem.with_suffix(".lock"), "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            newest = max((self.root / name).stat().st_mtime_ns for name in closure(self.root, hub, self.known))
            if not made.exists() or made.stat().st_mtime_ns <= newest:
                unit.write_text(f'#include "{hub}"\n')
                # Without times in it, the same text makes the same file, which a compiler's cache can see.
                subprocess.run([*self.command, "-x", "c++-header", "-Xclang", "-fno-pch-timestamp", unit, "-o", made],
                               capture_output=True)
        return made if made.exists() else None


def problem_of(header, compile_flags):
    """What the compiler says of a header, or what the header defines that is not inline."""
    unit = pathlib.Path(header.replace("/", "_"))
    source, compiled = unit.with_suffix(".alone.cpp"), unit.with_suffix(".alone.o")
    source.write_text(f'#include "{header}"\n#include "{header}"\n')
    try:
        run = subprocess.run([*compile_flags, "-c", source, "-o", compiled], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             text=True, env=os.environ | {"CCACHE_SLOPPINESS": "pch_defines,time_macros"})
        if run.returncode or run.stdout:
            return run.stdout or f"the compiler ended with {run.returncode}"
        symbols = subprocess.run(["nm", "--demangle", "--extern-only", "--defined-only", compiled], check=True,
                                 capture_output=True, text=True).stdout
        return "\n".join(line for line in symbols.splitlines() if not re.search(" [VWu] ", line))
    finally:
        source.unlink()
        compiled.unlink(missing_ok=True)


def misses_a_library(problem):
    missing = re.findall(r"fatal error: '?([^' ]+).*(?:[Nn]o such file|file not found)", problem)
    return bool(missing) and not any(name.startswith("dovetail/") for name in missing)


def main():
    root, folder, flags, *command = sys.argv[1:]
    root = pathlib.Path(root)
    command += [line for line in pathlib.Path(flags).read_text().splitlines() if line] + with_library
    launchers = 1 if pathlib.Path(command[0]).name == "ccache" else 0
    precompiled = precompiled_hubs(root, command[launchers:])
    failed = False
    for path in sorted((root / "dovetail" / folder).glob("*.hpp")):
        header = path.relative_to(root).as_posix()
        problem = problem_of(header, command + precompiled.flags_for(header))
        if not problem:
            continue
        if os.environ.get("DOVETAIL_ALLOW_MISSING_LIBRARIES") and misses_a_library(problem):
            print(f"{header}: passed over, a library is missing")
            continue
        print(f"{header} does not compile alone, or defines what is not inline:", *problem.splitlines()[:40], sep="\n")
        failed = True
    sys.exit(failed)


main()
