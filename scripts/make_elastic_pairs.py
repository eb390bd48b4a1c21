#!/usr/bin/env python3
"""Bends solid bodies by linear elasticity, as pairs of surfaces with the truth outside and inside.

Each body is the closed source.ply of a pair in data/ (heart, kidney, stomach). A grid of tetrahedra
fills it; one end is held, the other end is moved and turned, and an instrument presses the side that
the camera sees. The displacement is the finite-element solution of linear elasticity with linear
tetrahedra and Poisson's ratio 0.4, so it is neither a warp of a deformation graph nor a formula. The
solution moves the vertices and, inside, small balls and a tube (tumours and a vessel).

A folder of a pair has source.ply, target.ply (one view, with its triangles cut into four, moved by a
rigid motion and with noise), gt.ply, visible.txt, inner.ply and inner_gt.ply. bench_pairs.py takes
such folders; ed_apply moves inner.ply. It needs python3-numpy and python3-scipy.

With --seed the bodies are those of data/, and everything else is drawn at random: ends, directions, motion,
dent and noise. A third of these pairs shows the whole surface. Each seed gives other pairs.

  scripts/make_elastic_pairs.py build/elastic
  scripts/make_elastic_pairs.py build/elastic --cells=30 --noise=0
  scripts/make_elastic_pairs.py build/elastic_7 --seed=7 --count=24
"""
import argparse
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import cg
from scipy.spatial import cKDTree

import ply

ROOT = Path(__file__).resolve().parent.parent
POISSON = 0.4
# Name, folder of the body, axis between the ends, direction from which the camera looks, how far
# (share of the diagonal) the free end moves, its turn about the axis in degrees, depth of the dent.
BODIES = (
    ("heart_bent", "heart_partial", (0, 0, 1), (-0.2, -1, 0.1), (0.06, 0.02, 0.0), 10, 0.03),
    ("kidney_bent", "kidney_partial", (0, 0, 1), (-0.5, -1, 0.3), (0.08, -0.03, 0.0), 0, 0.03),
    ("stomach_bent", "stomach_partial", (1, 0, 0), (0.3, -1, -0.4), (0.0, -0.05, 0.05), 8, 0.04),
    ("heart_pulled", "heart_partial", (0, 0, 1), (0.9, -0.5, 0.1), (0.0, 0.0, -0.08), 0, 0.0),
)
RANDOM_BODIES = ("heart_partial", "kidney_partial", "stomach_partial")
# Standard deviations on the targets of random pairs, as shares of the diagonal.
RANDOM_NOISE = (0.0, 0.0005, 0.002)
# The six tetrahedra of a cell, as corners numbered x + 2 y + 4 z.
TETRAHEDRA = np.array([(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7),
                       (0, 5, 1, 7)])
CORNERS = np.array([(k & 1, k >> 1 & 1, k >> 2) for k in range(8)])


def rotation(vector_deg):
    """Returns the matrix of a rotation vector in degrees."""
    vector = np.radians(np.asarray(vector_deg, float))
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def is_inside(queries, points, triangles):
    """Returns which queries the closed surface winds around (the sum of solid angles)."""
    inside = np.zeros(len(queries), bool)
    for begin in range(0, len(queries), 200):
        corners = points[triangles][None] - queries[begin:begin + 200, None, None]
        a, b, c = np.moveaxis(corners, 2, 0)
        la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
        triple = np.einsum("qti,qti->qt", a, np.cross(b, c))
        below = (la * lb * lc + np.einsum("qti,qti->qt", a, b) * lc
                 + np.einsum("qti,qti->qt", b, c) * la + np.einsum("qti,qti->qt", c, a) * lb)
        inside[begin:begin + 200] = np.arctan2(triple, below).sum(axis=1) > np.pi
    return inside


class ElasticBody:
    """Tetrahedra on a grid that contains a closed surface, and their stiffness matrix."""

    def __init__(self, points, triangles, cells):
        low, high = points.min(axis=0), points.max(axis=0)
        self.step = (high - low).max() / cells
        self.low = low - 1.5 * self.step
        size = np.ceil((high - self.low) / self.step).astype(int) + 2
        grid = np.stack(np.meshgrid(*map(np.arange, size), indexing="ij"), -1).reshape(-1, 3)
        centers = self.low + (grid + 0.5) * self.step
        # Cells at the surface belong to the body, so that it contains every vertex.
        near = cKDTree(points).query(centers)[0] < 1.2 * self.step
        kept = grid[near | is_inside(centers, points, triangles)]
        self.cell_of = {tuple(cell): i for i, cell in enumerate(kept)}
        ids = (kept[:, None] + CORNERS[None]) @ np.array([1, size[0] + 1, (size[0] + 1) * (size[1] + 1)])
        unique, index = np.unique(ids, return_inverse=True)
        self.corner = index.reshape(ids.shape)
        self.nodes = np.zeros((len(unique), 3))
        self.nodes[self.corner] = self.low + (kept[:, None] + CORNERS[None]) * self.step
        self.tets = self.corner[:, TETRAHEDRA].reshape(-1, 4)

    def stiffness(self):
        lame, shear = POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), 0.5 / (1 + POISSON)
        law = np.zeros((6, 6))
        law[:3, :3] = lame
        law[range(3), range(3)] += 2 * shear
        law[range(3, 6), range(3, 6)] = shear
        rows, columns, values = [], [], []
        for k in range(6):
            tets = self.corner[:, TETRAHEDRA[k]]
            edges = (self.nodes[tets[0, 1:]] - self.nodes[tets[0, 0]]).T
            inverse = np.linalg.inv(edges)
            gradients = np.concatenate([-inverse.sum(axis=0)[None], inverse])
            strain = np.zeros((6, 12))
            for i, (x, y, z) in enumerate(gradients):
                strain[:, 3 * i:3 * i + 3] = [(x, 0, 0), (0, y, 0), (0, 0, z), (y, x, 0), (0, z, y),
                                              (z, 0, x)]
            element = abs(np.linalg.det(edges)) / 6 * strain.T @ law @ strain
            unknowns = (3 * tets[:, :, None] + np.arange(3)).reshape(len(tets), 12)
            rows.append(np.repeat(unknowns, 12, axis=1).ravel())
            columns.append(np.tile(unknowns, (1, 12)).ravel())
            values.append(np.tile(element.ravel(), len(tets)))
        n = 3 * len(self.nodes)
        return sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows),
                                                           np.concatenate(columns))), (n, n))

    def solve(self, held, displacements):
        """Returns the displacement of every node where those of `held` are given."""
        matrix = self.stiffness()
        known = (3 * held[:, None] + np.arange(3)).ravel()
        solution = np.zeros(matrix.shape[0])
        solution[known] = displacements.ravel()
        free = np.setdiff1d(np.arange(len(solution)), known)
        inner = matrix[free][:, free]
        scale = sparse.diags(1.0 / inner.diagonal())
        solution[free], failed = cg(inner, -(matrix[free] @ solution), M=scale, maxiter=5000)
        if failed:
            raise SystemExit("make_elastic_pairs.py: the solution does not converge")
        return solution.reshape(-1, 3)

    def at(self, queries, values):
        """Returns the values of the nodes, interpolated in the tetrahedra."""
        place = (queries - self.low) / self.step
        result = np.zeros((len(queries), 3))
        for i, (cell, at) in enumerate(zip(np.floor(place).astype(int), place % 1.0)):
            corner = self.corner[self.cell_of[tuple(cell)]]
            # Within a tetrahedron of the cell, coordinates are ordered as its path of corners is.
            order = np.argsort(-at)
            path = np.concatenate([[0], np.cumsum(1 << order)])
            weights = -np.diff(np.concatenate([[1.0], at[order], [0.0]]))
            result[i] = weights @ values[corner[path]]
        return result


def inner_structures(points, triangles, seed):
    """Returns points of balls and of a tube within the surface."""
    random = np.random.default_rng(seed)
    low, high = points.min(axis=0), points.max(axis=0)
    tree, size = cKDTree(points), np.linalg.norm(high - low)
    candidates = random.uniform(low, high, (4000, 3))
    candidates = candidates[tree.query(candidates)[0] > 0.06 * size]
    candidates = candidates[is_inside(candidates, points, triangles)]
    directions = random.normal(size=(150, 3))
    ball = 0.03 * size * directions / np.linalg.norm(directions, axis=1)[:, None]
    balls = [center + ball for center in candidates[:4]]
    axis = np.argmax(high - low)
    line = candidates[np.argsort(candidates[:, axis])]
    return np.concatenate(balls + [line[::max(1, len(line) // 300)]])


def seen(points, triangles, camera):
    """Returns the triangles that face the camera and are the first ones on its lines of sight."""
    camera = np.asarray(camera, float) / np.linalg.norm(camera)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facing = normals @ camera > 0.15 * np.linalg.norm(normals, axis=1)
    across = np.linalg.svd(camera[None])[2][1:]
    centers = corners.mean(axis=1)
    depth, flat = centers @ camera, centers @ across.T
    size = np.linalg.norm(np.ptp(points, axis=0))
    tree = cKDTree(flat)
    near = tree.query_ball_point(flat, 0.012 * size)
    first = np.array([depth[i] > depth[others].max() - 0.05 * size for i, others in enumerate(near)])
    return facing & first


def random_body(random, number):
    """Returns a row as in BODIES; the camera of a pair that shows the whole surface is none."""
    name = RANDOM_BODIES[number % len(RANDOM_BODIES)]
    axis = np.eye(3)[random.integers(3)] * random.choice([-1, 1])
    camera = random.normal(size=3)
    shift = random.normal(size=3)
    shift *= random.uniform(0.0, 0.1) / np.linalg.norm(shift)
    dent = random.choice([0.0, random.uniform(0.0, 0.05)])
    is_whole = number // len(RANDOM_BODIES) % 3 == 2
    return (f"{name.split('_')[0]}_{number:02d}", name, axis, None if is_whole else camera, shift,
            random.uniform(-20.0, 20.0), dent)


def write_pair(folder, body, cells, noise):
    _, name, axis, camera, shift, turn, dent = body
    is_whole = camera is None
    if is_whole:
        camera = axis[::-1]
    source = ply.read_ply(ROOT / "data" / name / "source.ply")
    points, triangles = ply.points(source), ply.triangles(source)
    size = np.linalg.norm(np.ptp(points, axis=0))
    solid = ElasticBody(points, triangles, cells)
    axis = np.asarray(axis, float)
    along = solid.nodes @ axis
    low, high = (points @ axis).min(), (points @ axis).max()
    fixed = along > high - 0.15 * (high - low)
    moved = along < low + 0.12 * (high - low)
    camera = np.asarray(camera, float) / np.linalg.norm(camera)
    prescribed = np.zeros_like(solid.nodes)
    middle = solid.nodes[moved].mean(axis=0)
    prescribed[moved] = ((solid.nodes[moved] - middle) @ (rotation(turn * axis) - np.eye(3)).T
                         + size * np.asarray(shift))
    center = points.mean(axis=0)
    tip = points[np.argmax(points @ camera - np.linalg.norm(
        np.cross(points - center, camera), axis=1))]
    pressed = (np.linalg.norm(solid.nodes - tip, axis=1) < 0.06 * size) & ~fixed & ~moved
    prescribed[pressed] = -dent * size * camera
    held = fixed | moved | (pressed if dent > 0 else False)
    displacement = solid.solve(np.flatnonzero(held), prescribed[held])
    inner = inner_structures(points, triangles, seed=len(name))
    turned = rotation((3, -2, 4))
    place = lambda p: p @ turned.T + 0.02 * size * np.array([1, -0.5, 0.7])
    bent = lambda p: p + solid.at(p, displacement)
    finer_points, finer = ply.subdivide(points, triangles)
    target = bent(finer_points)
    visible = finer if is_whole else finer[seen(target, finer, camera)]
    used, index = np.unique(visible, return_inverse=True)
    random = np.random.default_rng(1)
    target = target[used] + noise * size * random.normal(size=(len(used), 3))
    truth = bent(points)
    seen_vertices = np.unique(triangles if is_whole else triangles[seen(truth, triangles, camera)])
    folder.mkdir(parents=True, exist_ok=True)
    ply.write_ply(folder / "source.ply", points, triangles)
    ply.write_ply(folder / "target.ply", place(target), index.reshape(visible.shape))
    ply.write_ply(folder / "gt.ply", place(truth), triangles)
    ply.write_ply(folder / "inner.ply", inner, np.zeros((0, 3), int))
    ply.write_ply(folder / "inner_gt.ply", place(bent(inner)), np.zeros((0, 3), int))
    np.savetxt(folder / "visible.txt", seen_vertices, fmt="%d")
    print(f"{folder}: {len(solid.tets)} tetrahedra, moved by "
          f"{100 * np.linalg.norm(truth - points, axis=1).mean() / size:.1f} % of the diagonal")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path, help="folder in which the folders of the pairs are made")
    parser.add_argument("--cells", type=int, default=24, help="cells along the longest side [24]")
    parser.add_argument("--noise", type=float, default=0.0005,
                        help="standard deviation on the target, share of the diagonal [0.0005]")
    parser.add_argument("--seed", type=int, help="draw pairs at random from this seed")
    parser.add_argument("--count", type=int, default=18, help="pairs that are drawn [18]")
    options = parser.parse_args()
    if options.seed is not None:
        random = np.random.default_rng(options.seed)
        for number in range(options.count):
            body = random_body(random, number)
            write_pair(options.output / body[0], body, options.cells, random.choice(RANDOM_NOISE))
        return
    for body in BODIES:
        write_pair(options.output / body[0], body, options.cells, options.noise)


if __name__ == "__main__":
    main()
