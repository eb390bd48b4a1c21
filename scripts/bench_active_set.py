#!/usr/bin/env python3
"""Compares the two ways to choose what Level I of ed_slam moves: rings, and information.

Each scheme (--rings numbers of rings, --bounds of --active=information) tracks the first --frames frames
of each sequence. A first run is compared with batch (--verify_every): the gap is the energy above that
of a batch solve of the same frame. --runs more runs, in which the schemes take turns, measure the CPU
time of the program and the times of Level I and of the frame; figures are medians, CPU the least.

  active    nodes that Level I moves, PR: those that are seen (medians)
  gap       energy above batch, percent: mean and largest
  nodes mm  distance from where batch has them: median over the frames of the mean, and the largest
  level I, frame, cpu  milliseconds of a frame; of 2 rings: cpu relative to that scheme

At equal gap the CPU of rings is read off between the two numbers of rings with a gap on either side, on
a logarithmic scale of gaps, and the number of active nodes likewise. Sequences strip and heart are simulated
once into --cache; others are searched by name in the folder that CERES_ED_DATA names, and skipped with
a message where they are not. The script needs python3-numpy and python3-matplotlib, and writes
active_set.png and active_set.json to --work.

  scripts/bench_active_set.py
  scripts/bench_active_set.py --sequences=strip,heart --frames=24 --runs=1
  scripts/bench_active_set.py --page       # also writes the table and the figure
"""
import argparse
import json
import math
import shutil
import statistics
import sys
from pathlib import Path

from mesh_picture import BATCH_COLOR, TWO_LEVEL_COLOR
from bench_tables import add_page_option, cell, check_marks, table, write_between
from program_runs import PROGRAM, ROOT, RunFailed, default_folders, names, run, wrong_call
from sequence_runs import (CACHE, SCENES, find_sequences, followed, read_frames, simulate)

import matplotlib.pyplot as plt

BEGIN, END = "<!-- bench_active_set.py: begin -->", "<!-- bench_active_set.py: end -->"
PAGE = ROOT / "ceres_ed/solver/decoupling/README.md"
PICTURE = "active_set.png"
SIZE = ["--width=320", "--height=240"]
# The frames before this one see a map that is still small.
FIRST_FRAME = 8
REFERENCE = "2 rings"
# Below this a gap, in percent, is drawn as none.
LEAST_GAP = 1e-4


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--work", type=Path, default=ROOT / "build/active_set", metavar="DIR",
                        help="folder for runs, results and the figure [build/active_set]")
    parser.add_argument("--cache", type=Path, default=CACHE, metavar="DIR",
                        help="folder of simulated sequences [build/sequences]")
    parser.add_argument("--sequences", default="strip,heart,liver_breath_render,davinci_pull",
                        metavar="NAMES", help="[strip,heart,liver_breath_render,davinci_pull]")
    parser.add_argument("--rings", default="0,1,2,3,4,6,8", metavar="N,...")
    parser.add_argument("--bounds", default="1e-2,1e-3,3e-4,1e-4,1e-5,1e-6", metavar="X,...",
                        help="bounds of --active=information")
    parser.add_argument("--frames", type=int, default=36, metavar="N",
                        help="frames of each sequence [36]")
    parser.add_argument("--verify_every", type=int, default=4, metavar="N")
    parser.add_argument("--runs", type=int, default=3, metavar="N",
                        help="runs of each scheme in turn [3]")
    add_page_option(parser, PAGE, "the figure into scripts/images/, and the table")
    options = parser.parse_args()
    options.said = [f"--{key}={value}" for key, value in vars(options).items()
                    if key in ("sequences", "rings", "bounds", "frames", "verify_every", "runs")
                    and value != parser.get_default(key)]
    if options.frames < FIRST_FRAME + options.verify_every or options.runs < 1:
        parser.error(f"--frames={options.frames} --runs={options.runs}, expected at least "
                     f"{FIRST_FRAME + options.verify_every} and 1")
    for program in ("ed_slam", "ed_simulate"):
        if not (options.bin / program).exists():
            wrong_call(f"{options.bin / program} is not there; build it or name its folder")
    if options.page:
        check_marks(options.page, BEGIN, END)
    return options


def find(name, options):
    """Returns a sequence, or None where its data are not there."""
    if name in SCENES:
        flags = [f"--frames={max(options.frames, 120)}", *SIZE] if name != "strip" else []
        return simulate(options.bin / "ed_simulate", name, flags, options.cache)
    folders = [folder for folder in default_folders() if folder.is_dir()]
    found = [one for one in find_sequences(folders) if one.name == name]
    if not found:
        print(f"{PROGRAM}: {name} is not there, skipped (CERES_ED_DATA names the folder)",
              file=sys.stderr)
    return found[0] if found else None


def schemes_of(options):
    """Returns the name, the kind and the flags of each scheme."""
    schemes = [(f"{count} rings", "rings", [f"--rings={count}"]) for count in names(options.rings)]
    return schemes + [(f"bound {bound}", "information",
                       ["--active=information", f"--active_bound={bound}"])
                      for bound in names(options.bounds)]


def track(sequence, flags, options):
    """Returns the rows of a run from frame FIRST_FRAME on, and its CPU milliseconds for a frame."""
    output = options.work / "run"
    shutil.rmtree(output, ignore_errors=True)
    _, cpu, _ = run([options.bin / "ed_slam", sequence.folder, f"--output={output}", "--quiet",
                     "--progress=none", "--threads=1", "--live_every=0", "--checkpoint_every=0",
                     f"--last={options.frames - 1}", *sequence.flags, *flags],
                    options.work / "run.log")
    rows = followed(read_frames(output))
    return [row for row in rows if row["frame"] >= FIRST_FRAME], 1e3 * cpu / options.frames


def gaps_of(rows):
    rows = [row for row in rows if row["verify_gap"] == row["verify_gap"]]
    if not rows:
        raise RunFailed("no frame was compared with batch")
    gaps = [100.0 * row["verify_gap"] for row in rows]
    return {"gap": statistics.fmean(gaps), "gap_max": max(gaps),
            "node_mean": 1e3 * statistics.median(row["verify_node_mean"] for row in rows),
            "node_max": 1e3 * max(row["verify_node_max"] for row in rows)}


def measure(sequence, options):
    """Returns a row for each scheme."""
    result = []
    for name, kind, flags in schemes_of(options):
        rows, _ = track(sequence, [*flags, f"--verify_every={options.verify_every}"], options)
        moved = [row for row in rows if row["active"] > 0]
        result.append({"sequence": sequence.name, "scheme": name, "kind": kind, **gaps_of(rows),
                       "pr": statistics.median(row["pr"] for row in moved),
                       "active": statistics.fmean(row["active"] for row in moved), "times": []})
    for _ in range(options.runs):
        for row, (_, _, flags) in zip(result, schemes_of(options)):
            rows, cpu = track(sequence, flags, options)
            row["times"].append({"cpu": cpu, **{
                key: 1e3 * statistics.median(one[f"t_{key}"] for one in rows)
                for key in ("level1", "total")}})
    for row in result:
        row["cpu"] = min(one["cpu"] for one in row["times"])
        for key in ("level1", "total"):
            row[key] = statistics.median(one[key] for one in row["times"])
    reference = next((row["cpu"] for row in result if row["scheme"] == REFERENCE), None)
    for row in result:
        row["share"] = row["cpu"] / reference if reference else None
    add_equal_gap(result)
    return result


def at_gap(rings, gap, key):
    """Returns what rings have at a gap, between their two neighbours; None outside of them."""
    for a, b in zip(rings, rings[1:]):
        if a["gap"] >= gap >= b["gap"] and a["gap"] > b["gap"] > 0.0:
            part = math.log(a["gap"] / gap) / math.log(a["gap"] / b["gap"])
            return a[key] + part * (b[key] - a[key])
    return None


def add_equal_gap(rows):
    """Compares each bound with the rings that have its gap: the ratio of CPU, and the nodes of both."""
    rings = [row for row in rows if row["kind"] == "rings"]
    for row in rows:
        cpu = at_gap(rings, row["gap"], "cpu") if row["kind"] == "information" else None
        row["of_rings"] = row["cpu"] / cpu if cpu else None
        row["rings_active"] = at_gap(rings, row["gap"], "active") if cpu else None


def lines_of(rows):
    cells = []
    for row in rows:
        cells.append([row["sequence"], row["scheme"], cell(row["pr"], 0), cell(row["active"], 0),
                      f"{row['gap']:.3g}", f"{row['gap_max']:.3g}", f"{row['node_mean']:.2g}",
                      f"{row['node_max']:.2g}", cell(row["level1"], 1), cell(row["total"], 1),
                      cell(row["cpu"], 1), cell(row["share"], 2), cell(row["of_rings"], 2),
                      cell(row["rings_active"], 0)])
    return table(["sequence", "scheme", "PR", "active", "gap %", "largest %", "nodes mm",
                  "largest mm", "level I", "frame", "cpu", "of 2 rings", "of rings, equal gap",
                  "their nodes"], cells)


def verdict(rows):
    """Returns a sentence on each sequence: the best ratio of CPU at an equal gap."""
    parts = []
    for name in dict.fromkeys(row["sequence"] for row in rows):
        ratios = [row["of_rings"] for row in rows if row["sequence"] == name and row["of_rings"]]
        if ratios:
            parts.append(f"{name} {min(ratios):.2f} to {max(ratios):.2f}")
    return ("CPU time of information over that of rings at an equal gap: " + "; ".join(parts) +
            ".") if parts else "No bound has a gap between those of two numbers of rings."


def draw(rows, path):
    sequences = list(dict.fromkeys(row["sequence"] for row in rows))
    figure, all_axes = plt.subplots(1, len(sequences), figsize=(3.2 * len(sequences), 3.2),
                                    squeeze=False)
    styles = {"rings": ("o-", BATCH_COLOR), "information": ("s--", TWO_LEVEL_COLOR)}
    for axes, name in zip(all_axes[0], sequences):
        for kind, (style, color) in styles.items():
            mine = [row for row in rows if row["sequence"] == name and row["kind"] == kind]
            axes.plot([row["cpu"] for row in mine], [max(row["gap"], LEAST_GAP) for row in mine],
                      style, color=color, label=kind, markersize=5, linewidth=1.2)
            for row in mine:
                axes.annotate(row["scheme"].replace(" rings", "").replace("bound ", ""),
                              (row["cpu"], max(row["gap"], LEAST_GAP)), xytext=(4, 3), fontsize=6,
                              textcoords="offset points")
        axes.set_yscale("log")
        axes.set(xlabel="CPU ms a frame", title=name)
        axes.grid(color="#e4e4e4", linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelsize=8)
    all_axes[0][0].set_ylabel("energy above batch, %")
    all_axes[0][0].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110, facecolor="white")
    plt.close(figure)


def main():
    options = parse_options()
    options.work.mkdir(parents=True, exist_ok=True)
    rows = []
    try:
        for name in names(options.sequences):
            sequence = find(name, options)
            if sequence is not None:
                rows += measure(sequence, options)
                print(f"{PROGRAM}: {name} done", file=sys.stderr)
    except RunFailed as error:
        print(f"{PROGRAM}: {error}", file=sys.stderr)
        return 1
    if not rows:
        print(f"{PROGRAM}: there is no sequence to measure", file=sys.stderr)
        return 1
    command = " ".join(["scripts/bench_active_set.py", *options.said])
    page = "\n".join([f"`{command}`:", "", *lines_of(rows), "", verdict(rows)])
    print(page)
    (options.work / "active_set.json").write_text(json.dumps(rows, indent=1) + "\n")
    draw(rows, options.work / PICTURE)
    if options.page:
        write_between(options.page, BEGIN, END, page)
        shutil.copy(options.work / PICTURE, ROOT / "scripts/images" / PICTURE)
    return 0


if __name__ == "__main__":
    sys.exit(main())
