#!/usr/bin/env python3
"""Compares fits with an energy that is a function of Python with fits with the same energy in a plugin.

Both run in this process, in turn, on a plane of --points points and a bump. The plugin is
test/plugin/bowl_plugin.cc of the build. Figures are medians of --runs fits on one thread:

  whole   seconds of the fit, and the ratio of both
  calls   calls of the function in a fit, and the seconds in it

Both results must agree to 1e-9 of the plane's length.
"""
import argparse
import statistics
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release", metavar="DIR",
                        help="build folder with python/ and test/plugin/ [build/release]")
    parser.add_argument("--points", type=int, default=6000, help="points of the source [6000]")
    parser.add_argument("--runs", type=int, default=7, help="number of runs for each median [7]")
    options = parser.parse_args()
    if options.runs < 1 or options.points < 16:
        parser.error("expected --runs of 1 or more and --points of 16 or more")
    return options


def make_pair(np, points):
    n = round(points ** 0.5)
    x, y = np.meshgrid(np.linspace(0, 1, -(-points // n)), np.linspace(0, 1, n))
    columns = x.shape[1]
    corner = (np.arange(n - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    triangles = np.concatenate([np.stack([corner, corner + 1, corner + columns + 1], axis=1),
                                np.stack([corner, corner + columns + 1, corner + columns], axis=1)])
    bump = 0.1 * np.exp(-20 * ((x - 0.5)**2 + (y - 0.4)**2))
    return [(np.stack([x, y, z], axis=-1).reshape(-1, 3), triangles) for z in (0.0 * x, bump)]


class Bowl:
    """The function of the plugin; counts its calls and their seconds."""

    def __init__(self, np):
        self.np, self.calls, self.seconds = np, 0, 0.0

    def __call__(self, points, normals):
        start = time.perf_counter()
        x, y, z = points.T
        residuals = z - 0.5 * (x * x + y * y)
        jacobian = self.np.stack([-x, -y, self.np.ones_like(x)], axis=1)
        self.calls += 1
        self.seconds += time.perf_counter() - start
        return residuals, jacobian


def main():
    options = parse_options()
    sys.path.insert(0, str(options.bin / "python"))
    import numpy as np
    import ceres_ed
    plugin = options.bin / "test/plugin/bowl_plugin.so"
    source, target = make_pair(np, options.points)
    print("| mode | points | plugin s | Python s | ratio | calls | in the function s |")
    print("|---" + 6 * "|--:" + "|")
    for mode in ("batch", "two_level"):
        times = []
        for _ in range(options.runs + 1):
            start = time.perf_counter()
            expected = ceres_ed.fit(source, target, mode=mode, plugin=plugin, rigid_first=False,
                                    energies=ceres_ed.Energy("bowl", weight=20))
            middle = time.perf_counter()
            bowl = Bowl(np)
            result = ceres_ed.fit(source, target, mode=mode, rigid_first=False,
                                  energies=ceres_ed.PointEnergy(bowl, weight=20, name="bowl"))
            times.append((middle - start, time.perf_counter() - middle, bowl.calls, bowl.seconds))
            if np.abs(result.points - expected.points).max() > 1e-9:
                print("bench_point_energy.py: the two have different results", file=sys.stderr)
                return 1
        # The first run loads and warms up.
        native, python, calls, inside = (statistics.median(column) for column in zip(*times[1:]))
        print(f"| {mode} | {len(source[0])} | {native:.3f} | {python:.3f} | {python / native:.3f} | "
              f"{calls:.0f} | {inside:.3f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
