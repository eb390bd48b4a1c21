#!/usr/bin/env python3
"""Compares the covariances of ed_fit with its errors, and fits their scale.

A pair is a folder with source.ply, target.ply and gt.ply. Each is fitted with --covariance=FILE, and
ed_eval --calibration compares covariances and errors: for all points, for those within 1 % of the target,
and for hidden ones.

  50, 80, 95  percent of the points inside their ellipsoids of that probability
  ause        area under the sparsification error; that of an order that says nothing is 1
  rank        rank correlation of standard deviation and error
  scale       the factor by which the covariances would have to be multiplied for 95 % of the points of
              this pair

The last rows are means, over the pairs that the scale was fitted on (--fit, those in data/ and in folders
named by --fit_data) and over all others; every pair counts the same. Then the scale is printed that gives 95 % in the
mean of the first, without the one of them that asks for most (a body that slid as a whole says nothing about the
others): it belongs into FitUncertainty::kScale, multiplied by the one that is there. The scale at hand was fitted with
make_elastic_pairs.py build/elastic_1 --seed=1 --count=12 --cells=20. Needs numpy.

  scripts/bench_uncertainty.py --fit_data=build/elastic_1
  scripts/bench_uncertainty.py --data=data --data=DIR --pairs=heart_partial,bear_full
"""
import argparse
import json
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np

import ply
from pair_runs import find_pairs
from program_runs import ROOT, RunFailed, default_folders, names, run

PARTS = ("all", "seen", "hidden")
FIGURES = ("coverage_50", "coverage_80", "coverage_95", "ause", "rank_correlation")
# Of the chi-square distribution of three degrees of freedom.
QUANTILE_95 = 7.8147


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of ed_fit and ed_eval [build/release/apps]")
    parser.add_argument("--pairs", default="", help="names, with commas between [all with a truth]")
    parser.add_argument("--fit", default="", help="pairs that the scale is fitted on [those in data/]")
    parser.add_argument("--fit_data", type=Path, metavar="DIR", help="another folder of pairs that are fitted on")
    parser.add_argument("--data", action="append", type=Path, metavar="DIR",
                        help="folder of pairs, repeatable [data/ and $CERES_ED_DATA]")
    options = parser.parse_args()
    options.data = options.data or default_folders()
    if options.fit_data:
        options.data.append(options.fit_data)
    return options


def squared_deviations(covariance_file, truth_file):
    """Returns e^T C^-1 e of all points that have a covariance."""
    rows = ply.read_ply(covariance_file)["vertex"]
    errors = np.stack([rows[axis] for axis in "xyz"], axis=1) - ply.points(ply.read_ply(truth_file))
    entries = np.stack([rows[name] for name in ("xx", "xy", "xz", "xy", "yy", "yz", "xz", "yz", "zz")], axis=1)
    known = rows["std_dev"] > 0
    errors, matrices = errors[known], entries[known].reshape(-1, 3, 3)
    return np.einsum("ni,ni->n", errors, np.linalg.solve(matrices, errors[:, :, None])[:, :, 0])


def measure(options, pair, work):
    """Returns {part: figures or None} and the squared deviations."""
    out, covariance, report = (work / name for name in ("out.ply", "covariance.ply", "report.json"))
    run([Path(options.bin) / "ed_fit", pair.source, pair.target, f"--output={out}", f"--covariance={covariance}",
         "--quiet"], work / "log")
    run([Path(options.bin) / "ed_eval", out, pair.target, f"--truth={pair.truth}", f"--calibration={covariance}",
         f"--report={report}"], work / "log")
    figures = json.loads(report.read_text())["calibration"]
    return {part: figures[part] for part in PARTS}, squared_deviations(covariance, pair.truth)


def row(name, part, figures, scale=None):
    shares = "".join(f"{100 * figures[key]:7.1f}" for key in FIGURES[:3])
    tail = f"{scale:9.2f}" if scale else ""
    print(f"{name:24s} {part:7s}{shares}{figures['ause']:7.2f}{figures['rank_correlation']:7.2f}{tail}", flush=True)


def mean(of_pairs, part):
    of_part = [figures[part] for figures in of_pairs if figures[part]]
    return {key: statistics.mean(figures[key] for figures in of_part) for key in FIGURES} if of_part else None


def common_scale(deviations):
    """Returns the factor for which 95 % of the points are covered, in the mean over all pairs but the worst."""
    deviations = sorted(deviations, key=lambda d: np.quantile(d, 0.95))[:max(1, len(deviations) - 1)]
    values = np.concatenate(deviations)
    weights = np.concatenate([np.full(len(d), 1.0 / len(d)) for d in deviations])
    order = np.argsort(values)
    covered = np.cumsum(weights[order]) / weights.sum()
    return float(values[order][np.searchsorted(covered, 0.95)]) / QUANTILE_95


def main():
    options = parse_options()
    pairs = [pair for pair in find_pairs(options.data, names(options.pairs)) if pair.truth]
    fitted_names = set(names(options.fit)) or {folder.name for folder in (ROOT / "data").iterdir()}
    if options.fit_data:
        fitted_names |= {folder.name for folder in options.fit_data.iterdir()}
    fitted, others, deviations = [], [], []
    print(f"{'pair':24s} {'points':7s}{'50':>7s}{'80':>7s}{'95':>7s}{'ause':>7s}{'rank':>7s}{'scale':>9s}")
    for pair in pairs:
        with tempfile.TemporaryDirectory(prefix="bench_uncertainty_") as work:
            try:
                figures, squared = measure(options, pair, Path(work))
            except RunFailed as error:
                print(f"bench_uncertainty.py: {pair.name}: {error}", file=sys.stderr)
                return 1
        for part in PARTS:
            if figures[part]:
                scale = float(np.quantile(squared, 0.95)) / QUANTILE_95 if part == "all" else None
                row(pair.name, part, figures[part], scale)
        (fitted if pair.name in fitted_names else others).append(figures)
        if pair.name in fitted_names:
            deviations.append(squared)
    for name, of_pairs in (("fitted on", fitted), ("others", others)):
        for part in PARTS:
            figures = mean(of_pairs, part)
            if figures:
                row(f"mean, {len(of_pairs)} {name}", part, figures)
    for name, of_pairs in (("fitted on", fitted), ("others", others)):
        if of_pairs:
            medians = [statistics.median(figures["all"][key] for figures in of_pairs)
                       for key in ("ause", "rank_correlation")]
            print(f"median, {name}: ause {medians[0]:.2f}, rank correlation {medians[1]:.2f}")
    if deviations:
        print(f"common scale: {common_scale(deviations):.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
