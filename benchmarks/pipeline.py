#!/usr/bin/python3
"""Measures the whole pipeline on one model: pipeline.py BUILD MODEL [options]

At a size that gives the wanted number of elements it runs `dovetail mesh` with 1 and with 2 workers; TetGen alone on
the boundary of the resulting mesh at the same size; and Gmsh's command line on the same model and size. It prints a
table of each and the ratios, as markdown. All programs run one after the other; the machine should be idle.

With --against-hxt nothing is written, and the whole command, by whatever --mesher, is compared with Gmsh's own with HXT
and two threads, at the size that gives it the same number of elements within 5 %. Gmsh writes its mesh, but
the time between its messages that it begins and that it has done so is taken off; with --written both write a binary
MSH file, and nothing is taken off. Its quality is that of the file,
measured by `dovetail stats`; dovetail's is that of its own report. With --repeat N the two commands take turns N
times, and the medians of their wall and processor seconds are compared: what a machine does besides hits both.
"""

import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

STAGES = ("geometry", "background", "simplification", "partition", "skeleton", "intersection")
GMSH_SIZE_FACTOR = 0.72  # of the size, for as many elements by Gmsh's command line with HXT; a first guess
GMSH_THREADS = 2
SAME_COUNT = 0.05
PARALLEL = ("skeleton", "intersection", "meshing", "improvement")
GIB = 2.0**30


class Failure(Exception):
    pass


class Outcome:
    """What a command printed, its wall seconds, those of all processors together, and its largest process in bytes."""

    def __init__(self, text, seconds, usage):
        self.text = text
        self.seconds = seconds
        self.processor_seconds = usage.ru_utime + usage.ru_stime
        self.peak = 1024 * usage.ru_maxrss


def run(command, limit):
    begin = time.monotonic()
    with tempfile.TemporaryFile("w+", errors="replace") as output:
        process = subprocess.Popen(["timeout", str(limit)] + [str(word) for word in command],
                                   stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - begin
        output.seek(0)
        text = output.read()
    if process.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}: exit status {process.returncode}: {text.strip()[-300:]}")
    return Outcome(text, seconds, usage)


def read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def find_size(driver, model, elements, folder, limit):
    """The uniform size that is predicted to give so many elements."""
    size = float(model_diagonal(driver, model, folder, limit)) / 60
    report = os.path.join(folder, "plan.json")
    for _ in range(4):
        run([driver, "plan", model, "--size", repr(size), "--report", report], limit)
        predicted = read_json(report)["predicted_elements"]
        size *= (predicted / elements) ** (1 / 3)
        if abs(predicted / elements - 1) < 0.02:
            break
    return float(f"{size:.4g}")


def model_diagonal(driver, model, folder, limit):
    """The driver names it when a size is larger than the model."""
    try:
        run([driver, "plan", model, "--size", "1e30"], limit)
    except Failure as failure:
        found = re.search(r"diagonal is ([0-9.e+]+)", str(failure))
        if found:
            return found.group(1).rstrip(".")
    raise Failure(f"{model}: the driver does not tell its diagonal; give --size")


def run_dovetail(driver, model, size, workers, out, options):
    report = f"{out}_{workers}.json"
    outcome = run([driver, "mesh", model, "--size", repr(size), "--workers", workers, "--out", out,
                   "--report", report, "--quiet"] + driver_options(options), options.limit)
    result = read_json(report)
    result["command_seconds"] = outcome.seconds
    result["processor_seconds"] = outcome.processor_seconds
    result["peak"] = max(outcome.peak, result["peak_rss_bytes"])
    return result


def driver_options(options):
    return (["--mesher", options.mesher] if options.mesher else []) + \
        (["--format", "msh" if options.written else "none"] if options.against_hxt else []) + options.driver_options


def run_gmsh_whole(gmsh, size, mesh, options):
    """Wall seconds of the whole command, without those of writing unless all write, and all its processor seconds, by
    HXT on several threads."""
    begin = time.monotonic()
    written = []
    with subprocess.Popen(["timeout", str(options.limit), gmsh, "-3", "-algo", "hxt", "-clmin", repr(size), "-clmax",
                           repr(size), "-nt", str(GMSH_THREADS), "-format", "msh41", "-bin", "-o", mesh, options.model],
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace") as process:
        for line in process.stdout:
            if "riting '" in line:  # "Writing ..." and "Done writing ..."
                written.append(time.monotonic())
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    end = time.monotonic()
    if process.returncode != 0 or len(written) != 2:
        raise Failure(f"gmsh -algo hxt -clmax {size}: exit status {process.returncode}")
    writing = 0 if options.written else written[1] - written[0]
    return end - begin - writing, usage.ru_utime + usage.ru_stime


def run_gmsh(gmsh, algorithm, model, size, folder, limit):
    """(elements, seconds of 3D meshing, peak) by one thread."""
    mesh = os.path.join(folder, "gmsh.msh")
    outcome = run([gmsh, "-3", "-algo", algorithm, "-clmin", repr(size), "-clmax", repr(size), "-nt", 1, "-format",
                   "msh41", "-bin", "-o", mesh, model], limit)
    text = outcome.text
    if os.path.exists(mesh):
        os.remove(mesh)
    volume = re.search(r"Done meshing 3D \(Wall ([0-9.e+-]+)s", text)
    optimise = re.search(r"Done optimizing mesh \(Wall ([0-9.e+-]+)s", text)
    tetrahedra = re.findall(r"(\d+) tetrahedra", text) or re.findall(r"(\d+) elements", text)
    if not volume or not tetrahedra:
        raise Failure(f"gmsh -algo {algorithm}: {text.strip()[-300:]}")
    return int(tetrahedra[-1]), float(volume.group(1)) + float(optimise.group(1) if optimise else 0), \
        outcome.peak


def gmsh_with_as_many(driver, gmsh, size, elements, options, folder):
    """Gmsh's size that gives a number of elements within 5 % of the given one, and what stats says of that mesh."""
    mesh = os.path.join(folder, "gmsh.msh")
    report = os.path.join(folder, "gmsh.json")
    own = float(f"{options.gmsh_size or GMSH_SIZE_FACTOR * size:.4g}")
    for _ in range(4):
        seconds = run_gmsh_whole(gmsh, own, mesh, options)
        run([driver, "stats", mesh, "--report", report], options.limit)
        os.remove(mesh)
        result = read_json(report)
        result["command_seconds"], result["processor_seconds"] = seconds
        if abs(result["elements"] / elements - 1) <= SAME_COUNT:
            return own, result
        own = float(f"{own * (result['elements'] / elements) ** (1 / 3):.4g}")
    raise Failure(f"no size gives Gmsh {elements} elements within 5 %; give --gmsh-size")


def find_gmsh():
    gmsh = shutil.which("gmsh")
    if not gmsh:
        raise Failure("there is no command gmsh; install it, or give --alone")
    return gmsh


def total(result, stages):
    return sum(result["seconds"].get(stage, 0) for stage in stages)


def rate(elements, seconds):
    return elements / seconds if seconds > 0 else 0


def print_dovetail(runs):
    print("| dovetail | " + " | ".join(f"{w} worker{'s' if w > 1 else ''}" for w in runs) + " | ratio |")
    print("|---|" + "--:|" * (len(runs) + 1))

    def line(name, value, shown="{:.2f}", ratio=True):
        values = [value(result, workers) for workers, result in runs.items()]
        last = f"{values[0] / values[-1]:.2f}" if ratio and len(values) > 1 and values[-1] > 0 else ""
        print(f"| {name} | " + " | ".join(shown.format(v) for v in values) + f" | {last} |")

    line("elements", lambda r, w: r["elements"], "{:,}", False)
    line("subdomains", lambda r, w: r["subdomains"], "{}", False)
    line("background elements", lambda r, w: r["background_elements"], "{:,}", False)
    for stage in STAGES + ("meshing", "improvement", "output"):
        line(f"{stage}, s", lambda r, w, stage=stage: r["seconds"].get(stage, 0))
    line("**all but meshing, improvement and output, s**", lambda r, w: total(r, STAGES))
    line("**parallel stages** (skeleton, intersection, meshing, improvement), **s**", lambda r, w: total(r, PARALLEL))
    line("whole command, s", lambda r, w: r["command_seconds"])
    line("**meshing: elements per second and core**", lambda r, w: rate(r["elements"], w * total(r, ["meshing"])),
         "{:,.0f}")
    line("with improvement", lambda r, w: rate(r["elements"], w * total(r, ["meshing", "improvement"])), "{:,.0f}")
    line("**largest process, GiB**", lambda r, w: r["peak"] / GIB)
    line("smallest dihedral angle, degrees", lambda r, w: r["quality"]["min_dihedral_deg"], "{:.1f}", False)
    line("under 12 degrees, per million", lambda r, w: r["quality"]["bad_per_million"], "{:.1f}", False)
    hashes = {result["mesh_hash"] for result in runs.values()}
    print(f"| mesh hash | {' | '.join(result['mesh_hash'] for result in runs.values())} | "
          f"{'same' if len(hashes) == 1 else '**DIFFERENT**'} |")


def print_others(rows, runs):
    one = runs[min(runs)]
    own = rate(one["elements"], total(one, ["meshing"]))
    print("\n| one core | elements | meshing, s | elements/s | largest process, GiB | dovetail's rate over it |")
    print("|---|--:|--:|--:|--:|--:|")
    print(f"| dovetail, meshing | {one['elements']:,} | {total(one, ['meshing']):.2f} | {own:,.0f} "
          f"| {one['peak'] / GIB:.2f} | 1.00 |")
    for name, outcome in rows:
        if isinstance(outcome, str):
            print(f"| {name} | {outcome} | | | | |")
        else:
            elements, seconds, peak = outcome
            print(f"| {name} | {elements:,} | {seconds:.2f} | {rate(elements, seconds):,.0f} | {peak / GIB:.2f} "
                  f"| {own / rate(elements, seconds):.2f} |")


def take_turns(driver, gmsh, size, out, gmsh_size, runs, gmsh_result, options):
    """Runs both commands again in turns, and puts the medians of their seconds in place of the first ones."""
    workers = max(runs)
    own = [runs[workers]]
    other = [gmsh_result]
    for _ in range(options.repeat - 1):
        own.append(run_dovetail(driver, options.model, size, workers, out, options))
        mesh = out + ".gmsh.msh" if options.written else os.devnull
        seconds = run_gmsh_whole(gmsh, gmsh_size, mesh, options)
        other.append(dict(zip(("command_seconds", "processor_seconds"), seconds)))
    for result, turns in ((runs[workers], own), (gmsh_result, other)):
        medians = {key: statistics.median(turn[key] for turn in turns)
                   for key in ("command_seconds", "processor_seconds")}
        result.update(medians)


def print_whole_commands(runs, gmsh_size, gmsh_result, options):
    output = "binary MSH files written" if options.written else "nothing written"
    print(f"\n| whole command, {output} | elements | seconds | over Gmsh's | processor seconds "
          "| smallest dihedral angle, degrees | under 12 degrees, per million | under 24 degrees, per million |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")

    def line(name, result):
        quality = result["quality"]
        seconds = result["command_seconds"]
        print(f"| {name} | {result['elements']:,} | {seconds:.2f} | {seconds / gmsh_result['command_seconds']:.2f} "
              f"| {result['processor_seconds']:.1f} | {quality['min_dihedral_deg']:.1f} "
              f"| {quality['bad_per_million']:,.1f} | {quality['low_per_million']:,.1f} |")

    for workers, result in runs.items():
        line(f"dovetail, {workers} worker{'s' if workers > 1 else ''}", result)
    line(f"gmsh -3 -algo hxt -nt {GMSH_THREADS}, size {gmsh_size:g}", gmsh_result)


def measure_others(options, build, size, out, folder):
    yield "TetGen alone, same boundary", lambda: tetgen_alone(build, size, out, options.limit)
    gmsh = shutil.which("gmsh")
    for algorithm in ("hxt", "del3d") if gmsh else ():
        def measure(algorithm=algorithm):
            return run_gmsh(gmsh, algorithm, options.model, size, folder, options.limit)
        yield f"gmsh -3 -algo {algorithm}, same model and size", measure


def tetgen_alone(build, size, out, limit):
    program = os.path.join(build, "benchmarks", "tetgen_alone")
    outcome = run([program, os.path.join(out, "mesh.pvtu"), repr(size)], limit)
    result = json.loads(outcome.text.strip().splitlines()[-1])
    return result["elements"], result["seconds"], result["peak_gib"] * GIB


def attempt(measure):
    try:
        return measure()
    except Failure as failure:
        return str(failure).replace("\n", " ").replace("|", "/")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", help="build folder")
    parser.add_argument("model", help="CAD file")
    parser.add_argument("--elements", type=float, default=5e6)
    parser.add_argument("--size", type=float, help="instead of --elements")
    parser.add_argument("--workers", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--limit", type=float, default=1800, help="seconds for each program")
    parser.add_argument("--mesher", help="of `dovetail mesh`; hxt implies --against-hxt")
    parser.add_argument("--against-hxt", action="store_true", help="whole commands, in turns with Gmsh's own with HXT")
    parser.add_argument("--written", action="store_true", help="with --against-hxt: both write binary MSH files")
    parser.add_argument("--gmsh-size", type=float, help="first size to try for Gmsh with --against-hxt")
    parser.add_argument("--repeat", type=int, default=1, help="turns of each command with --against-hxt")
    parser.add_argument("--alone", action="store_true", help="leave TetGen and Gmsh out")
    parser.epilog = "After --: more options of `dovetail mesh`."
    words = sys.argv[1:]
    end = words.index("--") if "--" in words else len(words)
    options = parser.parse_args(words[:end])
    options.driver_options = words[end + 1:]
    options.against_hxt |= options.mesher == "hxt"
    driver = os.path.join(options.build, "app", "dovetail")
    with tempfile.TemporaryDirectory(prefix="dovetail_pipeline_") as folder:
        size = options.size or find_size(driver, options.model, options.elements, folder, options.limit)
        out = os.path.join(folder, "out")
        print(f"`{os.path.basename(options.model)}`, uniform size {size:g}\n", flush=True)
        runs = {w: run_dovetail(driver, options.model, size, w, out, options) for w in options.workers}
        print_dovetail(runs)
        sys.stdout.flush()
        if options.alone:
            return
        if options.against_hxt:
            elements = runs[max(runs)]["elements"]
            gmsh = find_gmsh()
            gmsh_size, gmsh_result = gmsh_with_as_many(driver, gmsh, size, elements, options, folder)
            take_turns(driver, gmsh, size, out, gmsh_size, runs, gmsh_result, options)
            print_whole_commands(runs, gmsh_size, gmsh_result, options)
        else:
            print_others([(name, attempt(measure))
                          for name, measure in measure_others(options, options.build, size, out, folder)], runs)


if __name__ == "__main__":
    try:
        main()
    except Failure as problem:
        sys.exit(f"pipeline.py: {problem}")
