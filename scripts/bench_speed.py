#!/usr/bin/env python3
"""Measures all times of ceres_ed/solver/README.md, and writes its tables.

Each section has marks of its own in the page; --only measures a few sections:
  fit            stages of ed_fit on pairs, seconds
  slam           stages of ed_slam on sequences, milliseconds, with one thread and with two
  level_one      Level I of 20 x 20 nodes against plain auto-diff Ceres (whole_solve_benchmark)
  factorisation  ordering, factor, solve (block_cholesky_benchmark)
  constraints    one solve for point constraints (point_constraints_benchmark)

With --compare-bin the programs of another build take turns with these (A B A B ...), as "before". All
figures are medians of --runs. Pairs and sequences are those of bench_pairs.py and bench_sequences.py.
The script needs a build with benchmarks (-DCERES_ED_BUILD_BENCHMARKS=ON). It exits with 1 when a run
fails (the page then stays as it is), and with 2 on a wrong call.

  scripts/bench_speed.py
  scripts/bench_speed.py --only=fit,slam --compare-bin=../before/build/release/apps
  scripts/bench_speed.py --compare-bin=../before/build/release/apps --page=ceres_ed/solver/README.md
"""
import argparse
import sys
import tempfile
from pathlib import Path

from bench_sequences import list_sequences
from bench_tables import cell, check_marks, table, write_between
from pair_runs import find_pairs
from program_runs import PROGRAM, ROOT, RunFailed, default_folders, names, wrong_call
from sequence_runs import CACHE, STAGES
from speed_runs import FIT_STAGES, measure_benchmark, measure_fit, measure_track

PAIRS = "bear_full,horse_full,liver_partial,human_views,snoopy_a"
SEQUENCES = "liver_breath_render,invivo_heart_40,heart,kidney,stomach"


def counter(figures, key, decimals):
    return cell(figures.get(key), decimals)


def stage_rows(name, measured, keys, decimals):
    return [[f"`{name}`", variant, *(counter(figures, key, decimals) for key in keys),
             counter(figures, "memory_mb", 0)] for variant, figures in measured.items()]


def fit_section(options, work):
    rows = []
    for pair in find_pairs(options.data, names(options.pairs)):
        rows += stage_rows(pair.name, measure_fit(pair, options, work), FIT_STAGES, 3)
    return table(["pair", "", *FIT_STAGES, "MB"], rows)


def slam_section(options, work):
    keys = ("ms", "ms_p95", *(f"ms_{stage}" for stage in STAGES), "cpu")
    rows = []
    # It looks for ed_simulate there.
    places = argparse.Namespace(**{**vars(options), "bin": options.bin / "apps"})
    for name, make in list_sequences(places).items():
        rows += stage_rows(name, measure_track(make(), options, work), keys, 1)
    return table(["sequence", "", "ms", "p95", *STAGES, "cpu", "MB"], rows)


def level_one_section(options, work):
    measured = measure_benchmark("whole_solve_benchmark", options, work)
    rows = []
    for name, figures in measured.items():
        task, solver, points = name.split("/")
        block = measured[f"{task}/Block/{points}"]
        rows.append([task, solver.lower(), counter(figures, "points", 0),
                     counter(figures, "steps", 0), cell(figures["ms"], 1),
                     cell(figures["ms"] / block["ms"], 1), f"{figures['difference']:.0e}"])
    return table(["", "solver", "points", "steps", "ms", "of block", "cost differs by"], rows)


def factorisation_section(options, work):
    rows = [[name.replace("/real_time", ""), cell(figures["ms"], 2),
             counter(figures, "GFLOP", 2), counter(figures, "GFLOP/s", 1)]
            for name, figures in
            measure_benchmark("block_cholesky_benchmark", options, work).items()]
    return table(["", "ms", "GFLOP", "GFLOP/s"], rows)


def constraints_section(options, work):
    rows = [[name.replace("/real_time", "").replace("PointConstraints/", ""),
             counter(figures, "nodes", 0), counter(figures, "steps", 0), cell(figures["ms"], 0),
             f"{figures['rms']:.1e}"]
            for name, figures in
            measure_benchmark("point_constraints_benchmark", options, work).items()]
    return table(["graph, columns/rows/threads", "nodes", "steps", "ms", "rms, spacings"], rows)


SECTIONS = {"fit": fit_section, "slam": slam_section, "level_one": level_one_section,
            "factorisation": factorisation_section, "constraints": constraints_section}


def marks(section):
    return tuple(f"<!-- bench_speed.py: {section}: {side} -->" for side in ("begin", "end"))


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release", metavar="DIR",
                        help="build folder with apps/ and test/benchmark/ [build/release]")
    parser.add_argument("--compare-bin", type=Path, metavar="DIR",
                        help="folder of the ed_fit and ed_slam to compare with")
    parser.add_argument("--runs", type=int, default=5, help="number of runs for each median [5]")
    parser.add_argument("--only", default=",".join(SECTIONS), metavar="SECTIONS",
                        help="names, with commas between [all]")
    parser.add_argument("--pairs", default=PAIRS, metavar="NAMES", help=f"[{PAIRS}]")
    parser.add_argument("--sequences", default=SEQUENCES, metavar="NAMES", help=f"[{SEQUENCES}]")
    parser.add_argument("--page", metavar="FILE",
                        help="also put the tables between the marks of this page")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error(f"--runs={options.runs}, expected 1 or more")
    unknown = set(names(options.only)) - set(SECTIONS)
    if unknown:
        wrong_call(f"no section {', '.join(sorted(unknown))}; there are {', '.join(SECTIONS)}")
    if options.page:
        for section in names(options.only):
            check_marks(options.page, *marks(section))
    options.data = default_folders()
    options.cache, options.simulate_flags, options.fresh = CACHE, "", False
    return options


def main():
    options = parse_options()
    written = {}
    with tempfile.TemporaryDirectory(prefix="bench_speed_") as work:
        for section in names(options.only):
            print(section, file=sys.stderr)
            try:
                written[section] = "\n".join(SECTIONS[section](options, Path(work)))
            except RunFailed as error:
                print(f"{PROGRAM}: {section}: {error}", file=sys.stderr)
                return 1
            print(f"{section}\n{written[section]}\n")
    if options.page:
        for section, text in written.items():
            write_between(options.page, *marks(section), text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
