#!/usr/bin/env python3
"""Makes scripts/images/fit.png, the picture of README.md, from pairs in data/.

Fits each pair with ed_fit's defaults and draws source, target, the result coloured by its distance to the
truth, and the graph with PR and PI nodes. Needs python3-numpy and python3-matplotlib.

  scripts/plot_readme.py
  scripts/plot_readme.py --bin=build/release/apps --output=build/fit.png
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.collections
    import matplotlib.colors
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as error:
    sys.exit(f"plot_readme.py: {error}; install python3-numpy and python3-matplotlib")

import ply

ROOT = Path(__file__).resolve().parent.parent

GRAY = np.array([0.82, 0.83, 0.85])
BLUE = np.array([0.60, 0.74, 0.90])
HEAT = ["#fbeec2", "#fdc25a", "#f4783b", "#cf2431", "#6a0f2b"]
PR_COLOR, PI_COLOR = "#d95f02", "#2060a8"
SUPERSAMPLING = 3


class View:
    """A perspective camera around z that takes in all of some points."""

    def __init__(self, points, azimuth, elevation, pixels):
        azimuth, elevation = np.radians([azimuth, elevation])
        backward = np.array([np.cos(elevation) * np.cos(azimuth),
                             np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
        right = np.cross([0.0, 0.0, 1.0], backward)
        right /= np.linalg.norm(right)
        self.rotation = np.stack([right, np.cross(backward, right), backward])
        self.center = 0.5 * (points.min(axis=0) + points.max(axis=0))
        self.distance = 4.0 * np.linalg.norm(points.max(axis=0) - points.min(axis=0))
        flat = self._flat(points)[:, :2]
        low, high = flat.min(axis=0), flat.max(axis=0)
        self.scale = 0.94 * min(pixels / (high - low))
        self.offset = 0.5 * (np.array(pixels) - self.scale * (low + high))
        self.width, self.height = pixels

    def _flat(self, points):
        local = (points - self.center) @ self.rotation.T
        factor = self.distance / (self.distance - local[:, 2])
        return np.column_stack([local[:, :2] * factor[:, None], local[:, 2]])

    def project(self, points):
        """Returns pixel x, pixel y (down) and depth (larger is nearer)."""
        flat = self._flat(points)
        x, y = (self.scale * flat[:, :2] + self.offset).T
        return np.column_stack([x, self.height - y, flat[:, 2]])

    def depth_of_pixels(self, pixels):
        return pixels / self.scale


def vertex_normals(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    face = np.cross(b - a, c - a)
    normals = np.zeros_like(points)
    for i in range(3):
        np.add.at(normals, triangles[:, i], face)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)


def shade(normals, colors):
    """Lambert, a lamp over the left shoulder and one at the camera; both sides of a surface lit."""
    normals = np.where(normals[:, 2:] < 0.0, -normals, normals)
    lamp = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])
    light = 0.42 + 0.40 * np.clip(normals @ lamp, 0.0, 1.0) + 0.22 * normals[:, 2]
    return np.clip(colors * light[:, None], 0.0, 1.0)


def render(view, points, triangles, colors):
    """Returns an RGB image on white and its depth buffer, by a z-buffer with interpolated normals."""
    shape = (view.height, view.width)
    depth, image = np.full(shape, -np.inf), np.ones(shape + (3,))
    screen = view.project(points)
    normals = vertex_normals(points, triangles) @ view.rotation.T
    for triangle in triangles:
        corners = screen[triangle]
        low = np.maximum(np.floor(corners[:, :2].min(axis=0)).astype(int), 0)
        high = np.minimum(np.ceil(corners[:, :2].max(axis=0)).astype(int) + 1,
                          [view.width, view.height])
        if np.any(high <= low):
            continue
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        edges = corners[1:, :2] - corners[0, :2]
        area = edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]
        if abs(area) < 1e-9:
            continue
        px, py = x - corners[0, 0], y - corners[0, 1]
        v = (px * edges[1, 1] - py * edges[1, 0]) / area
        w = (py * edges[0, 0] - px * edges[0, 1]) / area
        weights = np.stack([1.0 - v - w, v, w], axis=-1)
        z = weights @ corners[:, 2]
        block = (slice(low[1], high[1]), slice(low[0], high[0]))
        seen = (weights.min(axis=-1) >= -1e-6) & (z > depth[block])
        if seen.any():
            depth[block][seen] = z[seen]
            image[block][seen] = shade(weights[seen] @ normals[triangle],
                                       weights[seen] @ colors[triangle])
    return image, depth


def smaller(image):
    """Averages squares of SUPERSAMPLING x SUPERSAMPLING pixels."""
    height, width, _ = image.shape
    return image.reshape(height // SUPERSAMPLING, SUPERSAMPLING,
                         width // SUPERSAMPLING, SUPERSAMPLING, 3).mean(axis=(1, 3))


def fit(apps, pair, work):
    """Returns the paths and figures of one fit with defaults."""
    data = ROOT / "data" / pair
    out = {name: work / f"{pair}_{name}.ply" for name in ("fitted", "graph", "error")}
    report, evaluation = work / f"{pair}.json", work / f"{pair}_eval.json"
    subprocess.run([apps / "ed_fit", data / "source.ply", data / "target.ply", "--quiet",
                    f"--output={out['fitted']}", f"--graph={out['graph']}", f"--report={report}"],
                   check=True)
    subprocess.run([apps / "ed_eval", out["fitted"], data / "target.ply",
                    f"--truth={data / 'gt.ply'}", f"--error_ply={out['error']}",
                    f"--report={evaluation}"], check=True, stdout=subprocess.DEVNULL)
    out.update(source=data / "source.ply", target=data / "target.ply",
               report=json.loads(report.read_text()), eval=json.loads(evaluation.read_text()))
    return out


def draw_graph(axes, view, surface_depth, graph, shrink):
    screen = view.project(ply.points(graph))
    pixel = np.clip(screen[:, :2].astype(int), 0, [view.width - 1, view.height - 1])
    # Nodes lie on the surface: what is a few pixels behind it is hidden.
    front = screen[:, 2] > surface_depth[pixel[:, 1], pixel[:, 0]] - view.depth_of_pixels(24.0)
    ends = np.column_stack([graph["edge"]["vertex1"], graph["edge"]["vertex2"]]).astype(int)
    ends = ends[front[ends].all(axis=1) & (ends[:, 0] < ends[:, 1])]
    lines = screen[ends][:, :, :2] / shrink
    axes.add_collection(matplotlib.collections.LineCollection(lines, colors="#606468",
                                                              linewidths=0.45, zorder=2))
    relevant = graph["vertex"]["pr"] == 1
    for mask, color in ((front & relevant, PR_COLOR), (front & ~relevant, PI_COLOR)):
        axes.scatter(*(screen[mask, :2] / shrink).T, s=9, c=color, linewidths=0.3,
                     edgecolors="white", zorder=3)


def draw_row(row, files, view_angles, color_map, full_scale, panel):
    source, target, error, graph = (ply.read_ply(files[name])
                                    for name in ("source", "target", "error", "graph"))
    everything = np.concatenate([ply.points(cloud) for cloud in (source, target, error)])
    pixels = (panel[0] * SUPERSAMPLING, panel[1] * SUPERSAMPLING)
    view = View(everything, *view_angles, pixels)
    percent = 100.0 * error["vertex"]["error"].astype(float) / files["eval"]["diagonal"]
    heat = color_map(np.clip(percent / full_scale, 0.0, 1.0))[:, :3]
    pale = 0.4 * GRAY + 0.6
    clouds = [(source, GRAY), (target, BLUE), (error, heat), (error, pale)]
    for column, (cloud, color) in enumerate(clouds):
        points, triangles = ply.points(cloud), ply.triangles(cloud)
        colors = np.broadcast_to(color, points.shape)
        image, depth = render(view, points, triangles, colors)
        axes = row[column]
        axes.imshow(smaller(image), interpolation="nearest", zorder=1, aspect="equal",
                    extent=(0, panel[0], panel[1], 0))
        if column == 3:
            draw_graph(axes, view, depth, graph, SUPERSAMPLING)
        axes.set(xlim=(0, panel[0]), ylim=(panel[1], 0))
        axes.set_axis_off()


# Pair, azimuth and elevation of the view in degrees, what its target is.
ROWS = [("dolphin_bend", (38.0, 22.0), "all of it"),
        ("heart_partial", (-38.0, 18.0), "what a camera saw")]


def compose(fits, full_scale, panel, output):
    dpi = 100
    width, height = (4 * panel[0] + 20) / dpi, (len(ROWS) * panel[1] + 96) / dpi
    figure = plt.figure(figsize=(width, height), dpi=dpi)
    top = 1.0 - 30.0 / (height * dpi)
    bottom = 66.0 / (height * dpi)
    grid = figure.add_gridspec(len(ROWS), 4, left=0.01, right=0.99, top=top, bottom=bottom,
                               wspace=0.02, hspace=0.02)
    color_map = matplotlib.colors.LinearSegmentedColormap.from_list("error", HEAT)
    for i, ((pair, angles, target), files) in enumerate(zip(ROWS, fits)):
        row = [figure.add_subplot(grid[i, j]) for j in range(4)]
        draw_row(row, files, angles, color_map, full_scale, panel)
        if i == 0:
            titles = ("source", "target", "source fitted, with its error", "graph")
            for axes, title in zip(row, titles):
                axes.set_title(title, fontsize=11, pad=6)
        nodes, evaluation = files["report"]["nodes"], files["eval"]
        captions = (pair, target, f"mean {evaluation['truth']['mean_percent']:.2f} %",
                    f"{nodes['pr']} PR, {nodes['pi']} PI")
        for axes, caption in zip(row, captions):
            axes.text(4, panel[1] - 2, caption, fontsize=8.5, color="#404040", va="bottom")
    bar = figure.add_axes([0.52, 40.0 / (height * dpi), 0.20, 10.0 / (height * dpi)])
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0.0, full_scale), color_map)
    figure.colorbar(scale, cax=bar, orientation="horizontal", extend="max")
    bar.tick_params(labelsize=8, length=2)
    bar.set_xlabel("distance to the truth, % of the target's diagonal", fontsize=8.5, labelpad=2)
    handles = [plt.Line2D([], [], marker="o", linestyle="", color=color, markersize=5, label=label)
               for color, label in ((PR_COLOR, "PR: an observation reaches it"),
                                    (PI_COLOR, "PI: follows the energies"))]
    figure.legend(handles=handles, loc="lower right", bbox_to_anchor=(0.985, 0.005), fontsize=8.5,
                  frameon=False, handletextpad=0.2, labelspacing=0.3)
    Path(output).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=dpi, facecolor="white")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of ed_fit and ed_eval [build/release/apps]")
    parser.add_argument("--output", default=ROOT / "scripts/images/fit.png", metavar="FILE",
                        help="PNG to write [scripts/images/fit.png]")
    parser.add_argument("--full_scale", type=float, default=4.0, metavar="PERCENT",
                        help="error at the dark end of the colours [4]")
    options = parser.parse_args()
    apps = options.bin.resolve()
    with tempfile.TemporaryDirectory(prefix="plot_readme_") as work:
        try:
            fits = [fit(apps, pair, Path(work)) for pair, _, _ in ROWS]
        except (OSError, subprocess.CalledProcessError) as error:
            sys.exit(f"plot_readme.py: {error}")
        compose(fits, options.full_scale, (300, 200), options.output)
    print(options.output)


if __name__ == "__main__":
    main()
