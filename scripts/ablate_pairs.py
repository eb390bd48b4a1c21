#!/usr/bin/env python3
"""Fits every pair of surfaces without one ingredient of the fit, and tabulates what this costs.

The pairs are those of bench_pairs.py. The program is ablate_fit, which is built with the benchmarks
(-DCERES_ED_BUILD_BENCHMARKS=ON); `ablate_fit --list` prints which ingredients can be left out.

The first row of the table is a fit with all ingredients; each other row is a fit without one of them.
A column of a pair has the mean error in percent of the diagonal of the target's bounding box: to the
truth over all source vertices; for a partial target also, after a slash, from the target to the
result (the visible side); without a truth, between both surfaces. Flips are the flipped triangles of
all pairs. Time is the CPU time of all pairs (for each the median of --runs) relative to the first
row. The script exits with 1 when a run fails or two runs differ, and with 2 on a wrong call.

  scripts/ablate_pairs.py --bin=build/release
  scripts/ablate_pairs.py --pairs=bear_full,dolphin_bend --without=finish,two_levels
  scripts/ablate_pairs.py --page=ceres_ed/registration/README.md
"""
import argparse
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from bench_tables import cell, check_marks, table, write_between
from pair_runs import bench_pair, find_pairs
from program_runs import PROGRAM, ROOT, RunFailed, Variant, default_folders, wrong_call

BEGIN, END = "<!-- ablate_pairs.py: begin -->", "<!-- ablate_pairs.py: end -->"
NOTHING = ""


def list_ingredients(program):
    """Returns {name: what the fit does without it} in the order of the program."""
    listed = subprocess.run([program, "--list"], capture_output=True, text=True, check=True)
    return dict(line.split(" ", 1) for line in listed.stdout.splitlines())


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/release", type=Path, metavar="DIR",
                        help="build folder with apps/ and test/benchmark/ [build/release]")
    parser.add_argument("--runs", type=int, default=1, help="fits of each pair and row [1]")
    parser.add_argument("--jobs", type=int, default=1,
                        help="fits at a time; more than 1 makes times useless [1]")
    parser.add_argument("--pairs", default="", help="names, with commas between [all]")
    parser.add_argument("--without", default="", help="ingredients, with commas between [all]")
    parser.add_argument("--data", action="append", type=Path, metavar="DIR",
                        help="folder of pairs, repeatable [data/ and $CERES_ED_DATA]")
    parser.add_argument("--json", metavar="FILE", help="also write every figure there")
    parser.add_argument("--page", metavar="FILE",
                        help="also put the table between the marks of this page")
    options = parser.parse_args()
    for name in ("runs", "jobs"):
        if getattr(options, name) < 1:
            parser.error(f"--{name}={getattr(options, name)}, expected 1 or more")
    if options.page:
        check_marks(options.page, BEGIN, END)
    options.ed_eval = options.bin / "apps/ed_eval"
    return options


def choose_variants(options):
    """Returns the fit with all ingredients, then those that lack one, and what each of them means."""
    program = options.bin / "test/benchmark/ablate_fit"
    variants = [Variant(NOTHING, program, [])]
    known = list_ingredients(program)
    names = [name for name in options.without.split(",") if name] or list(known)
    if unknown := set(names) - set(known):
        wrong_call(f"no ingredient {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    return variants + [Variant(name, program, [f"--without={name}"]) for name in names], known


def fit(task):
    """Returns the row of a pair and a variant (None where a run failed), and whether all went well."""
    variant, pair, options = task
    print(f"{pair.name} without {variant.name or 'nothing'}", file=sys.stderr)
    with tempfile.TemporaryDirectory(prefix="ablate_pairs_") as work:
        try:
            rows, agreed = bench_pair([variant], pair, options, Path(work))
        except RunFailed as error:
            print(f"{PROGRAM}: {pair.name}: {error}", file=sys.stderr)
            return None, False
    return rows[0], agreed


def error_cell(row):
    if row is None:
        return "fails"
    if row["truth"] is None:
        return cell(row["surface"], 3)
    seen = f" / {row['surface']:.3f}" if row["partial"] else ""
    return f"{row['truth']:.2f}{seen}"


def table_row(label, rows, first):
    """Returns a row. `rows`, and `first` (the fit with all ingredients), are in the order of the pairs."""
    both = [(row, with_all) for row, with_all in zip(rows, first) if row and with_all]
    flips = sum(row["flipped"] for row, _ in both)
    seconds = [sum(pair[i]["cpu_s"] for pair in both) for i in range(2)]
    time = cell(seconds[0] / seconds[1], 2) if both else "-"
    return [label] + [error_cell(row) for row in rows] + [str(flips), time]


def main():
    options = parse_options()
    variants, known = choose_variants(options)
    pairs = find_pairs(options.data or default_folders(),
                       [name for name in options.pairs.split(",") if name])
    # All of a pair in a row, so that its times meet much the same machine.
    tasks = [(variant, pair, options) for pair in pairs for variant in variants]
    with ThreadPoolExecutor(options.jobs) as pool:
        outcomes = list(pool.map(fit, tasks))
    rows = {(pair.name, variant.name): row for (variant, pair, _), (row, _) in zip(tasks, outcomes)}
    of_variant = [[rows[pair.name, variant.name] for pair in pairs] for variant in variants]
    labels = ["nothing"] + [f"`{v.name}`: {known[v.name]}" for v in variants[1:]]
    lines = table(["without"] + [pair.name for pair in pairs] + ["flips", "time"],
                  [table_row(label, row, of_variant[0])
                   for label, row in zip(labels, of_variant)])
    print("\n".join(lines))
    failed = not all(well for _, well in outcomes)
    if options.json:
        report = {"runs": options.runs, "rows": [row for row, _ in outcomes if row]}
        Path(options.json).write_text(json.dumps(report, indent=2) + "\n")
    if options.page and failed:
        print(f"{PROGRAM}: a run failed, {options.page} stays as it is", file=sys.stderr)
    elif options.page:
        write_between(options.page, BEGIN, END, "\n".join(lines))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
