#!/usr/bin/env python3
"""Makes scripts/images/fit.png, the picture of a fit in README.md, from pairs in data/.

It fits each pair with the defaults of ed_fit and draws source, target, the result coloured by its distance
to the truth, and the graph with PR and PI nodes. It needs python3-numpy and python3-matplotlib.

  scripts/plot_readme.py
  scripts/plot_readme.py --bin=build/release/apps --output=build/fit.png
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

# First of those that need numpy and matplotlib: it says so where they are missing.
from mesh_picture import (BLUE, GRAY, HEAT, PI_COLOR, PR_COLOR, SUPERSAMPLING, View, draw_graph, render,
                          smaller)
import ply
from program_runs import ROOT

import matplotlib
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np


def fit(apps, pair, work):
    """Returns the paths and figures of one fit with defaults."""
    data = ROOT / "data" / pair
    out = {name: work / f"{pair}_{name}.ply" for name in ("fitted", "graph", "error")}
    report, evaluation = work / f"{pair}.json", work / f"{pair}_eval.json"
    subprocess.run([apps / "ed_fit", data / "source.ply", data / "target.ply", "--quiet",
                    f"--output={out['fitted']}", f"--graph={out['graph']}", f"--report={report}"],
                   check=True)
    subprocess.run([apps / "ed_eval", out["fitted"], data / "target.ply",
                    f"--truth={data / 'gt.ply'}", f"--error_ply={out['error']}",
                    f"--report={evaluation}"], check=True, stdout=subprocess.DEVNULL)
    out.update(source=data / "source.ply", target=data / "target.ply",
               report=json.loads(report.read_text()), eval=json.loads(evaluation.read_text()))
    return out


def draw_row(row, files, view_angles, color_map, full_scale, panel):
    source, target, error, graph = (ply.read_ply(files[name])
                                    for name in ("source", "target", "error", "graph"))
    everything = np.concatenate([ply.points(cloud) for cloud in (source, target, error)])
    pixels = (panel[0] * SUPERSAMPLING, panel[1] * SUPERSAMPLING)
    view = View(everything, *view_angles, pixels)
    percent = 100.0 * error["vertex"]["error"].astype(float) / files["eval"]["diagonal"]
    heat = color_map(np.clip(percent / full_scale, 0.0, 1.0))[:, :3]
    pale = 0.4 * GRAY + 0.6
    clouds = [(source, GRAY), (target, BLUE), (error, heat), (error, pale)]
    for column, (cloud, color) in enumerate(clouds):
        points, triangles = ply.points(cloud), ply.triangles(cloud)
        colors = np.broadcast_to(color, points.shape)
        image, depth = render(view, points, triangles, colors)
        axes = row[column]
        axes.imshow(smaller(image), interpolation="nearest", zorder=1, aspect="equal",
                    extent=(0, panel[0], panel[1], 0))
        if column == 3:
            draw_graph(axes, view, depth, graph, SUPERSAMPLING)
        axes.set(xlim=(0, panel[0]), ylim=(panel[1], 0))
        axes.set_axis_off()


# Pair, azimuth and elevation of the view in degrees, what its target is.
ROWS = [("dolphin_bend", (38.0, 22.0), "all of it"),
        ("heart_partial", (-38.0, 18.0), "what a camera saw")]


def compose(fits, full_scale, panel, output):
    dpi = 100
    width, height = (4 * panel[0] + 20) / dpi, (len(ROWS) * panel[1] + 96) / dpi
    figure = plt.figure(figsize=(width, height), dpi=dpi)
    top = 1.0 - 30.0 / (height * dpi)
    bottom = 66.0 / (height * dpi)
    grid = figure.add_gridspec(len(ROWS), 4, left=0.01, right=0.99, top=top, bottom=bottom,
                               wspace=0.02, hspace=0.02)
    color_map = matplotlib.colors.LinearSegmentedColormap.from_list("error", HEAT)
    for i, ((pair, angles, target), files) in enumerate(zip(ROWS, fits)):
        row = [figure.add_subplot(grid[i, j]) for j in range(4)]
        draw_row(row, files, angles, color_map, full_scale, panel)
        if i == 0:
            titles = ("source", "target", "source fitted, with its error", "graph")
            for axes, title in zip(row, titles):
                axes.set_title(title, fontsize=11, pad=6)
        nodes, evaluation = files["report"]["nodes"], files["eval"]
        captions = (pair, target, f"mean {evaluation['truth']['mean_percent']:.2f} %",
                    f"{nodes['pr']} PR, {nodes['pi']} PI")
        for axes, caption in zip(row, captions):
            axes.text(4, panel[1] - 2, caption, fontsize=8.5, color="#404040", va="bottom")
    bar = figure.add_axes([0.52, 40.0 / (height * dpi), 0.20, 10.0 / (height * dpi)])
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0.0, full_scale), color_map)
    figure.colorbar(scale, cax=bar, orientation="horizontal", extend="max")
    bar.tick_params(labelsize=8, length=2)
    bar.set_xlabel("distance to the truth, % of the target's diagonal", fontsize=8.5, labelpad=2)
    handles = [plt.Line2D([], [], marker="o", linestyle="", color=color, markersize=5, label=label)
               for color, label in ((PR_COLOR, "PR: an observation reaches it"),
                                    (PI_COLOR, "PI: follows the energies"))]
    figure.legend(handles=handles, loc="lower right", bbox_to_anchor=(0.985, 0.005), fontsize=8.5,
                  frameon=False, handletextpad=0.2, labelspacing=0.3)
    Path(output).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=dpi, facecolor="white")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of ed_fit and ed_eval [build/release/apps]")
    parser.add_argument("--output", default=ROOT / "scripts/images/fit.png", metavar="FILE",
                        help="PNG to write [scripts/images/fit.png]")
    parser.add_argument("--full_scale", type=float, default=4.0, metavar="PERCENT",
                        help="error at the dark end of the colours [4]")
    options = parser.parse_args()
    apps = options.bin.resolve()
    with tempfile.TemporaryDirectory(prefix="plot_readme_") as work:
        try:
            fits = [fit(apps, pair, Path(work)) for pair, _, _ in ROWS]
        except (OSError, subprocess.CalledProcessError) as error:
            sys.exit(f"plot_readme.py: {error}")
        compose(fits, options.full_scale, (300, 200), options.output)
    print(options.output)


if __name__ == "__main__":
    main()
