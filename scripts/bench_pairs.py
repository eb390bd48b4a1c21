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

ROOT = Path(__file__).resolve().parent.parent
PUBLISHED = ROOT / "data" / "published.csv"
BEGIN, END = "<!-- bench_pairs.py: begin -->", "<!-- bench_pairs.py: end -->"

# Field, heading, decimals. Compared variants show the ratio B/A of those in RATIOS.
COLUMNS = [
    ("pair", "pair", None), ("nothing", "nothing %", 2), ("rigid", "rigid %", 2),
    ("truth", "truth %", 3), ("surface", "surface %", 3), ("trimmed", "trimmed %", 3),
    ("edge_p99", "edge p99 %", 1), ("flipped", "flips", 0), ("time_s", "time s", 2),
    ("wall_s", "wall s", 2), ("cpu_s", "cpu s", 2), ("memory_mb", "MB", 0),
    ("nodes", "nodes", 0), ("inliers", "inliers", 0),
]
RATIOS = ("truth", "surface", "trimmed", "time_s", "wall_s", "cpu_s", "memory_mb")
MEDIANS = ("time_s", "wall_s", "cpu_s", "memory_mb")


class RunFailed(Exception):
    pass


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
            sys.exit(f"bench_pairs.py: {self.ed_fit} is not there; build it "
                     "(scripts/demo.sh does) or name its folder with --bin")


def find_pairs(folders, names, target):
    pairs = []
    for folder in folders:
        if not folder.is_dir():
            sys.exit(f"bench_pairs.py: {folder} is no folder")
        pairs += [Pair(source.parent, target) for source in sorted(folder.glob("*/source.ply"))
                  if (source.parent / "target.ply").exists()]
    if names:
        unknown = set(names) - {pair.name for pair in pairs}
        if unknown:
            sys.exit(f"bench_pairs.py: no pair {', '.join(sorted(unknown))}; there are "
                     f"{', '.join(pair.name for pair in pairs)}")
        pairs = [pair for pair in pairs if pair.name in names]
    if not pairs:
        sys.exit("bench_pairs.py: no pairs found")
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


def cell(value, decimals):
    if value is None:
        return "-"
    return str(value) if decimals is None else f"{value:.{decimals}f}"


def ratio_row(a, b):
    row = {key: None for key, _, _ in COLUMNS}
    row.update(pair=a["pair"], variant="B/A")
    for key in RATIOS:
        row[key] = b[key] / a[key] if a[key] and b[key] is not None else None
    return row


def print_table(rows, compared):
    columns = ([("variant", "", None)] if compared else []) + COLUMNS
    lines = [[heading for _, heading, _ in columns]]
    for row in rows:
        decimals = 2 if row["variant"] == "B/A" else None
        lines.append([cell(row[key], decimals if decimals and key in RATIOS else default)
                      for key, _, default in columns])
    if compared:  # the pair's name stands first
        lines = [[line[1], line[0]] + line[2:] for line in lines]
    text_columns = 2 if compared else 1
    widths = [max(len(line[i]) for line in lines) for i in range(len(columns))]
    for line in lines:
        print("  ".join(text.ljust(width) if i < text_columns else text.rjust(width)
                        for i, (text, width) in enumerate(zip(line, widths))))


def published_figures():
    """Returns {pair: {program: "truth %, seconds"}} of data/published.csv."""
    figures = {}
    with open(PUBLISHED, newline="") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            error = (f"{row['truth_percent']}" if row["truth_percent"] else
                     f"{row['surface_percent']} (surface)" if row["surface_percent"] else None)
            text = f"{error}; {row['seconds']} s" if error else row["note"]
            figures.setdefault(row["pair"], {})[row["program"]] = text
    return figures


def markdown(rows):
    """Returns the tables of README.md: shipped pairs, then those by others."""
    published = published_figures()
    shipped = [row for row in rows if (ROOT / "data" / row["pair"]).is_dir()]
    real = [row for row in rows if row not in shipped]
    lines = ["| shipped pair | doing nothing | best rigid | truth | surface (80 %) | flips | time s "
             "| MB | nodes |", "|---|---|---|---|---|---|---|---|---|"]
    for row in shipped:
        fields = [cell(row[key], places) for key, places in
                  (("pair", None), ("nothing", 2), ("rigid", 2), ("truth", 2), ("trimmed", 3),
                   ("flipped", 0), ("time_s", 1), ("memory_mb", 0), ("nodes", 0))]
        fields[0] = f"`{fields[0]}`"
        lines.append("| " + " | ".join(fields) + " |")
    if real:
        lines += ["", "| pair by others | nothing / best rigid | ed_fit: truth | surface | time s "
                  "| SPARE | AMM_NRR |", "|---|---|---|---|---|---|---|"]
    for row in real:
        others = published.get(row["pair"], {})
        before = (f"{cell(row['nothing'], 1)} / {cell(row['rigid'], 2)}"
                  if row["truth"] is not None else "-")
        lines.append(f"| {row['pair']} | {before} | {cell(row['truth'], 2)} "
                     f"| {cell(row['surface'], 3)} | {row['time_s']:.1f} "
                     f"| {others.get('SPARE', '-')} | {others.get('AMM_NRR', '-')} |")
    return "\n".join(lines)


def write_readme(path, rows):
    """Puts the tables between the two marks of `path`."""
    text = Path(path).read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"bench_pairs.py: {path} lacks the marks {BEGIN} and {END}")
    head, tail = text.split(BEGIN)[0], text.split(END)[1]
    Path(path).write_text(f"{head}{BEGIN}\n{markdown(rows)}\n{END}{tail}")


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
        print("bench_pairs.py: a run failed, so the README stays as it is", file=sys.stderr)
        options.readme = None
    save(options, rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
