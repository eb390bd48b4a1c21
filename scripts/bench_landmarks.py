#!/usr/bin/env python3
"""Fits the surfaces of a set to one another, and measures how far landmarks end from their places.

A set is a folder with surfaces NAME.ply and their landmarks NAME.landmarks.csv (rows
label,x,y,z,nearest_vertex after a comment; equal labels mean equal places). Sets are searched in the
folder that the environment variable CERES_ED_DATA names. Every surface of a set is fitted to every
other one, and the landmarks go along: each moves as its nearest vertex does. No landmark is shown to
the fit.

Errors are distances between the landmarks of both surfaces in percent of the diagonal of the target's
bounding box, as means over the landmarks, and then over the pairs:
  nothing     as the files are
  rigid       after the rigid motion that is best for the landmarks
  similarity  the same with a change of size
  fit         after ed_fit
The script exits with 1 when a run fails, and with 2 on a wrong call. Needs python3-numpy.

  scripts/bench_landmarks.py
  scripts/bench_landmarks.py --sets=vertebrae --flags=--rigid_scale --pairs
"""
import argparse
import csv
import json
import shlex
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from itertools import permutations
from pathlib import Path

import numpy as np

import ply
from bench_tables import cell, table
from program_runs import PROGRAM, ROOT, RunFailed, default_folders, names, run, wrong_call

COLUMNS = ("nothing", "rigid", "similarity", "fit")


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of ed_fit [build/release/apps]")
    parser.add_argument("--flags", default="", help="flags of ed_fit [none]")
    parser.add_argument("--sets", default="", help="names, with commas between [all]")
    parser.add_argument("--data", type=Path, action="append", metavar="DIR",
                        help="folder of sets, repeatable [$CERES_ED_DATA]")
    parser.add_argument("--jobs", type=int, default=1, help="fits at a time [1]")
    parser.add_argument("--pairs", action="store_true", help="also print a row for each pair")
    parser.add_argument("--json", metavar="FILE", help="also write every figure there")
    options = parser.parse_args()
    options.data = options.data or default_folders()
    return options


class Model:
    """A surface with its landmarks, {label: (position, nearest vertex)}."""

    def __init__(self, path):
        self.path = path
        self.name = path.stem
        self.points = ply.points(ply.read_ply(path))
        self.diagonal = np.linalg.norm(np.ptp(self.points, axis=0))
        self.landmarks = {}
        with open(path.with_suffix(".landmarks.csv"), encoding="utf-8") as file:
            for row in csv.reader(line for line in file if not line.startswith("#")):
                self.landmarks[row[0]] = (np.array(row[1:4], float), int(row[4]))


def find_sets(options):
    """Returns {name: models} of the chosen sets."""
    sets = {}
    for folder in options.data:
        for path in sorted(folder.glob("*/*.landmarks.csv")):
            surface = path.with_name(path.name.replace(".landmarks.csv", ".ply"))
            if surface.exists():
                sets.setdefault(path.parent.name, []).append(surface)
    chosen = names(options.sets)
    if unknown := set(chosen) - set(sets):
        wrong_call(f"no set {', '.join(sorted(unknown))}; there are {', '.join(sets)}")
    if not sets:
        wrong_call("no sets of landmarks found; CERES_ED_DATA names their folder")
    return {name: [Model(path) for path in paths] for name, paths in sets.items()
            if not chosen or name in chosen}


def moved_by_best(source, target, with_scale):
    """Returns `source` after the rigid motion (or similarity) that takes it nearest to `target`."""
    a, b = source - source.mean(axis=0), target - target.mean(axis=0)
    u, singular, vt = np.linalg.svd(a.T @ b)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    scale = (singular * np.diag(flip)).sum() / (a ** 2).sum() if with_scale else 1.0
    return scale * a @ (u @ flip @ vt) + target.mean(axis=0)


def bench_pair(task):
    """Returns the row of a source and a target, or None where the fit failed."""
    of_set, source, target, options = task
    labels = [label for label in source.landmarks if label in target.landmarks]
    a = np.array([source.landmarks[label][0] for label in labels])
    b = np.array([target.landmarks[label][0] for label in labels])
    vertices = [source.landmarks[label][1] for label in labels]
    with tempfile.TemporaryDirectory(prefix="bench_landmarks_") as work:
        out, report = Path(work) / "fitted.ply", Path(work) / "report.json"
        try:
            run([options.bin / "ed_fit", source.path, target.path, f"--output={out}",
                 f"--report={report}", "--quiet"] + shlex.split(options.flags),
                Path(work) / "fit.log")
        except RunFailed as error:
            print(f"{PROGRAM}: {error}", file=sys.stderr)
            return None
        fitted = ply.points(ply.read_ply(out))
        seconds = json.loads(report.read_text())["time_s"]["total"]
    places = {"nothing": a, "rigid": moved_by_best(a, b, False),
              "similarity": moved_by_best(a, b, True),
              "fit": a + fitted[vertices] - source.points[vertices]}
    row = {"set": of_set, "source": source.name, "target": target.name, "seconds": seconds}
    for name, place in places.items():
        row[name] = 100.0 * np.linalg.norm(place - b, axis=1).mean() / target.diagonal
    print(f"{of_set}: {source.name} to {target.name}: {row['fit']:.2f} %", file=sys.stderr)
    return row


def main():
    options = parse_options()
    tasks = [(name, source, target, options) for name, models in find_sets(options).items()
             for source, target in permutations(models, 2)]
    with ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(bench_pair, tasks))
    failed = None in rows
    rows = [row for row in rows if row]
    lines = []
    for name in dict.fromkeys(task[0] for task in tasks):
        of_set = [row for row in rows if row["set"] == name]
        if options.pairs:
            lines += [[f"{row['source']} to {row['target']}", "1"]
                      + [cell(row[key], 2) for key in COLUMNS] + [cell(row["seconds"], 1)]
                      for row in of_set]
        if of_set:
            lines.append([name, str(len(of_set))]
                         + [cell(np.mean([row[key] for row in of_set]), 2) for key in COLUMNS]
                         + [cell(np.mean([row["seconds"] for row in of_set]), 1)])
    print("\n".join(table(["set", "pairs"] + [f"{name} %" for name in COLUMNS] + ["s"], lines)))
    if options.json:
        Path(options.json).write_text(json.dumps(rows, indent=2) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
