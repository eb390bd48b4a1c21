#!/usr/bin/env python3
"""Compares the covariances of the camera that ed_slam --covariance writes with its errors.

Simulated sequences have the true poses. The error of a step is that of the motion of the camera between two
frames, in the axes of the second one: its translation, and the rotation vector that is left over. A row has

  50, 80, 95   percent of the steps inside their ellipsoids of that probability (six degrees of freedom)
  scale        the factor by which the covariances would have to be multiplied for 95 % of the steps
  mm, mrad     root mean square error of a step, and its standard deviation

kCommonPlaceScale and kCommonTurnScale (slam/levels/common_motion.h) were chosen on the kidney; the other organs
are the test.
Needs numpy.

  scripts/bench_camera_covariance.py
  scripts/bench_camera_covariance.py --scenes=heart --frames=60
"""
import argparse
import csv
import sys
import tempfile
from pathlib import Path

import numpy as np

from program_runs import ROOT, RunFailed, names, run
from sequence_runs import CACHE, simulate

# Of the chi-square distribution of six degrees of freedom.
QUANTILES = {50: 5.348, 80: 8.558, 95: 12.592}


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/release/apps", type=Path, metavar="DIR",
                        help="folder of ed_simulate and ed_slam [build/release/apps]")
    parser.add_argument("--scenes", default="kidney,heart,stomach", help="scenes of ed_simulate, with commas")
    parser.add_argument("--frames", type=int, default=120, help="frames of each sequence [120]")
    parser.add_argument("--cache", default=CACHE, type=Path, metavar="DIR", help="folder of sequences")
    return parser.parse_args()


def rotation(q):
    """Returns the matrix of the quaternion x y z w."""
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def read_poses(path):
    """Returns {frame: (rotation, centre)} of lines `frame tx ty tz qx qy qz qw`."""
    rows = np.loadtxt(path, ndmin=2)
    return {int(row[0]): (rotation(row[4:8]), row[1:4]) for row in rows}


def read_covariances(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    covariances = {}
    for row in rows:
        upper = np.zeros((6, 6))
        upper[np.triu_indices(6)] = [float(value) for value in row[1:22]]
        covariances[int(row[0])] = upper + np.triu(upper, 1).T
    return covariances


def step(poses, frame):
    """Returns the motion to `frame` in the axes of the camera ahead of it."""
    (before, origin), (after, place) = poses[frame - 1], poses[frame]
    return before.T @ after, before.T @ (place - origin)


def errors_of(out, truth):
    """Returns the errors (n, 6) of the steps, and their covariances (n, 6, 6), in the axes of the second camera."""
    estimate = {i: pose for i, pose in enumerate(read_poses(out / "trajectory.txt").values())}
    poses, covariances = read_poses(truth), read_covariances(out / "camera_covariance.csv")
    errors, matrices = [], []
    for frame, covariance in covariances.items():
        if frame not in estimate or frame - 1 not in estimate or not np.isfinite(covariance).all():
            continue
        turned, moved = step(estimate, frame)
        true_turned, true_moved = step(poses, frame)
        left = true_turned.T @ turned
        vector = 0.5 * np.array([left[2, 1] - left[1, 2], left[0, 2] - left[2, 0], left[1, 0] - left[0, 1]])
        errors.append(np.concatenate([turned.T @ (moved - true_moved), vector]))
        # The covariance has the translation in the axes of the map.
        axes = np.eye(6)
        axes[:3, :3] = estimate[frame][0].T
        matrices.append(axes @ covariance @ axes.T)
    return np.array(errors), np.array(matrices)


def main():
    options = parse_options()
    print(f"{'scene':10s}{'steps':>6s}{'50':>7s}{'80':>7s}{'95':>7s}{'scale':>8s}"
          f"{'mm':>8s}{'sd':>7s}{'mrad':>8s}{'sd':>7s}")
    for scene in names(options.scenes):
        flags = [f"--frames={options.frames}", "--width=320", "--height=240"]
        folder = simulate(options.bin / "ed_simulate", scene, flags, options.cache).folder
        with tempfile.TemporaryDirectory(prefix="bench_camera_covariance_") as work:
            out = Path(work) / "out"
            try:
                run([options.bin / "ed_slam", folder, f"--output={out}", "--covariance", "--live_every=0", "--quiet"],
                    Path(work) / "log")
            except RunFailed as error:
                print(f"bench_camera_covariance.py: {scene}: {error}", file=sys.stderr)
                return 1
            errors, covariances = errors_of(out, Path(folder) / "poses.txt")
        squared = np.einsum("ni,ni->n", errors, np.linalg.solve(covariances, errors[:, :, None])[:, :, 0])
        shares = "".join(f"{100 * np.mean(squared <= quantile):7.1f}" for quantile in QUANTILES.values())
        diagonals = np.einsum("nii->ni", covariances)
        rms = [1e3 * np.sqrt(np.mean(np.sum(part, axis=1))) for part in (
            errors[:, :3] ** 2, diagonals[:, :3], errors[:, 3:] ** 2, diagonals[:, 3:])]
        print(f"{scene:10s}{len(errors):6d}{shares}{np.quantile(squared, 0.95) / QUANTILES[95]:8.2f}"
              f"{rms[0]:8.2f}{rms[1]:7.2f}{rms[2]:8.2f}{rms[3]:7.2f}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
