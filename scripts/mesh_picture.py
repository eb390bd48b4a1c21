"""Pictures of meshes and graphs by a z-buffer. Needs numpy and matplotlib."""
import sys
from pathlib import Path

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.collections
    import numpy as np
except ImportError as error:
    sys.exit(f"{Path(sys.argv[0]).name}: {error}; install python3-numpy and python3-matplotlib")

import ply

GRAY = np.array([0.82, 0.83, 0.85])
BLUE = np.array([0.60, 0.74, 0.90])
PR_COLOR, PI_COLOR = "#d95f02", "#2060a8"
BATCH_COLOR, TWO_LEVEL_COLOR = "#2060a8", "#c8322d"
# Of errors, from none to large ones.
HEAT = ["#fbeec2", "#fdc25a", "#f4783b", "#cf2431", "#6a0f2b"]
SUPERSAMPLING = 3


class View:
    """A perspective camera that turns around z and sees all given points."""

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
    """Returns colours by Lambert's law: lamps over the left shoulder and at the camera, both sides lit."""
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
