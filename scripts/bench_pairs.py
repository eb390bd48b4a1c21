#!/usr/bin/env python3
"""Runs ed_fit on every pair of surfaces and tabulates how accurate and how fast it is.

A pair is a folder with source.ply and target.ply, and gt.ply if the truth is known. Pairs are searched
in data/ and in the folder that the environment variable CERES_ED_DATA names. Each pair is fitted
--runs times; times and memory are medians. With --compare-flags or --compare-bin a second variant B
takes turns with the first one (A B A B ...), so both meet the same state of the machine.

Errors are means in percent of the diagonal of the target's bounding box, as ed_eval computes them:
  nothing   source to truth, before the fit
  rigid     residual of the best rigid motion, which is found with the truth (needs python3-numpy)
  truth     result to truth, over all source vertices
  surface   result to target and back, between the surfaces; for a partial target (a pair with a
            visible.txt) target to result only
  trimmed   the same for the nearest 80 %, so that parts which one surface lacks do not count
  target    target to result only
Edge p99 is the change of edge length that 1 % of the edges exceed, and flips are flipped triangles;
true p99 and true flips are those of the truth. MB is the peak memory of ed_fit. The script exits with 1
when a run fails or two runs of one variant differ, and with 2 on a wrong call.

  scripts/bench_pairs.py
  scripts/bench_pairs.py --pairs=dolphin_bend,heart_partial --flags="--mode=two_level --rings=4"
  scripts/bench_pairs.py --compare-flags="--mode=two_level" --csv=build/bench.csv
  scripts/bench_pairs.py --subdivide --pairs=bear_full,bear_full_subdivided
  scripts/bench_pairs.py --compare-bin=../before/build/release/apps
  scripts/bench_pairs.py --page      # then scripts/refresh_pages.sh, for the README
"""
import argparse
import csv
import json
import shlex
import sys
import tempfile
from pathlib import Path

from bench_tables import COLUMNS, PAGE, add_page_option, print_table, ratio_row, write_page
from pair_runs import bench_pair, find_pairs, subdivided
from program_runs import ROOT, RunFailed, Variant, default_folders


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of ed_fit and ed_eval [build/release/apps]")
    parser.add_argument("--flags", default="", help="flags of ed_fit for both variants [none]")
    parser.add_argument("--runs", type=int, default=3, help="fits of each pair and variant [3]")
    parser.add_argument("--pairs", default="", help="names, with commas between [all]")
    parser.add_argument("--data", action="append", type=Path, metavar="DIR",
                        help="folder of pairs, repeatable [data/ and $CERES_ED_DATA]")
    parser.add_argument("--target", default="target.ply", metavar="FILE",
                        help="file name of the target, for pairs that have it [target.ply]")
    parser.add_argument("--subdivide", nargs="?", const="bear_full", default="", metavar="NAMES",
                        help="also fit these pairs with every triangle cut into four [bear_full]")
    parser.add_argument("--compare-flags", metavar="FLAGS", help="additional flags of variant B")
    parser.add_argument("--compare-bin", metavar="DIR", help="variant B is the ed_fit in this folder")
    parser.add_argument("--csv", metavar="FILE", help="also write the rows to this file")
    parser.add_argument("--json", metavar="FILE", help="also write rows and options to this file")
    add_page_option(parser, PAGE, "the tables")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error(f"--runs={options.runs}, expected 1 or more")
    if options.data is None:
        options.data = default_folders()
    options.compared = options.compare_flags is not None or options.compare_bin is not None
    if options.compared and options.page:
        parser.error("--page takes one variant alone")
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
    if options.page:
        write_page(options.page, rows)


def list_pairs(options, work):
    """Returns the chosen pairs, and after them the subdivided ones."""
    names = [name for name in options.pairs.split(",") if name]
    made = {f"{name}_subdivided": name for name in options.subdivide.split(",") if name}
    originals = find_pairs(options.data, list(made.values())) if made else []
    if names and set(names) <= set(made):
        pairs = []
    else:
        pairs = find_pairs(options.data, [n for n in names if n not in made], options.target)
    return pairs + [subdivided(pair, work) for pair in originals
                    if not names or f"{pair.name}_subdivided" in names]


def main():
    options = parse_options()
    variants = [Variant("A", Path(options.bin) / "ed_fit", shlex.split(options.flags))]
    if options.compared:
        flags = shlex.split(f"{options.flags} {options.compare_flags or ''}")
        folder = Path(options.compare_bin or options.bin)
        variants.append(Variant("B", folder / "ed_fit", flags))

    rows, failed = [], False
    with tempfile.TemporaryDirectory(prefix="bench_pairs_") as work:
        pairs = list_pairs(options, Path(work))
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
    if failed and options.page:
        print(f"bench_pairs.py: a run failed, {options.page} stays as it is", file=sys.stderr)
        options.page = None
    save(options, rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
