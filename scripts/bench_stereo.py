#!/usr/bin/env python3
"""Measures depth from stereo pictures, and tracking with it.

  boards    chessboards of a stereo laparoscope (stereo_boards): how flat the matched depth of a board is
            (rms to its plane, percent of the distance), everywhere and at its corners, and by how much
            the grid of corners is too large. The same of the given corners, triangulated without any
            matching, is the error of the calibration.
  phantom   share of the pixels inside the mask of stereo_heart_phantom whose depth is found
  real      invivo_heart_40 and davinci_pull, tracked from their pictures and from the given depth:
            error of 2D tracks, and residual |z - depth| against the depth that was tracked
  simulated heart, kidney, stomach: error of the depth against truth; tracking error from stereo
            pictures and from depth with the same noise model (--disparity-sigma); time of a frame
  modes     the modes of matching: error of the depth of the heart, time of a pair

Recordings are searched in $CERES_ED_DATA and left out where they are not there. Needs python3-numpy and
python3-pil. Lengths are in millimetres. Times are those of a frame, t_total + t_load, with --threads.

  scripts/bench_stereo.py
  scripts/bench_stereo.py --parts=boards,phantom
  scripts/bench_stereo.py --page        # writes the tables into ceres_ed/stereo/README.md
"""
import argparse
import json
import os
import statistics
import sys
import tempfile
from pathlib import Path

from bench_tables import add_page_option, check_marks, table, write_between
from program_runs import PROGRAM, ROOT, RunFailed, Variant, names, run, wrong_call
from sequence_runs import CACHE, Sequence, percentile, read_frames, simulate, track

try:
    import numpy as np
    from PIL import Image
except ImportError as error:
    sys.exit(f"{PROGRAM}: {error}; install python3-numpy and python3-pil")

PAGE_FILE = ROOT / "ceres_ed/stereo/README.md"
BEGIN, END = "<!-- bench_stereo.py: begin -->", "<!-- bench_stereo.py: end -->"
PARTS = ("boards", "phantom", "real", "simulated", "modes")
SCENES = ("heart", "kidney", "stomach")
MODES = ("3way", "sgbm", "hh4", "hh")
SQUARE, COLUMNS, ROWS = 3.0, 14, 10


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--data", type=Path, metavar="DIR",
                        help="folder of recordings [$CERES_ED_DATA]")
    parser.add_argument("--cache", type=Path, default=CACHE, metavar="DIR",
                        help="where simulated sequences are kept [build/sequences]")
    parser.add_argument("--parts", default=",".join(PARTS), metavar="NAMES",
                        help=f"what to measure [{','.join(PARTS)}]")
    parser.add_argument("--threads", type=int, default=2, help="threads of ed_slam [2]")
    parser.add_argument("--disparity-sigma", type=float, default=0.25, metavar="PIXELS",
                        help="noise of the depth with which stereo is compared [0.25]")
    add_page_option(parser, PAGE_FILE, "the tables")
    options = parser.parse_args()
    if options.data is None and os.environ.get("CERES_ED_DATA"):
        options.data = Path(os.environ["CERES_ED_DATA"])
    unknown = set(names(options.parts)) - set(PARTS)
    if unknown:
        wrong_call(f"no part {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    if options.page:
        check_marks(options.page, BEGIN, END)
    return options


# Files.

def read_numbers(path):
    lines = [line.split("#")[0].split() for line in Path(path).read_text().splitlines()]
    return np.array([[float(word) for word in line] for line in lines if line])


def read_depth(folder, name):
    """Returns a depth image in millimetres, and the camera fx fy cx cy."""
    camera = read_numbers(folder / "camera.txt").ravel()
    with Image.open(folder / "depth" / name) as image:
        return 1e3 * np.array(image).astype(float) / camera[6], camera


def find_depth(options, sequence, output, *flags):
    """Runs ed_depth; returns what it says about its result."""
    run([options.bin / "ed_depth", sequence, f"--output={output}", "--overwrite", "--quiet", *flags],
        output.with_suffix(".log"))
    return json.loads((output / "info.json").read_text())


def recording(options, name):
    folder = options.data / name if options.data else None
    if folder is None or not folder.is_dir():
        print(f"{PROGRAM}: no {name}, which is left out", file=sys.stderr)
        return None
    return folder


# Chessboards.

def undistort(pixels, matrix, coefficients):
    """Returns the rays (x, y, 1) of pixels, for the distortion k1 k2 p1 p2 [k3] of OpenCV."""
    k1, k2, p1, p2, k3 = (list(coefficients) + [0.0] * 5)[:5]
    x = (pixels[:, 0] - matrix[0, 2]) / matrix[0, 0]
    y = (pixels[:, 1] - matrix[1, 2]) / matrix[1, 1]
    x0, y0 = x, y
    for _ in range(20):
        r2 = x * x + y * y
        radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
        x, y = ((x0 - 2 * p1 * x * y - p2 * (r2 + 2 * x * x)) / radial,
                (y0 - p1 * (r2 + 2 * y * y) - 2 * p2 * x * y) / radial)
    return np.stack([x, y, np.ones_like(x)], axis=1)


def triangulate(left_rays, right_rays, right_from_left):
    """Returns the points halfway between the rays, in the left camera."""
    rotation, translation = right_from_left[:3, :3], right_from_left[:3, 3]
    directions = right_rays @ rotation        # of the right rays, in the left camera
    start = -rotation.T @ translation
    points = []
    for a, b in zip(left_rays, directions):
        s, t = np.linalg.lstsq(np.stack([a, -b], axis=1), start, rcond=None)[0]
        points.append(0.5 * (s * a + start + t * b))
    return np.array(points)


def turn(quaternion, rays):
    q = np.array([quaternion[key] for key in ("qx", "qy", "qz")])
    w = quaternion["qw"]
    cross = np.cross(q, rays)
    return rays + 2.0 * (w * cross + np.cross(q, cross))


def flatness(points):
    """Returns the rms distance of points to their plane, in percent of their distance."""
    center = points.mean(axis=0)
    spread = np.linalg.svd(points - center, compute_uv=False)[-1] / np.sqrt(len(points))
    return 100.0 * spread / np.linalg.norm(center)


def size_error(points):
    """Returns by how much the grid of corners is too large, in percent: the scale of the best similarity."""
    known = np.isfinite(points[:, 2])
    index = np.arange(COLUMNS * ROWS)[known]
    board = np.stack([SQUARE * (index % COLUMNS), SQUARE * (index // COLUMNS), 0.0 * index], axis=1)
    board -= board.mean(axis=0)
    found = points[known] - points[known].mean(axis=0)
    return 100.0 * (np.linalg.svd(found.T @ board, compute_uv=False).sum() / (board ** 2).sum() - 1.0)


def sample(depth, pixels):
    """Returns the median of the depth within a pixel of each place; NaN where there is none."""
    values = []
    for u, v in np.rint(pixels).astype(int):
        part = depth[max(0, v - 1):v + 2, max(0, u - 1):u + 2]
        values.append(np.median(part[part > 0]) if (part > 0).any() else np.nan)
    return np.array(values)


def inside(shape, corners):
    """Returns the pixels inside the quadrilateral of corners, which go round."""
    v, u = np.mgrid[:shape[0], :shape[1]]
    sides = []
    for (ua, va), (ub, vb) in zip(corners, np.roll(corners, -1, axis=0)):
        sides.append((ub - ua) * (v - va) - (vb - va) * (u - ua))
    return np.all(np.array(sides) > 0, axis=0) | np.all(np.array(sides) < 0, axis=0)


def bench_boards(options, work):
    folder = recording(options, "stereo_boards")
    if folder is None:
        return None
    info = find_depth(options, folder, work / "boards")
    right_from_left = read_numbers(folder / "calib.l2r.txt")
    rows = []
    for path in sorted((folder / "left").glob("*.points.txt")):
        rays = [undistort(read_numbers(folder / side / path.name),
                          read_numbers(folder / f"calib.{side}.intrinsic.txt"),
                          read_numbers(folder / f"calib.{side}.distortion.txt").ravel())
                for side in ("left", "right")]
        given = triangulate(*rays, right_from_left)
        depth, (fx, fy, cx, cy, *_) = read_depth(work / "boards", path.name.split(".")[0] + ".png")
        turned = turn(info["rectified_from_left"], rays[0])
        pixels = turned[:, :2] / turned[:, 2:] * (fx, fy) + (cx, cy)
        matched = np.column_stack([(pixels - (cx, cy)) / (fx, fy), np.ones(len(pixels))])
        matched *= sample(depth, pixels)[:, None]
        v, u = np.nonzero((depth > 0) & inside(depth.shape, pixels[[0, 13, 139, 126]]))
        board = np.stack([(u - cx) / fx, (v - cy) / fy, np.ones(len(u))], axis=1) * depth[v, u][:, None]
        whole = inside(depth.shape, pixels[[0, 13, 139, 126]]).sum()
        offset = np.nanmedian(matched[:, 2] - turn(info["rectified_from_left"], given)[:, 2])
        rows.append([path.name.split(".")[0], f"{np.linalg.norm(given.mean(axis=0)):.0f}",
                     f"{100.0 * len(u) / whole:.0f}", f"{flatness(board):.2f}",
                     f"{flatness(matched[np.isfinite(matched[:, 2])]):.2f}", f"{flatness(given):.2f}",
                     f"{size_error(matched):+.2f}", f"{size_error(given):+.2f}", f"{offset:+.2f}"])
    return ["frame", "distance mm", "board with depth %", "rms to plane %: all", "at corners",
            "corners triangulated", "size %: matched", "triangulated", "matched - triangulated mm"], rows


# Recordings.

def bench_phantom(options, work):
    folder = recording(options, "stereo_heart_phantom")
    if folder is None:
        return None
    info = find_depth(options, folder, work / "phantom")
    return ["recording", "depth inside the mask %", "median depth mm"], [
        ["stereo_heart_phantom", f"{100.0 * info['valid_share']:.1f}", f"{1e3 * info['depth_median_m']:.1f}"]]


def frame_times(frames):
    times = [1e3 * (row["t_total"] + row["t_load"]) for row in frames[1:]]
    return statistics.median(times), percentile(times, 0.99)


def evaluate(options, sequence, result):
    report = result.with_suffix(".eval.json")
    run([options.bin / "ed_eval", f"--sequence={sequence}", f"--result={result}", f"--report={report}"],
        result.with_suffix(".eval.log"))
    return json.loads(report.read_text())


def track_real(options, work, name, pictures, flags, truth):
    """Tracks a recording; `truth` has the depth and the tracks with which it is compared."""
    variant = Variant("stereo", options.bin / "ed_slam", [f"--threads={options.threads}", *flags])
    output = work / f"{name}_run"
    track(variant, Sequence(name, pictures), output)
    frames = read_frames(output)
    errors = evaluate(options, truth, output)
    tracks = errors["tracks_2d"]
    lost = sum(row["status"] == "lost" for row in frames)
    return [name, str(lost), f"{tracks['followed']} / {tracks['tracks']}",
            f"{tracks['error']['mean']:.2f}", f"{tracks['error']['p50']:.2f}",
            f"{1e3 * errors['depth']['summary']['residual_median']['mean']:.3f}",
            *(f"{time:.0f}" for time in frame_times(frames))]


def stereo_folder(source, folder, stereo):
    """Makes a stereo sequence of a depth sequence that has the pictures of the right camera too."""
    folder.mkdir()
    for name, target in (("left", "color"), ("right", "right"), ("tracks_2d.csv", "tracks_2d.csv")):
        (folder / name).symlink_to((source / target).resolve())
    (folder / "stereo.txt").write_text(stereo)
    return folder


def bench_real(options, work):
    rows = []
    heart = recording(options, "invivo_heart_40")
    if heart:
        # Nominal, as its own depth was made with.
        pictures = stereo_folder(heart, work / "invivo", "400 400 180 180 144 360 288 0.0052\n")
        find_depth(options, pictures, work / "invivo_depth")
        rows.append(track_real(options, work, "invivo_heart_40 given depth", heart, [], heart))
        rows.append(track_real(options, work, "invivo_heart_40 stereo", pictures, [],
                               work / "invivo_depth"))
    pull = recording(options, "davinci_pull")
    if pull:
        find_depth(options, pull, work / "pull_depth", "--depth_from=stereo")
        rows.append(track_real(options, work, "davinci_pull given depth", pull, [], pull))
        rows.append(track_real(options, work, "davinci_pull stereo", pull, ["--depth_from=stereo"],
                               work / "pull_depth"))
    return (["sequence", "lost", "tracks", "mean px", "median px", "residual mm", "ms", "p99 ms"],
            rows) if rows else None


# Simulated scenes.

def depth_error(found_folder, true_folder):
    """Returns coverage %, and the median and the 95th percentile of |z - truth| in mm, of all frames."""
    errors, covered, all_true = [], 0, 0
    for path in sorted((found_folder / "depth").glob("*.png")):
        found, _ = read_depth(found_folder, path.name)
        true, _ = read_depth(true_folder, path.name)
        both = (found > 0) & (true > 0)
        errors.append(np.abs(found[both] - true[both]))
        covered += both.sum()
        all_true += (true > 0).sum()
    errors = np.concatenate(errors)
    return 100.0 * covered / all_true, np.median(errors), np.percentile(errors, 95)


def bench_simulated(options, work):
    rows = []
    simulator = options.bin / "ed_simulate"
    noise = [f"--disparity_noise={options.disparity_sigma}"]
    for scene in SCENES:
        stereo = simulate(simulator, scene, ["--stereo"], options.cache)
        exact = simulate(simulator, scene, ["--noise=0"], options.cache)
        noisy = simulate(simulator, scene, ["--noise=0", *noise], options.cache)
        find_depth(options, stereo.folder, work / scene)
        coverage, median, p95 = depth_error(work / scene, exact.folder)
        seen = {}
        for kind, sequence in (("stereo", stereo), ("depth", noisy)):
            variant = Variant(kind, options.bin / "ed_slam", [f"--threads={options.threads}"])
            output = work / f"{scene}_{kind}"
            track(variant, sequence, output)
            summary = evaluate(options, exact.folder, output)["truth"]["summary"]
            seen[kind] = 1e3 * summary["tracking_seen_mean"]["mean"]
        times = frame_times(read_frames(work / f"{scene}_stereo"))
        rows.append([scene, f"{coverage:.1f}", f"{median:.3f}", f"{p95:.2f}", f"{seen['stereo']:.3f}",
                     f"{seen['depth']:.3f}", f"{seen['stereo'] / seen['depth']:.2f}",
                     *(f"{time:.0f}" for time in times)])
    return ["scene", "depth of %", "depth error mm", "p95", "tracking: stereo mm",
            "tracking: depth mm", "ratio", "ms", "p99 ms"], rows


def bench_modes(options, work):
    rows = []
    simulator = options.bin / "ed_simulate"
    stereo = simulate(simulator, "heart", ["--stereo"], options.cache)
    exact = simulate(simulator, "heart", ["--noise=0"], options.cache)
    for mode in MODES:
        output = work / f"mode_{mode}"
        info = find_depth(options, stereo.folder, output, f"--mode={mode}", "--step=5")
        coverage, median, p95 = depth_error(output, exact.folder)
        rows.append([f"`{mode}`", f"{coverage:.1f}", f"{median:.3f}", f"{p95:.2f}",
                     f"{1e3 * info['stereo_s']:.0f}"])
    return ["mode", "depth of %", "depth error mm", "p95", "ms a pair"], rows


def main():
    options = parse_options()
    benches = {"boards": bench_boards, "phantom": bench_phantom, "real": bench_real,
               "simulated": bench_simulated, "modes": bench_modes}
    blocks = []
    with tempfile.TemporaryDirectory() as work:
        for part in names(options.parts):
            try:
                measured = benches[part](options, Path(work))
            except RunFailed as failure:
                print(f"{PROGRAM}: {part}: {failure}", file=sys.stderr)
                return 1
            if measured is None:
                continue
            print(part)
            print("\n".join(table(*measured)), end="\n\n", flush=True)
            blocks.append("\n".join(table(*measured)))
    if options.page:
        write_between(options.page, BEGIN, END, "\n\n".join(blocks))
    return 0


if __name__ == "__main__":
    sys.exit(main())
