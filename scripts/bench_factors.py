#!/usr/bin/env python3
"""Compares the multifrontal factor with CHOLMOD and Eigen on the normal matrices of fits, levels and constraints.

It runs factor_comparison_benchmark, which says what the matrices are. Times are milliseconds: medians of --runs, CPU
time with one thread, wall time with two. A busy machine makes the second kind useless: the threads of OpenBLAS wait
for each other by spinning. So only one thread is measured unless --threads says otherwise.

  scripts/bench_factors.py
  scripts/bench_factors.py --threads=1,2 --runs=5 --page=ceres_ed/solver/README.md

The script needs a build with benchmarks (-DCERES_ED_BUILD_BENCHMARKS=ON).
"""
import argparse
import json
import statistics
import sys
import tempfile
from pathlib import Path

from bench_tables import cell, check_marks, table, write_between
from program_runs import ROOT, RunFailed, run

BEGIN = "<!-- bench_factors.py: begin -->"
END = "<!-- bench_factors.py: end -->"
MATRICES = {"Fit": "fit", "LargeFit": "large fit", "Level": "level", "Constraints": "constraints"}
FACTORS = {"Multifrontal": "ceres_ed", "Cholmod": "CHOLMOD", "EigenLdlt": "Eigen"}


def measure(options, work):
    """Returns {(factor, matrix, threads): median of each figure}."""
    report = work / "factors.json"
    threads = "|".join(str(count) for count in options.threads)
    run([options.bin / "test/benchmark/factor_comparison_benchmark", f"--benchmark_filter=/({threads})/",
         f"--benchmark_repetitions={options.runs}", "--benchmark_min_time=0.5", f"--benchmark_out={report}"],
        work / "factors.log")
    runs = {}
    for entry in json.loads(report.read_text())["benchmarks"]:
        if entry["run_type"] != "iteration":
            continue
        factor, matrix, count = entry["run_name"].split("/")[:3]
        runs.setdefault((factor, matrix, int(count)), []).append(entry)
    return {key: {figure: statistics.median(entry[figure] for entry in entries)
                  for figure in ("cpu_time", "real_time", "analysis_ms", "solve_ms", "factor_MB")}
            for key, entries in runs.items()}


def rows_of(measured, threads):
    for matrix, name in MATRICES.items():
        for count in threads:
            for factor, shown in FACTORS.items():
                figures = measured.get((factor, matrix, count))
                if figures is None:
                    continue
                factor_ms = figures["cpu_time" if count == 1 else "real_time"]
                yield [name, shown, str(count), cell(figures["analysis_ms"], 1), cell(factor_ms, 1),
                       cell(figures["solve_ms"], 1), cell(figures["factor_MB"], 1)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release", help="the folder of the build")
    parser.add_argument("--threads", default="1", help="1, or 1,2 on a machine without other work [1]")
    parser.add_argument("--runs", type=int, default=3, help="number of runs for each median [3]")
    parser.add_argument("--page", type=Path, help="write the table into this page")
    options = parser.parse_args()
    options.threads = [int(count) for count in options.threads.split(",")]
    if options.page:
        check_marks(options.page, BEGIN, END)
    try:
        with tempfile.TemporaryDirectory(prefix="bench_factors_") as folder:
            measured = measure(options, Path(folder))
    except RunFailed as failure:
        return f"bench_factors.py: {failure}"
    text = "\n".join(table(["matrix", "factor", "threads", "analysis", "factor ms", "solve", "MB"],
                           list(rows_of(measured, options.threads))))
    print(text)
    if options.page:
        write_between(options.page, BEGIN, END, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
