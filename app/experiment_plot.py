#!/usr/bin/env python3
"""Plots what `dovetail experiment` measured beside what the paper printed: experiment_plot.py RESULT.json PICTURE.png"""
import json
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    sys.exit("matplotlib is not there")

with open(sys.argv[1], encoding="utf-8") as file:
    result = json.load(file)
rows = {row["label"]: row for row in result["rows"]}
places = {run["label"]: at for at, run in enumerate(result["runs"])}

pictures, axes = pyplot.subplots(1, len(result["plots"]), figsize=(7 * len(result["plots"]), 5), squeeze=False)
for axis, plot in zip(axes[0], result["plots"]):
    at = [places[label] for label in plot["runs"]]
    for colour, label in enumerate(plot["vertical"]):
        for source, style in (("paper", "s--"), ("measured", "x"), ("simulated", "o-")):
            points = [(rows[plot["horizontal"]][source][k], rows[label][source][k]) for k in at]
            points = sorted(point for point in points if None not in point)
            if points:
                axis.plot(*zip(*points), style, color=f"C{colour}", label=f"{label}, {source}")
    axis.set_title(plot["title"])
    axis.set_xlabel(plot["horizontal"])
    axis.set_ylabel(", ".join(sorted({rows[label]["unit"] for label in plot["vertical"]})))
    axis.set_xscale("log")
    if plot["logarithmic"]:
        axis.set_yscale("log")
    # Below the axes, where it covers no line.
    axis.legend(fontsize="small", ncol=2, loc="upper center", bbox_to_anchor=(0.5, -0.14))
pictures.savefig(sys.argv[2], dpi=120, bbox_inches="tight")
