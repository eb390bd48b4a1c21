#!/usr/bin/env python3
"""Compares the time of a fit in Python with that of ed_fit. Both run in processes of their own, in turn.

  fit    the fit from arrays in memory to arrays: ceres_ed.fit(), and ed_fit without reading and writing
  CPU    the CPU time of the same, which other programs on the machine disturb less
  again  the second fit of a Python process
  whole  from the start of the process to its end, with interpreter, numpy, reading and writing

Figures are medians of --runs on one thread, and their ratios to ed_fit. Both must write the same bytes.
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
    start, cpu = time.perf_counter(), time.process_time()
    result = ceres_ed.fit((points, triangles), (where, faces))
    print(time.perf_counter() - start, time.process_time() - cpu)
ceres_ed.save(sys.argv[3], result, like=source)
"""


def python_fit(options, folder, work, fits):
    """Returns [(seconds, CPU seconds)] of the fits of a process, and its seconds."""
    start = time.monotonic()
    done = subprocess.run(
        [options.python, "-c", CHILD, folder / "source.ply", folder / "target.ply",
         work / "python.ply", str(fits)],
        env={**os.environ, "PYTHONPATH": str(options.bin / "python")}, capture_output=True,
        text=True)
    if done.returncode != 0:
        raise RunFailed(f"{options.python}: {done.stderr.strip().splitlines()[-1]}")
    whole = time.monotonic() - start
    return [tuple(map(float, line.split())) for line in done.stdout.splitlines()], whole


def program_fit(options, folder, work):
    """Returns the seconds and CPU seconds of the fit in ed_fit, and the seconds of the whole program."""
    report = work / "fit.json"
    wall, cpu, _ = run([options.bin / "apps/ed_fit", folder / "source.ply", folder / "target.ply",
                      f"--output={work / 'program.ply'}", f"--report={report}", "--quiet"],
                     work / "fit.log")
    times = json.loads(report.read_text())["time_s"]
    # Reading and writing take little and wait for nobody.
    files = times["load"] + times["write"]
    return times["total"] - files, cpu - files, wall


def folder_of(pair):
    for folder in default_folders():
        if (folder / pair / "source.ply").exists():
            return folder / pair
    wrong_call(f"no pair {pair} in data/ or in $CERES_ED_DATA")


def measure(options, pair, work):
    """Returns a row of the table."""
    folder = folder_of(pair)
    runs = []
    for _ in range(options.runs):
        fit, cpu, whole = program_fit(options, folder, work)
        [(python, python_cpu)], python_whole = python_fit(options, folder, work, 1)
        [_, (again, _)], _ = python_fit(options, folder, work, 2)
        runs.append((fit, python, cpu, python_cpu, whole, python_whole, again))
    if (work / "program.ply").read_bytes() != (work / "python.ply").read_bytes():
        raise RunFailed(f"{pair}: the two have different results")
    medians = [statistics.median(column) for column in zip(*runs)]
    cells = [pair]
    for program, python in (medians[0:2], medians[2:4], medians[4:6]):
        cells += [f"{program:.3f}", f"{python:.3f}", f"{python / program:.3f}"]
    return "| " + " | ".join(cells + [f"{medians[6] / medians[0]:.3f}"]) + " |"


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release", metavar="DIR",
                        help="build folder with apps/ and python/ [build/release]")
    parser.add_argument("--python", default=sys.executable, help="interpreter [this one]")
    parser.add_argument("--pairs", default="bear_full", metavar="NAMES",
                        help="pairs of data/ and $CERES_ED_DATA, with commas between [bear_full]")
    parser.add_argument("--runs", type=int, default=7, help="number of runs for each median [7]")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error(f"--runs={options.runs}, expected 1 or more")
    return options


def main():
    options = parse_options()
    print("| pair | ed_fit s | fit() s | ratio | ed_fit CPU s | fit() CPU s | ratio | "
          "ed_fit whole s | Python whole s | ratio | again, ratio |")
    print("|---" + 10 * "|--:" + "|")
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
