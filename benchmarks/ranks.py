#!/usr/bin/env python3
"""The same mesh by worker processes and by ranks: benchmarks/run ranks [MODEL] [option...]

A table of wall and processor time, beside the run without MPI that has two workers, of the stages in which tasks take nearly
all the time beside that run with one worker, and the share of a processor that the busiest relay took. Ranks are run twice:
as one group, and each by itself (--rank-group 1). Options: --ranks 2,4,7, --repeats N (the table has the fastest of them),
--size S or --elements N, and those of `dovetail mesh`.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import threading
import time

from ranks_environment import ENVIRONMENT

TICKS = os.sysconf("SC_CLK_TCK")
PARALLEL_STAGES = ("meshing", "improvement")
ONE_WORKER, TWO_WORKERS = "processes, 1 worker", "processes, 2 workers"


class RelayWatch(threading.Thread):
    """Looks at the processor time of mpirun's children, which are the relays."""

    def __init__(self, mpirun):
        super().__init__(daemon=True)
        self.mpirun = mpirun
        self.seconds = {}
        self.over = threading.Event()

    def run(self):
        while not self.over.wait(0.1):
            for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
                try:
                    fields = stat.read_text().rsplit(")", 1)[1].split()
                except OSError:
                    continue
                if int(fields[1]) == self.mpirun:
                    self.seconds[stat] = (int(fields[11]) + int(fields[12])) / TICKS


def run(command, folder):
    """Wall and processor seconds, the largest processor share of a relay, and the report."""
    report = folder / "report.json"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    began = time.monotonic()
    process = subprocess.Popen(command + ["--out", str(folder / "out"), "--report", str(report), "--quiet"],
                               env=os.environ | ENVIRONMENT)
    watch = RelayWatch(process.pid)
    watch.start()
    if process.wait() != 0:
        sys.exit("failed: " + " ".join(command))
    wall = time.monotonic() - began
    watch.over.set()
    watch.join()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, spent, max(watch.seconds.values(), default=0) / wall, json.loads(report.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("model")
    parser.add_argument("--ranks", default="2,4,7")
    parser.add_argument("--repeats", type=int, default=1)
    given, options = parser.parse_known_args()
    if not {"--size", "--elements", "--sizing", "-s"} & set(options):
        options += ["--size", "700"]
    mesh = [str(given.build / "app" / "dovetail"), "mesh", given.model, "--format", "none"] + options
    runs = {ONE_WORKER: mesh + ["--workers", "1"], TWO_WORKERS: mesh + ["--workers", "2"]}
    for ranks in given.ranks.split(","):
        runs[f"{ranks} ranks"] = ["mpirun", "-n", ranks] + mesh
        runs[f"{ranks} ranks, each by itself"] = ["mpirun", "-n", ranks] + mesh + ["--rank-group", "1"]
    best = {}
    for _ in range(given.repeats):
        for name, command in runs.items():
            with tempfile.TemporaryDirectory() as folder:
                found = run(command, pathlib.Path(folder))
            if name not in best or found[0] < best[name][0]:
                best[name] = found
    in_parallel = {name: sum(report["seconds"][stage] for stage in PARALLEL_STAGES) for name, (*_, report) in best.items()}
    print(f"| | wall, s | of two workers | {' and '.join(PARALLEL_STAGES)}, s | speed-up | processor, s | busiest relay, % "
          "| elements | mesh hash |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name, (wall, spent, relay, report) in best.items():
        share = f"{100 * relay:.1f}" if "ranks" in name else ""
        print(f"| {name} | {wall:.2f} | {wall / best[TWO_WORKERS][0]:.2f} | {in_parallel[name]:.2f} "
              f"| {in_parallel[ONE_WORKER] / in_parallel[name]:.2f} | {spent:.1f} | {share} | {report['elements']:,} "
              f"| {report['mesh_hash']} |")
    if len({report["mesh_hash"] for *_, report in best.values()}) > 1:
        sys.exit("the meshes differ")


main()
