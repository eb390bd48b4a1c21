#!/usr/bin/env python3
"""Compares the factor with conjugate gradients on large graphs: time, memory, and the crossing point.

Each solve runs in a process of its own (linear_solver_benchmark), so that its peak memory is known. Solvers that
were slower than the fastest by --give_up at one size are not run at larger ones. Costs at the minimum must agree to
1e-6, or the script exits with 1.

  scripts/bench_linear_solvers.py
  scripts/bench_linear_solvers.py --nodes=1000,20000,200000 --page=ceres_ed/solver/README.md

The script needs a build with benchmarks (-DCERES_ED_BUILD_BENCHMARKS=ON).
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

from bench_tables import cell, check_marks, table, write_between
from program_runs import ROOT, RunFailed, run

BEGIN = "<!-- bench_linear_solvers.py: begin -->"
END = "<!-- bench_linear_solvers.py: end -->"
SOLVERS = {"Block": "factor", "TwoLevel": "two_level", "Jacobi": "block_jacobi",
           "Incomplete": "incomplete_cholesky", "Cgnr": "ceres_cgnr"}
LARGEST_DIFFERENCE = 1e-6


def measure(options, work, body, solver, nodes):
    """Returns the figures of one solve in a process of its own, or None if there is no such benchmark."""
    report = work / "solve.json"
    report.unlink(missing_ok=True)
    run([options.bin / "test/benchmark/linear_solver_benchmark",
         f"--benchmark_filter=^Solve/{body}{solver}/{nodes}/{options.threads}/",
         f"--benchmark_out={report}"], work / "solve.log")
    if not report.exists() or not report.read_text():
        return None
    entries = json.loads(report.read_text())["benchmarks"]
    return entries[0] if entries else None


def measure_body(options, work, body):
    """Returns the rows of the table for one body."""
    rows = []
    slow = set()
    for nodes in options.nodes:
        of_size = {}
        for solver in SOLVERS:
            if solver in slow:
                continue
            figures = measure(options, work, body, solver, nodes)
            if figures is None:
                slow.add(solver)
                continue
            of_size[solver] = figures
            print(f"{body} {nodes} {SOLVERS[solver]}: {figures['solve_s']:.2f} s, "
                  f"{figures['peak_MB']:.0f} MB, {figures['steps']:.0f} steps", flush=True)
        fastest = min(figures["build_s"] + figures["solve_s"] for figures in of_size.values())
        least = min(figures["cost"] for figures in of_size.values())
        for solver, figures in of_size.items():
            seconds = figures["build_s"] + figures["solve_s"]
            difference = figures["cost"] / least - 1.0
            if solver != "Cgnr" and difference > LARGEST_DIFFERENCE:
                raise RunFailed(f"{body} {nodes} {solver}: cost above the least by {difference:.1e}")
            if seconds > options.give_up * fastest:
                slow.add(solver)
            rows.append([body.lower(), f"{nodes:,}", SOLVERS[solver], cell(figures["solve_s"], 2),
                         cell(figures["steps"], 0), cell(figures["peak_MB"], 0)])
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release", help="the folder of the build")
    parser.add_argument("--nodes", default="1000,5000,20000,50000,200000", help="sizes, among those of the benchmark")
    parser.add_argument("--bodies", default="Sheet,Torus")
    parser.add_argument("--threads", type=int, default=1, choices=(1, 2))
    parser.add_argument("--give_up", type=float, default=5.0, help="leave out solvers that are slower by this factor")
    parser.add_argument("--page", type=Path, help="write the table into this page")
    options = parser.parse_args()
    options.nodes = [int(nodes) for nodes in options.nodes.split(",")]
    if options.page:
        check_marks(options.page, BEGIN, END)
    rows = []
    try:
        with tempfile.TemporaryDirectory(prefix="bench_linear_solvers_") as folder:
            for body in options.bodies.split(","):
                rows += measure_body(options, Path(folder), body)
    except RunFailed as failure:
        return f"bench_linear_solvers.py: {failure}"
    text = "\n".join(table(["body", "nodes", "solver", "seconds", "steps", "MB"], rows))
    print(text)
    if options.page:
        write_between(options.page, BEGIN, END, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
