#!/usr/bin/env python3
"""Runs ed_fit on every pair of surfaces and tabulates how well and how fast.

A pair is a folder with source.ply and target.ply, and gt.ply where the truth is known. Pairs are
looked for in data/ and in the folder that the environment variable CERES_ED_DATA names. Each pair
is fitted --runs times; times and memory are medians. With --compare-flags or --compare-bin a second
variant B runs in turn with the first (A B A B ...), so that both meet the same machine.

Errors are means in percent of the diagonal of the target's bounding box, as ed_eval has them:
  nothing   source to truth, if nothing is done
  rigid     what the best rigid motion, found with the truth, leaves (needs python3-numpy)
  truth     result to truth, over all source vertices
  surface   result to target and back, between the surfaces
  trimmed   the same of the nearest 80 %: what is missing in one of both does not spoil it
  target    target to result alone: the one that counts where the target is partial
Exits with 1 when a run fails or two runs of one variant differ, with 2 on a wrong call.

  scripts/bench_pairs.py
  scripts/bench_pairs.py --pairs=dolphin_bend,heart_partial --flags="--mode=two_level --rings=4"
  scripts/bench_pairs.py --compare-flags="--mode=two_level" --csv=build/bench.csv
  scripts/bench_pairs.py --compare-bin=../before/build/release/apps
"""
import argparse
import csv
import filecmp
import json
import os
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bench_tables import COLUMNS, print_table, ratio_row, write_readme

ROOT = Path(__file__).resolve().parent.parent
MEDIANS = ("time_s", "wall_s", "cpu_s", "memory_mb")


class RunFailed(Exception):
    pass


def wrong_call(message):
    print(f"bench_pairs.py: {message}", file=sys.stderr)
    sys.exit(2)


class Pair:
    """A folder with two surfaces and perhaps the truth."""

    def __init__(self, folder, target):
        self.name = folder.name
        self.source = folder / "source.ply"
        self.target = folder / target if (folder / target).exists() else folder / "target.ply"
        truth = folder / "gt.ply"
        self.truth = truth if truth.exists() else None


class Variant:
    """A build and its flags."""

    def __init__(self, name, folder, flags):
        self.name = name
        self.ed_fit = Path(folder) / "ed_fit"
        self.flags = shlex.split(flags)
        if not os.access(self.ed_fit, os.X_OK):
            wrong_call(f"{self.ed_fit} is not there; build it (scripts/demo.sh does) or name its "
                       "folder with --bin")


def find_pairs(folders, names, target):
    pairs = []
    for folder in folders:
        if not folder.is_dir():
            wrong_call(f"{folder} is no folder")
        pairs += [Pair(source.parent, target) for source in sorted(folder.glob("*/source.ply"))
                  if (source.parent / "target.ply").exists()]
    if names:
        unknown = set(names) - {pair.name for pair in pairs}
        if unknown:
            wrong_call(f"no pair {', '.join(sorted(unknown))}; there are "
                       f"{', '.join(pair.name for pair in pairs)}")
        pairs = [pair for pair in pairs if pair.name in names]
    if not pairs:
        wrong_call("no pairs found")
    return pairs


def run(command, log):
    """Runs a program; returns its wall seconds, CPU seconds and peak megabytes."""
    with open(log, "wb") as stderr:
        start = time.monotonic()
        child = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL,
                                 stderr=stderr)
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.monotonic() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        last = Path(log).read_text(errors="replace").strip().splitlines()[-1:] or ["no message"]
        raise RunFailed(f"{shlex.join(map(str, command))}\n  exit code {child.returncode}: {last[0]}")
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024.0


def evaluate(ed_eval, result, pair, work):
    report = work / "eval.json"
    command = [ed_eval, result, pair.target, f"--source={pair.source}", f"--report={report}"]
    if pair.truth:
        command.append(f"--truth={pair.truth}")
    run(command, work / "eval.log")
    return json.loads(report.read_text())


def rigid_error(pair, diagonal):
    """Returns what the best rigid motion leaves, percent; None without truth or numpy."""
    try:
        import numpy as np
        import ply
    except ImportError:
        return None
    try:
        source = ply.points(ply.read_ply(pair.source))
        truth = ply.points(ply.read_ply(pair.truth))
    except ValueError:
        return None
    a, b = source - source.mean(axis=0), truth - truth.mean(axis=0)
    u, _, vt = np.linalg.svd(a.T @ b)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    return 100.0 * np.linalg.norm(a @ (u @ flip @ vt) - b, axis=1).mean() / diagonal


def fit_once(variant, pair, work):
    """Runs ed_fit; returns its row of times and counts."""
    report = work / "fit.json"
    command = [variant.ed_fit, pair.source, pair.target, f"--output={work / 'fitted.ply'}",
               f"--report={report}", "--quiet"] + variant.flags
    wall, cpu, memory = run(command, work / "fit.log")
    fit = json.loads(report.read_text())
    return {"time_s": fit["time_s"]["total"], "wall_s": wall, "cpu_s": cpu, "memory_mb": memory,
            "nodes": fit["nodes"]["total"], "inliers": fit["inliers"], "status": fit["status"]}


def summarise(runs, pair, ed_eval, result, work):
    evaluation = evaluate(ed_eval, result, pair, work)
    shape = evaluation["shape"] or {}
    row = dict(runs[0], pair=pair.name, truth=None, nothing=None, rigid=None)
    row.update({key: statistics.median(one[key] for one in runs) for key in MEDIANS})
    row["surface"] = evaluation["symmetric"]["mean_percent"]
    row["backward"] = evaluation["backward"]["mean_percent"]
    row["trimmed"] = 100.0 * evaluation["symmetric"]["trimmed"] / evaluation["diagonal"]
    row["edge_p99"] = 100.0 * shape["edge_p99"] if shape else None
    row["flipped"] = shape.get("flipped")
    if pair.truth:
        row["truth"] = evaluation["truth"]["mean_percent"]
        row["nothing"] = evaluate(ed_eval, pair.source, pair, work)["truth"]["mean_percent"]
        row["rigid"] = rigid_error(pair, evaluation["diagonal"])
    return row


def bench_pair(variants, pair, options, work):
    """Returns a row per variant, in the order of the variants, and whether runs agreed."""
    runs = {variant.name: [] for variant in variants}
    agreed = True
    for _ in range(options.runs):
        for variant in variants:
            runs[variant.name].append(fit_once(variant, pair, work))
            fitted, first = work / "fitted.ply", work / f"first_{variant.name}.ply"
            if len(runs[variant.name]) == 1:
                fitted.replace(first)
            elif not filecmp.cmp(fitted, first, shallow=False):
                print(f"bench_pairs.py: {pair.name}: two runs of {variant.name} differ",
                      file=sys.stderr)
                agreed = False
    rows = []
    for variant in variants:
        first = work / f"first_{variant.name}.ply"
        row = summarise(runs[variant.name], pair, options.ed_eval, first, work)
        rows.append(dict(row, variant=variant.name))
    return rows, agreed


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of ed_fit and ed_eval [build/release/apps]")
    parser.add_argument("--flags", default="", help="flags of ed_fit, of both variants [none]")
    parser.add_argument("--runs", type=int, default=3, help="fits of each pair and variant [3]")
    parser.add_argument("--pairs", default="", help="names, with commas between [all]")
    parser.add_argument("--data", action="append", type=Path, metavar="DIR",
                        help="folder of pairs, repeatable [data/ and $CERES_ED_DATA]")
    parser.add_argument("--target", default="target.ply", metavar="FILE",
                        help="name of the target where a pair has one of this name [target.ply]")
    parser.add_argument("--compare-flags", metavar="FLAGS", help="variant B has these flags, too")
    parser.add_argument("--compare-bin", metavar="DIR", help="variant B is the ed_fit of this folder")
    parser.add_argument("--csv", metavar="FILE", help="also write the rows there")
    parser.add_argument("--json", metavar="FILE", help="also write rows and options there")
    parser.add_argument("--readme", metavar="FILE",
                        help="also put the tables between the marks of this README.md")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error(f"--runs={options.runs}, expected 1 or more")
    if options.data is None:
        extra = os.environ.get("CERES_ED_DATA")
        options.data = [ROOT / "data"] + ([Path(extra)] if extra else [])
    options.compared = options.compare_flags is not None or options.compare_bin is not None
    if options.compared and options.readme:
        parser.error("--readme takes one variant alone")
    options.ed_eval = Path(options.bin) / "ed_eval"
    return options


def save(options, rows):
    if options.csv:
        keys = ["pair", "variant"] + [key for key, _, _ in COLUMNS[1:]] + ["status"]
        with open(options.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, keys, restval="", extrasaction="ignore")
            writer.writeheader()
            writer.writerows(rows)
    if options.json:
        said = {key: getattr(options, key) for key in ("flags", "runs", "target", "compare_flags")}
        Path(options.json).write_text(json.dumps({"options": said, "rows": rows}, indent=2) + "\n")
    if options.readme:
        write_readme(options.readme, rows)


def main():
    options = parse_options()
    variants = [Variant("A", options.bin, options.flags)]
    if options.compared:
        flags = f"{options.flags} {options.compare_flags or ''}"
        variants.append(Variant("B", options.compare_bin or options.bin, flags))
    pairs = find_pairs(options.data, [p for p in options.pairs.split(",") if p], options.target)

    rows, failed = [], False
    with tempfile.TemporaryDirectory(prefix="bench_pairs_") as work:
        for number, pair in enumerate(pairs, 1):
            print(f"[{number}/{len(pairs)}] {pair.name}", file=sys.stderr)
            try:
                of_pair, agreed = bench_pair(variants, pair, options, Path(work))
            except RunFailed as error:
                print(f"bench_pairs.py: {pair.name}: {error}", file=sys.stderr)
                failed = True
                continue
            failed = failed or not agreed
            rows += of_pair
            if options.compared:
                rows.append(ratio_row(*of_pair))
    print_table(rows, options.compared)
    if failed and options.readme:
        print(f"bench_pairs.py: a run failed, {options.readme} stays as it is", file=sys.stderr)
        options.readme = None
    save(options, rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
