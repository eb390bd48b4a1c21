#!/usr/bin/env python3
"""What a fit costs from Python, against ed_fit: both in processes of their own, in turn.

  fit    from arrays in memory to arrays: ceres_ed.fit(), and of ed_fit all but reading and writing
  again  the second fit of a Python process
  whole  from the start of the process to its end: interpreter, numpy, reading and writing included

Medians of --runs on one thread, and their ratios to ed_fit; of fit the ratio of each pair of runs, too.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program_runs import PROGRAM, ROOT, RunFailed, default_folders, run, wrong_call

CHILD = """
import sys, time
import ceres_ed
source, target = ceres_ed.load(sys.argv[1]), ceres_ed.load(sys.argv[2])
points, triangles = source.points, source.triangles
where, faces = target.points, target.triangles
for _ in range(int(sys.argv[4])):
    start = time.perf_counter()
    result = ceres_ed.fit((points, triangles), (where, faces))
    print(time.perf_counter() - start)
ceres_ed.save(sys.argv[3], result, like=source)
"""


def python_fit(options, folder, work, fits):
    """Returns the seconds of each fit of a process, and of all of it."""
    start = time.monotonic()
    done = subprocess.run(
        [options.python, "-c", CHILD, folder / "source.ply", folder / "target.ply",
         work / "python.ply", str(fits)],
        env={**os.environ, "PYTHONPATH": str(options.bin / "python")}, capture_output=True,
        text=True)
    if done.returncode != 0:
        raise RunFailed(f"{options.python}: {done.stderr.strip().splitlines()[-1]}")
    return [float(line) for line in done.stdout.split()], time.monotonic() - start


def program_fit(options, folder, work):
    """Returns the seconds of ed_fit's fit, and of all of it."""
    report = work / "fit.json"
    wall, _, _ = run([options.bin / "apps/ed_fit", folder / "source.ply", folder / "target.ply",
                      f"--output={work / 'program.ply'}", f"--report={report}", "--quiet"],
                     work / "fit.log")
    times = json.loads(report.read_text())["time_s"]
    return times["total"] - times["load"] - times["write"], wall


def folder_of(pair):
    for folder in default_folders():
        if (folder / pair / "source.ply").exists():
            return folder / pair
    wrong_call(f"no pair {pair} in data/ or in $CERES_ED_DATA")


def measure(options, pair, work):
    """Returns a row of the table."""
    folder = folder_of(pair)
    seconds = {key: [] for key in ("program", "python", "again", "program whole", "python whole")}
    for _ in range(options.runs):
        fit, whole = program_fit(options, folder, work)
        seconds["program"].append(fit)
        seconds["program whole"].append(whole)
        (fit,), whole = python_fit(options, folder, work, 1)
        seconds["python"].append(fit)
        seconds["python whole"].append(whole)
        (_, again), _ = python_fit(options, folder, work, 2)
        seconds["again"].append(again)
    if (work / "program.ply").read_bytes() != (work / "python.ply").read_bytes():
        raise RunFailed(f"{pair}: the two have different results")
    median = {key: statistics.median(values) for key, values in seconds.items()}
    each = statistics.median(b / a for a, b in zip(seconds["program"], seconds["python"]))
    return (f"| {pair} | {median['program']:.3f} | {median['python']:.3f} | "
            f"{median['python'] / median['program']:.3f} | {each:.3f} | "
            f"{median['again'] / median['program']:.3f} | {median['program whole']:.3f} | "
            f"{median['python whole']:.3f} | {median['python whole'] / median['program whole']:.3f} |")


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release", metavar="DIR",
                        help="build folder, of apps/ and python/ [build/release]")
    parser.add_argument("--python", default=sys.executable, help="interpreter [this one]")
    parser.add_argument("--pairs", default="bear_full", metavar="NAMES",
                        help="of data/ and $CERES_ED_DATA, with commas between [bear_full]")
    parser.add_argument("--runs", type=int, default=7, help="runs that medians are of [7]")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error(f"--runs={options.runs}, expected 1 or more")
    return options


def main():
    options = parse_options()
    print("| pair | ed_fit s | fit() s | ratio | run by run | again | ed_fit whole s | "
          "Python whole s | ratio |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory(prefix="bench_python_") as work:
        for pair in options.pairs.split(","):
            try:
                print(measure(options, pair, Path(work)), flush=True)
            except RunFailed as error:
                print(f"{PROGRAM}: {error}", file=sys.stderr)
                return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
