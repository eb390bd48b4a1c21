#!/usr/bin/env python3
"""Tabulates errors and times of ed_fit and ed_slam against the number of points that they use.

Points are thinned evenly: --max_samples for each surface of a pair, --max_observations for the map in a
frame. Pairs, sequences and columns are those of bench_pairs.py and bench_sequences.py. A number above
that of the points changes nothing. The script exits with 1 when a run fails or two runs of one count
differ, and with 2 on a wrong call.

  scripts/bench_points.py
  scripts/bench_points.py --pairs=bear_full --samples=12000,3000 --sequences=heart --runs=3
  scripts/bench_points.py --page=ceres_ed/solver/README.md
"""
import argparse
import sys
import tempfile
from pathlib import Path

from bench_sequences import bench_sequence, list_sequences
from bench_tables import cell, check_marks, table, write_between
from pair_runs import bench_pair, find_pairs
from program_runs import PROGRAM, ROOT, RunFailed, Variant, default_folders, names
from sequence_runs import CACHE

BEGIN, END = "<!-- bench_points.py: begin -->", "<!-- bench_points.py: end -->"
PAIRS = "bear_full,horse_full,liver_partial,human_views,snoopy_a"
SEQUENCES = "liver_breath_render,heart"

# Field, heading, decimals.
OF_PAIRS = [("truth", "truth %", 3), ("surface", "surface %", 3), ("backward", "target %", 3),
            ("cpu_s", "cpu s", 2)]
OF_SEQUENCES = [("surface_seen", "surface mm", 3), ("tracking_seen", "seen mm", 3),
                ("tracking_hidden", "hidden mm", 3), ("ms_level1", "level1 ms", 1),
                ("cpu", "cpu ms", 1)]


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--runs", type=int, default=1, help="runs of each count [1]")
    parser.add_argument("--pairs", default=PAIRS, metavar="NAMES", help=f"[{PAIRS}]")
    parser.add_argument("--sequences", default=SEQUENCES, metavar="NAMES", help=f"[{SEQUENCES}]")
    parser.add_argument("--samples", default="12000,6000,3000,1500", metavar="COUNTS",
                        help="values of --max_samples of ed_fit [12000,6000,3000,1500]")
    parser.add_argument("--observations", default="6000,1500,750,375", metavar="COUNTS",
                        help="values of --max_observations of ed_slam [6000,1500,750,375]")
    parser.add_argument("--page", metavar="FILE",
                        help="also put the tables between the marks of this page")
    options = parser.parse_args()
    if options.page:
        check_marks(options.page, BEGIN, END)
    options.data = default_folders()
    options.cache, options.simulate_flags, options.fresh = CACHE, "", False
    options.static_residual = ""
    options.ed_eval = options.bin / "ed_eval"
    return options


def variants(program, flag, counts):
    return [Variant(count, program, [f"--{flag}={count}"]) for count in names(counts)]


def lines_of(rows, name, heading, columns):
    return table([name, heading, *(title for _, title, _ in columns)],
                 [[f"`{row[name]}`", row["variant"],
                   *(cell(row[key], decimals) for key, _, decimals in columns)] for row in rows])


def measure(options, work):
    """Returns the lines of both tables, and whether all runs succeeded."""
    failed, lines = False, []
    fits = variants(options.bin / "ed_fit", "max_samples", options.samples)
    tracks = variants(options.bin / "ed_slam", "max_observations", options.observations)
    pairs = find_pairs(options.data, names(options.pairs)) if options.pairs else []
    sequences = list_sequences(options) if options.sequences else {}
    jobs = [(pair.name, "pair", lambda pair=pair: bench_pair(fits, pair, options, work))
            for pair in pairs]
    jobs += [(name, "sequence", lambda make=make: bench_sequence(tracks, make(), options, work))
             for name, make in sequences.items()]
    rows = {"pair": [], "sequence": []}
    for number, (name, kind, job) in enumerate(jobs, 1):
        print(f"[{number}/{len(jobs)}] {name}", file=sys.stderr)
        try:
            measured, agreed = job()
        except RunFailed as error:
            print(f"{PROGRAM}: {name}: {error}", file=sys.stderr)
            failed = True
            continue
        failed = failed or not agreed
        rows[kind] += measured
    if rows["pair"]:
        lines += lines_of(rows["pair"], "pair", "samples", OF_PAIRS) + [""]
    if rows["sequence"]:
        lines += lines_of(rows["sequence"], "sequence", "observations", OF_SEQUENCES)
    return lines, not failed


def main():
    options = parse_options()
    with tempfile.TemporaryDirectory(prefix="bench_points_") as work:
        lines, succeeded = measure(options, Path(work))
    print("\n".join(lines))
    if options.page and succeeded:
        write_between(options.page, BEGIN, END, "\n".join(lines).strip())
    return 0 if succeeded else 1


if __name__ == "__main__":
    sys.exit(main())
