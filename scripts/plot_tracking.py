#!/usr/bin/env python3
"""Makes scripts/images/tracking.png, the picture of tracking in README.md, from a simulated heart.

ed_simulate makes the sequence and ed_slam tracks it, both with their defaults. Three moments are drawn:
the colour image (above) and the map (below). The colour of a map point is its tracking error, that is,
the distance to the true place of its tissue at that moment. The line is the path of the estimated
camera up to that moment. The script needs python3-numpy and python3-matplotlib.

  scripts/plot_tracking.py
  scripts/plot_tracking.py --bin=build/release/apps --output=build/tracking.png
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

# First of those that need numpy and matplotlib: it says so where they are missing.
from mesh_picture import HEAT, SUPERSAMPLING, View, shade, smaller, vertex_normals
import ply
from program_runs import ROOT

import matplotlib
import matplotlib.colors
import matplotlib.pyplot as plt
import numpy as np

FRAMES = 60
MOMENTS = (1, 30, FRAMES - 1)
PANEL = (360, 270)
CAMERA_COLOR = "#2060a8"


class Truth:
    """The true surface in every frame, and the true camera."""

    def __init__(self, sequence):
        mesh = ply.read_ply(sequence / "gt_mesh_000000.ply")
        self.triangles = ply.triangles(mesh)
        self.vertices = np.fromfile(sequence / "gt_vertices.f32", "<f4").astype(float)
        self.vertices = self.vertices.reshape(FRAMES, -1, 3)
        self.cameras = read_poses(sequence / "poses.txt")

    def follow(self, points, birth_frames, frame):
        """Returns where the tissue of map points is in `frame`, and its normals.

        A point was at its place in `points`, in the world, in its frame of `birth_frames`.
        """
        places, normals = np.empty_like(points), np.empty_like(points)
        normals_now = vertex_normals(self.vertices[frame], self.triangles)
        for birth in np.unique(birth_frames):
            chosen = np.flatnonzero(birth_frames == birth)
            corners = self.vertices[birth][self.triangles]
            for rows in np.array_split(chosen, 1 + len(chosen) // 200):
                face, weights = closest_faces(points[rows], corners)
                now = self.triangles[face]
                places[rows] = (weights * self.vertices[frame][now]).sum(axis=1)
                normals[rows] = (weights * normals_now[now]).sum(axis=1)
        return places, normals


def closest_faces(points, corners, candidates=16):
    """Returns for each point a face close to it, and the weights (N, 3, 1) of its corners there.

    The face is the closest one among those whose centres are nearest to the point.
    """
    centers = corners.mean(axis=1)
    apart = (centers ** 2).sum(axis=1) - 2.0 * points @ centers.T
    nearest = np.argpartition(apart, candidates, axis=1)[:, :candidates]
    weights = barycentric(points[:, None], corners[nearest])
    found = (weights[..., None] * corners[nearest]).sum(axis=2)
    best = ((found - points[:, None]) ** 2).sum(axis=2).argmin(axis=1)
    rows = np.arange(len(points))
    return nearest[rows, best], weights[rows, best, :, None]


def barycentric(points, corners):
    """Returns the weights of a triangle's corners where a point is projected to it, none negative."""
    u, v, w = (corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :],
               points - corners[..., 0, :])
    uu, uv, vv = (u * u).sum(axis=-1), (u * v).sum(axis=-1), (v * v).sum(axis=-1)
    wu, wv = (w * u).sum(axis=-1), (w * v).sum(axis=-1)
    determinant = uu * vv - uv * uv
    b, c = (vv * wu - uv * wv) / determinant, (uu * wv - uv * wu) / determinant
    weights = np.maximum(np.stack([1.0 - b - c, b, c], axis=-1), 0.0)
    return weights / weights.sum(axis=-1, keepdims=True)


def read_poses(path):
    """Returns {frame: (rotation, translation)} of rows `frame tx ty tz qx qy qz qw`."""
    poses = {}
    for row in np.loadtxt(path, ndmin=2):
        x, y, z, w = row[4:8]
        rotation = np.array([
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        poses[int(row[0])] = rotation, row[1:4]
    return poses


def act(pose, points):
    return points @ pose[0].T + pose[1]


def compose(a, b):
    return a[0] @ b[0], act(a, b[1])


def track(apps, work):
    """Simulates and tracks; returns the folders of the sequence and of the result, and the errors."""
    sequence, result, report = work / "heart", work / "tracked", work / "eval.json"
    for command in (
            [apps / "ed_simulate", "heart", f"--output={sequence}", f"--frames={FRAMES}", "--quiet"],
            [apps / "ed_slam", sequence, f"--output={result}", "--live_every=1", "--quiet"],
            [apps / "ed_eval", f"--sequence={sequence}", f"--result={result}", f"--report={report}"]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return sequence, result, json.loads(report.read_text())


class Moment:
    """The map in one frame, in the frame of the true world."""

    def __init__(self, frame, result, truth, estimated):
        vertex = ply.read_ply(result / "live" / f"{frame:06d}.ply")["vertex"]
        in_camera = np.stack([vertex[axis].astype(float) for axis in ("x", "y", "z")], axis=1)
        born = np.stack([vertex[axis].astype(float) for axis in ("bx", "by", "bz")], axis=1)
        births = vertex["birth_frame"].astype(int)
        born_in_world = np.empty_like(born)
        for birth in np.unique(births):
            chosen = births == birth
            born_in_world[chosen] = act(truth.cameras[birth], born[chosen])
        places, normals = truth.follow(born_in_world, births, frame)
        # Camera frames are compared, so that no choice of a map frame enters.
        error = np.linalg.norm(act(truth.cameras[frame], in_camera) - places, axis=1)
        self.frame, self.error_mm, self.normals = frame, 1e3 * error, normals
        # The map's frame is the first camera.
        self.path = [compose(truth.cameras[0], estimated[number])
                     for number in range(frame + 1) if number in estimated]
        self.points = act(self.path[-1], in_camera)


def splat(view, points, normals, colors, radius):
    """Returns an RGB image on white of discs that lie on a surface."""
    depth = np.full((view.height, view.width), -np.inf)
    image = np.ones((view.height, view.width, 3))
    screen = view.project(points)
    normals = normals @ view.rotation.T
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    shaded = shade(normals, colors)
    reach = int(np.ceil(radius / view.depth_of_pixels(1.0)))
    offsets = np.arange(-reach, reach + 1)
    dx, dy = np.meshgrid(offsets, offsets)
    flat = view.depth_of_pixels(np.stack([dx, -dy], axis=-1).astype(float))
    for (x, y, z), normal, color in zip(screen, normals, shaded):
        if normal[2] < 0.05:  # it faces away
            continue
        column, row = int(x), int(y)
        if not (reach <= column < view.width - reach and reach <= row < view.height - reach):
            continue
        rise = -(flat @ normal[:2]) / normal[2]
        block = (slice(row - reach, row + reach + 1), slice(column - reach, column + reach + 1))
        seen = ((flat ** 2).sum(axis=-1) + rise ** 2 <= radius ** 2) & (z + rise > depth[block])
        depth[block][seen] = (z + rise)[seen]
        image[block][seen] = color
    return image


def draw_camera(axes, view, path, size):
    """Draws the path of the camera and its pyramid of vision at the end."""
    centers = view.project(np.array([translation for _, translation in path]))[:, :2] / SUPERSAMPLING
    axes.plot(*centers.T, color=CAMERA_COLOR, linewidth=1.4, zorder=3)
    corners = size * np.array([[-0.57, -0.43, 1.0], [0.57, -0.43, 1.0], [0.57, 0.43, 1.0],
                               [-0.57, 0.43, 1.0]])
    rim = view.project(act(path[-1], corners))[:, :2] / SUPERSAMPLING
    for i, corner in enumerate(rim):
        for end in (centers[-1], rim[(i + 1) % 4]):
            axes.plot(*np.stack([corner, end]).T, color=CAMERA_COLOR, linewidth=0.9, zorder=4)
    axes.scatter(*centers[-1], s=12, color=CAMERA_COLOR, zorder=5)


def compose_picture(moments, images, summary, full_scale, output):
    dpi = 100
    width, height = (3 * PANEL[0] + 20) / dpi, (2 * PANEL[1] + 110) / dpi
    figure = plt.figure(figsize=(width, height), dpi=dpi)
    grid = figure.add_gridspec(2, 3, left=0.005, right=0.995, top=1.0 - 28.0 / (height * dpi),
                               bottom=78.0 / (height * dpi), wspace=0.02, hspace=0.03)
    color_map = matplotlib.colors.LinearSegmentedColormap.from_list("error", HEAT)
    last = moments[-1]
    everything = np.concatenate([last.points] + [translation[None] for _, translation in last.path])
    view = View(everything, -78.0, 38.0, (PANEL[0] * SUPERSAMPLING, PANEL[1] * SUPERSAMPLING))
    for i, (moment, image) in enumerate(zip(moments, images)):
        axes = figure.add_subplot(grid[0, i])
        axes.imshow(image)
        axes.set_title(f"frame {moment.frame}", fontsize=11, pad=6)
        axes.set_axis_off()
        axes = figure.add_subplot(grid[1, i])
        heat = color_map(np.clip(moment.error_mm / full_scale, 0.0, 1.0))[:, :3]
        picture = splat(view, moment.points, moment.normals, heat, 0.0013)
        axes.imshow(smaller(picture), interpolation="nearest", zorder=1,
                    extent=(0, PANEL[0], PANEL[1], 0))
        draw_camera(axes, view, moment.path, 0.022)
        axes.set(xlim=(0, PANEL[0]), ylim=(PANEL[1], 0))
        axes.set_axis_off()
        errors = summary[moment.frame]
        hidden = errors["tracking_hidden"]
        hidden = f", hidden {1e3 * hidden['mean']:.2f} mm" if hidden else ""
        axes.text(4, PANEL[1] + 4, f"{len(moment.points)} points; mean error: seen "
                  f"{1e3 * errors['tracking_seen']['mean']:.2f} mm{hidden}",
                  fontsize=8.5, color="#404040", va="top")
    bar = figure.add_axes([0.36, 38.0 / (height * dpi), 0.28, 10.0 / (height * dpi)])
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0.0, full_scale), color_map)
    figure.colorbar(scale, cax=bar, orientation="horizontal", extend="max")
    bar.tick_params(labelsize=8, length=2)
    bar.set_xlabel("distance of a map point to its tissue, mm", fontsize=8.5, labelpad=2)
    Path(output).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=dpi, facecolor="white")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--output", default=ROOT / "scripts/images/tracking.png", metavar="FILE",
                        help="PNG to write [scripts/images/tracking.png]")
    parser.add_argument("--full_scale", type=float, default=2.0, metavar="MM",
                        help="error at the dark end of the colours [2]")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="plot_tracking_") as work:
        try:
            sequence, result, evaluation = track(options.bin.resolve(), Path(work))
        except (OSError, subprocess.CalledProcessError) as error:
            sys.exit(f"plot_tracking.py: {error}")
        truth, estimated = Truth(sequence), read_poses(result / "trajectory.txt")
        moments = [Moment(frame, result, truth, estimated) for frame in MOMENTS]
        images = [plt.imread(sequence / "color" / f"{frame:06d}.png") for frame in MOMENTS]
        summary = {row["frame"]: row for row in evaluation["truth"]["frames"]}
        compose_picture(moments, images, summary, options.full_scale, options.output)
    print(options.output)


if __name__ == "__main__":
    main()
