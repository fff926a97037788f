#!/usr/bin/python3
"""Measures the improvers on the same meshes: improver.py BUILD [options]

Makes the meshes (kept in BUILD/benchmarks/improver_meshes), runs the native improver's presets and Gmsh's optimiser on
each, and prints tables as markdown; writes quality against time as a picture when --picture names a file. Surfaces are
made by the command line of Gmsh, that of the built-in aircraft by dovetail itself; they are filled by TetGen's `pYqm`.
linkrods and the airliner are left out when DOVETAIL_SHARED is not set. Seconds are processor time. Gmsh's count all
that a caller waits for, the hand-over of the mesh by its interface included.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys

COLOURS = {"dovetail": "tab:blue", "Gmsh": "tab:orange"}


def run(*command, limit=1800, **options):
    return subprocess.run([str(word) for word in command], check=True, timeout=limit, text=True,
                          stdout=subprocess.PIPE, **options).stdout


class Meshes:
    """Raw meshes by name, made when they are missing."""

    def __init__(self, build, elements):
        self.coarser = (1e6 / elements) ** (1 / 3)  # the sizes below give about a million elements
        self.generate = os.path.join(build, "benchmarks", "improver_generate")
        self.driver = os.path.join(build, "app", "dovetail")
        self.folder = os.path.join(build, "benchmarks", "improver_meshes", f"{elements:.0f}")
        self.models = os.path.join(os.environ.get("DOVETAIL_SHARED", ""), "models")
        os.makedirs(self.folder, exist_ok=True)

    def path(self, name, make):
        raw = os.path.join(self.folder, name + ".raw")
        if not os.path.exists(raw):
            print(f"making {name}", file=sys.stderr, flush=True)
            make(raw + ".tmp")
            os.rename(raw + ".tmp", raw)
        return raw

    def fill(self, surface, raw):
        run(self.generate, "fill", surface, raw)

    def surface(self, name, model, *options):
        out = os.path.join(self.folder, name + ".msh")
        options = [self.coarser * word if isinstance(word, float) else word for word in options]
        run("gmsh", "-2", "-algo", "front2d", "-format", "msh22", "-o", out, model, *options)
        return out

    def cube_file(self):
        path = os.path.join(self.folder, "cube.geo")
        with open(path, "w", encoding="utf-8") as file:
            file.write('SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 1, 1};\n')
        return path

    def cube(self, name, size):
        """`size` for a million elements."""
        return self.path(name, lambda raw: self.fill(
            self.surface(name, self.cube_file(), "-clmin", size, "-clmax", size), raw))

    def part(self, name, file, *options):
        model = os.path.join(self.models, file)
        if not os.path.exists(model):
            print(f"{name} is left out: no {file} in the folder models of DOVETAIL_SHARED\n", flush=True)
            return None
        return self.path(name, lambda raw: self.fill(self.surface(name, model, *options), raw))

    def aircraft(self):
        def make(raw):
            out = os.path.join(self.folder, "aircraft")
            run(self.driver, "mesh", "--model", "aircraft", "--improver", "none", "--format", "msh", "--out", out,
                "--quiet", "--size", 2.5 * self.coarser)
            self.fill(out, raw)
        return self.path("aircraft", make)

    def cube_of_hxt(self):
        def make(raw):
            out = os.path.join(self.folder, "hxt.msh")
            run("gmsh", "-3", "-algo", "hxt", "-nt", 1, "-clmin", 0.0155 * self.coarser, "-clmax",
                0.0155 * self.coarser, "-format", "msh41", "-bin",
                "-o", out, self.cube_file())
            run(self.generate, "copy", out, raw)
            os.remove(out)
        return self.path("cube of HXT", make)


def measure(program, what, repeats, mesh):
    lines = run(program, what, repeats, mesh).splitlines()
    return [json.loads(line) for line in lines]


def per_million(result, which, kind):
    return 1e6 * result[which][kind] / result["elements"]


def print_row(name, r):
    print(f"| {name} | {r['elements'] / r['seconds'] / 1e3:,.0f} | {per_million(r, 'free', 'bad'):.1f} "
          f"| {per_million(r, 'free', 'low'):.1f} | {r['free']['min_angle']:.1f} | {r['limited']['bad']} "
          f"| {r['limited']['low']} | {r['bytes_per_element']:.0f} |", flush=True)


def print_table(name, mesh, programs, repeats):
    """Prints the table of one mesh; the results by improver."""
    results = {}
    for program, what in programs:
        for result in measure(program, what, repeats, mesh):
            if not results:
                first = result
                print(f"\n**{name}**: {first['elements']:,} elements, {first['limited_before']['elements']:,} of them "
                      "limited by the surface\n")
                print("| improver | thousand elements/s | bad per million | low per million | min angle | bad, limited "
                      "| low, limited | bytes per element |\n|---|--:|--:|--:|--:|--:|--:|--:|")
                before = {"seconds": float("inf"), "bytes_per_element": 0, "elements": first["elements"],
                          "free": first["free_before"], "limited": first["limited_before"]}
                print_row("(before)", before)
            label = result["improver"] if "Gmsh" in result["improver"] else "dovetail " + result["improver"]
            results[label] = result
            print_row(label, result)
    return results


def print_scaling(meshes, program, repeats):
    print("\n**Scaling**, cube, preset fine\n\n| elements | microseconds per element | bytes per element |\n|--:|--:|--:|")
    for mesh in meshes:
        r = measure(program, "fine", repeats, mesh)[0]
        print(f"| {r['elements']:,} | {1e6 * r['seconds'] / r['elements']:.3f} | {r['bytes_per_element']:.0f} |",
              flush=True)


def draw(tables, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, len(tables), figsize=(4.2 * len(tables), 4), sharey=True, squeeze=False)
    for axis, (name, results) in zip(axes[0], tables.items()):
        for family, colour in COLOURS.items():
            mine = [(r["seconds"] / r["elements"] * 1e6, max(0.1, per_million(r, "free", "low")), label.split()[-1])
                    for label, r in results.items() if label.startswith(family)]
            mine.sort()
            axis.plot([m[0] for m in mine], [m[1] for m in mine], "o-", color=colour, label=family)
            for x, y, label in mine:
                axis.annotate(label, (x, y), textcoords="offset points", xytext=(4, 4), fontsize=8)
        axis.set(title=name, xscale="log", yscale="log", xlabel="microseconds per element")
        axis.set_ylim(0.07, 1e5)
        axis.grid(alpha=0.3)
    axes[0][0].set_ylabel("low per million (under 24 deg; 0 is drawn at 0.1)")
    axes[0][-1].legend()
    figure.tight_layout()
    figure.savefig(file, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", help="build folder")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--picture", help="PNG to write")
    parser.add_argument("--elements", type=float, default=1e6, metavar="N",
                        help="about so many in each mesh, and a tenth to ten times as many for the scaling")
    parser.add_argument("--only", nargs="+", default=[], help="names of meshes")
    parser.add_argument("--no-scaling", action="store_true")
    options = parser.parse_args()
    if not shutil.which("gmsh"):
        sys.exit("improver.py: the command line of Gmsh is needed to make the surfaces")
    made = Meshes(options.build, options.elements)
    inputs = {"cube": lambda: made.cube("cube", 0.0165),
              "linkrods": lambda: made.part("linkrods", "linkrods.step", "-clmin", 0.0245, "-clmax", 0.0245),
              "aircraft": made.aircraft,
              "A319": lambda: made.part("A319", "A319_in_a_box.brep", "-clcurv", 36, "-clmax", 3000.0, "-clmin", 40.0),
              "cube of HXT": made.cube_of_hxt}
    native = os.path.join(options.build, "benchmarks", "improver")
    programs = [(native, "fast,fine,finest")]
    gmsh = os.path.join(options.build, "benchmarks", "improver_gmsh")
    if os.path.exists(gmsh):
        programs.append((gmsh, "0.3,0.5,0.6"))
    tables = {}
    for name, make in inputs.items():
        mesh = make() if not options.only or name in options.only else None
        if mesh:
            tables[name] = print_table(name, mesh, programs, options.repeats)
    if not options.no_scaling:
        print_scaling([made.cube("cube, a tenth", 0.0385), made.cube("cube", 0.0165), made.cube("cube, times ten", 0.0077)],
                      native, options.repeats)
    if options.picture:
        draw(tables, options.picture)


if __name__ == "__main__":
    try:
        main()
    except subprocess.SubprocessError as problem:
        sys.exit(f"improver.py: {problem}")
