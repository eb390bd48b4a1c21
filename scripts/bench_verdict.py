#!/usr/bin/env python3
"""Compares the verdict of ed_fit with the error of its result, over pairs with truth and wrong pairs.

The pairs are those with gt.ply in data/ and in the folder that the environment variable CERES_ED_DATA
names; their bodies in closed-form deformations (whole, as a camera sees them, noisy, as bare points);
files with faults; and pairs that no fit can bring together: other bodies, other units, random points,
mirror images, shuffled vertices. Needs numpy.

The error is the mean over all source vertices, in percent of the diagonal of the truth; "rigid" is
what the best rigid motion leaves. A result is off if its error is above 2 %, or above rigid (by a
twentieth, and above 0.5 %), or if the pair is wrong. All others are right. The last lines give the
share of the results that are off and called doubtful or bad, and of those that are right and called so.
A pair that ed_fit refuses (exit code 2 or 3) counts as bad. The script exits with 1 if fewer than 90 %
of the first or more than 10 % of the second are called so.

  scripts/bench_verdict.py
  scripts/bench_verdict.py --pairs=dolphin --keep=/tmp/pairs --csv=build/verdicts.csv
"""
import argparse
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import ply
from program_runs import ROOT, default_folders
from verdict_pairs import verdict_pairs

OFF_PERCENT = 2.0
CALLED, MISCALLED = 0.9, 0.1


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/release/apps", type=Path, metavar="DIR",
                        help="folder of ed_fit [build/release/apps]")
    parser.add_argument("--data", action="append", type=Path, metavar="DIR",
                        help="folder of pairs, repeatable [data/ and $CERES_ED_DATA]")
    parser.add_argument("--pairs", default="", help="only pairs whose names contain this [all]")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="leave pairs and reports here")
    parser.add_argument("--csv", metavar="FILE", help="also write the rows to this file")
    return parser.parse_args()


def rigid_residual(source, truth):
    a, b = source - source.mean(axis=0), truth - truth.mean(axis=0)
    u, _, vt = np.linalg.svd(a.T @ b)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    return np.linalg.norm(a @ (u @ flip @ vt) - b, axis=1).mean()


def fit(pair, options, work):
    """Returns the row of a pair: error, rigid, grade and reasons."""
    output, report = work / f"{pair.name}.fitted.ply", work / f"{pair.name}.json"
    report.unlink(missing_ok=True)
    run = subprocess.run([options.bin / "ed_fit", pair.source, pair.target, f"--output={output}",
                          f"--report={report}", "--quiet", *pair.flags],
                         capture_output=True, text=True, check=False)
    row = {"pair": pair.name, "kind": pair.kind, "error": None, "rigid": None, "grade": "bad",
           "reasons": "refused", "off": True}
    if run.returncode not in (0, 2, 3):
        sys.exit(f"bench_verdict.py: {pair.name}: exit code {run.returncode}: {run.stderr}")
    if run.returncode == 0:
        said = json.loads(report.read_text())["verdict"]
        row["grade"] = said["grade"]
        row["reasons"] = ", ".join(f"{one['code']} {one['value']:.3g}" for one in said["reasons"])
    if pair.truth is not None:
        scale = 100.0 / np.linalg.norm(np.ptp(pair.truth, axis=0))
        row["rigid"] = scale * rigid_residual(ply.points(ply.read_ply(pair.source)), pair.truth)
        if run.returncode == 0:
            fitted = ply.points(ply.read_ply(output))
            row["error"] = scale * np.linalg.norm(fitted - pair.truth, axis=1).mean()
            row["off"] = (row["error"] > OFF_PERCENT
                          or row["error"] > max(0.5, 1.05 * row["rigid"]))
    elif not pair.wrong:
        row["off"] = False
    output.unlink(missing_ok=True)
    return row


def share(rows):
    called = sum(row["grade"] != "good" for row in rows)
    return called, len(rows), called / max(len(rows), 1)


def print_rows(rows):
    def number(value):
        return "-" if value is None else f"{value:.3f}"
    width = max(len(row["pair"]) for row in rows)
    print(f"{'pair':{width}}  {'kind':11}  error %  rigid %  {'is':5}  {'verdict':8}  reasons")
    for row in rows:
        called = row["grade"] != "good"
        mark = "" if called == row["off"] else "  <--"
        print(f"{row['pair']:{width}}  {row['kind']:11}  {number(row['error']):>7}  "
              f"{number(row['rigid']):>7}  {'off' if row['off'] else 'right':5}  "
              f"{row['grade']:8}  {row['reasons']}{mark}")


def main():
    options = parse_options()
    with tempfile.TemporaryDirectory(prefix="bench_verdict_") as temporary:
        work = options.keep or Path(temporary)
        work.mkdir(parents=True, exist_ok=True)
        pairs = [pair for pair in verdict_pairs(options.data or default_folders(), work)
                 if options.pairs in pair.name]
        rows = []
        for number, pair in enumerate(pairs, 1):
            print(f"[{number}/{len(pairs)}] {pair.name}", file=sys.stderr)
            rows.append(fit(pair, options, work))
    print_rows(rows)
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    off = share([row for row in rows if row["off"]])
    right = share([row for row in rows if not row["off"]])
    print(f"\noff:   {off[0]} of {off[1]} called doubtful or bad ({100.0 * off[2]:.0f} %)")
    print(f"right: {right[0]} of {right[1]} called doubtful or bad ({100.0 * right[2]:.0f} %)")
    return 0 if off[2] >= CALLED and right[2] <= MISCALLED else 1


if __name__ == "__main__":
    sys.exit(main())
