"""Pairs of surfaces whose fit should be good, and pairs that no fit can bring together. Needs numpy."""
import numpy as np

import ply


class VerdictPair:
    """Two surfaces, and the true place of every source vertex if there is one.

    `wrong` names what is wrong with a pair that has no right result; it is empty for the others.
    """

    def __init__(self, name, kind, source, target, truth=None, flags=(), wrong=""):
        self.name, self.kind, self.wrong = name, kind, wrong
        self.source, self.target, self.truth = source, target, truth
        self.flags = list(flags)


class Body:
    """A closed or open mesh in its own unit."""

    def __init__(self, name, path):
        self.name, self.path = name, path
        data = ply.read_ply(path)
        self.points, self.faces = ply.points(data), ply.triangles(data)
        self.center = 0.5 * (self.points.max(axis=0) + self.points.min(axis=0))
        self.diagonal = np.linalg.norm(np.ptp(self.points, axis=0))
        _, _, axes = np.linalg.svd(self.points - self.points.mean(axis=0), full_matrices=False)
        axes[2] *= np.sign(np.linalg.det(axes))
        self.axes = axes

    def local(self):
        """Returns the points along the principal axes, in diagonals."""
        return (self.points - self.center) @ self.axes.T / self.diagonal

    def world(self, local):
        return local * self.diagonal @ self.axes + self.center


def bend(degrees):
    """A bend of the longest axis in the plane of the first two axes, by this angle a diagonal."""
    def deform(p):
        k = np.radians(degrees)
        radius = 1.0 / k
        angle, arm = k * p[:, 0], radius - p[:, 1]
        return np.stack([arm * np.sin(angle), radius - arm * np.cos(angle), p[:, 2]], axis=1)
    return deform


def twist(degrees):
    """A twist about the longest axis, by this angle a diagonal."""
    def deform(p):
        angle = np.radians(degrees) * p[:, 0]
        c, s = np.cos(angle), np.sin(angle)
        return np.stack([p[:, 0], c * p[:, 1] - s * p[:, 2], s * p[:, 1] + c * p[:, 2]], axis=1)
    return deform


def waves(amplitude, length=0.5):
    """A smooth field of displacements of this amplitude and wave length, in diagonals."""
    def deform(p):
        phase = 2.0 * np.pi * p / length
        field = np.stack([np.sin(phase[:, 1] + 0.4), np.sin(phase[:, 2] + 1.1),
                          np.sin(phase[:, 0] + 2.3)], axis=1)
        return p + amplitude * field
    return deform


def swell(factor, width=0.2):
    """A part about a place off the centre grows by this factor."""
    def deform(p):
        center = p[np.argmax(p @ np.array([0.5, 1.0, 0.2]))]
        away = p - center
        near = np.exp(-0.5 * (away ** 2).sum(axis=1) / width ** 2)
        return p + (factor - 1.0) * near[:, None] * away
    return deform


def rotation(degrees, axis):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


def normals(points, faces):
    a, b, c = (points[faces[:, i]] for i in range(3))
    n = np.cross(b - a, c - a)
    return n / np.maximum(np.linalg.norm(n, axis=1), 1e-30)[:, None]


def remeshed(points, faces):
    """Returns another mesh of the surface: the centres of the faces, and the old vertices between."""
    centers = points[faces].mean(axis=1)
    sides = {}
    fresh = []
    for f, (a, b, c) in enumerate(faces):
        for u, v in ((a, b), (b, c), (c, a)):
            other = sides.pop((v, u), None)
            if other is None:
                sides[(u, v)] = f
            else:
                g, f_center = len(points) + other, len(points) + f
                fresh += [(v, f_center, g), (u, g, f_center)]
    fresh += [(u, v, len(points) + f) for (u, v), f in sides.items()]
    return np.concatenate([points, centers]), np.array(fresh)


def seen(points, faces, direction, cells=160):
    """Returns the faces that a camera far away in this direction sees."""
    frame = np.linalg.qr(np.column_stack([direction, [0.3, 1.0, 0.1], [1.0, 0.2, 0.7]]))[0]
    depth = points @ direction
    plane = points @ frame[:, 1:]
    cell = np.ptp(plane, axis=0).max() / cells
    pixel = np.floor((plane - plane.min(axis=0)) / cell).astype(int)
    key = pixel[:, 0] * (cells + 2) + pixel[:, 1]
    front = np.full((cells + 2) ** 2, -np.inf)
    np.maximum.at(front, key, depth)
    visible = depth >= front[key] - 3.0 * cell
    return visible[faces].all(axis=1) & (normals(points, faces) @ direction > 0.15)


def compact(points, faces):
    used, renamed = np.unique(faces, return_inverse=True)
    return points[used], renamed.reshape(-1, 3)


# What happens to a body, and what the target shows of it: deformation, whole surface, view or bare
# points, noise in diagonals, turn in degrees.
SCENES = {
    "bend_30": (bend(30.0), "whole", 0.0, 0.0),
    "bend_80_turned": (bend(80.0), "whole", 0.0, 35.0),
    "bend_200": (bend(200.0), "whole", 0.0, 0.0),
    "twist_view": (twist(40.0), "view", 0.0, 0.0),
    "waves_view_noise": (waves(0.02), "view", 0.002, 10.0),
    "swell_points": (swell(1.3), "points", 0.0, 5.0),
    "waves_noise": (waves(0.03), "whole", 0.004, 0.0),
}


def deformed_pair(body, scene, folder, seed):
    deform, shown, noise, turn = SCENES[scene]
    random = np.random.default_rng(seed)
    turned = rotation(turn, (0.3, 1.0, 0.5))
    truth = (body.world(deform(body.local())) - body.center) @ turned.T + body.center
    points, faces = remeshed(truth, body.faces)
    if shown == "view":
        kept = seen(points, faces, body.axes[2])
        points, faces = compact(points, faces[kept])
    if shown == "points":
        points, faces = points[random.permutation(len(points))[:len(points) // 2]], faces[:0]
    points = points + noise * body.diagonal * random.standard_normal(points.shape)
    target = folder / f"{body.name}_{scene}.ply"
    ply.write_ply(target, points, faces)
    return VerdictPair(f"{body.name}_{scene}", "made", body.path, target, truth)


def of_size(points, diagonal):
    center = 0.5 * (points.max(axis=0) + points.min(axis=0))
    return (points - center) * diagonal / np.linalg.norm(np.ptp(points, axis=0))


def wrong_bodies(bodies, folder):
    names = list(bodies)
    pairs = []
    for i, name in enumerate(names):
        a, b = bodies[name], bodies[names[(i + 1) % len(names)]]
        target = folder / f"{a.name}_onto_{b.name}.ply"
        ply.write_ply(target, of_size(b.points, a.diagonal) + a.center, b.faces)
        pairs.append(VerdictPair(target.stem, "wrong", a.path, target, wrong="another body"))
    return pairs


def wrong_units(bodies, folder):
    factors = (3.0, 10.0, 0.1, 25.4, 2.0, 1000.0)
    pairs = []
    for body, factor in zip(bodies.values(), factors):
        target = folder / f"{body.name}_times_{factor:g}.ply"
        ply.write_ply(target, factor * (body.world(bend(20.0)(body.local())) - body.center)
                      + body.center, body.faces)
        pairs.append(VerdictPair(target.stem, "wrong", body.path, target, wrong="another unit"))
    return pairs


def random_points(bodies, folder):
    random = np.random.default_rng(7)
    pairs = []
    for i, body in enumerate(list(bodies.values())[:4]):
        count = 4000
        box = random.uniform(-0.5, 0.5, (count, 3)) * np.ptp(body.points, axis=0)
        ball = random.standard_normal((count, 3)) * 0.15 * body.diagonal
        target = folder / f"{body.name}_{'ball' if i % 2 else 'box'}.ply"
        ply.write_ply(target, (ball if i % 2 else box) + body.center, body.faces[:0])
        pairs.append(VerdictPair(target.stem, "wrong", body.path, target, wrong="random points"))
    return pairs


def mirrored(bodies, folder):
    """Bodies without a plane of symmetry, against their image in a mirror."""
    pairs = []
    for name in ("heart_partial", "liver_partial", "heart_lv_endo_ed_es"):
        if name not in bodies:
            continue
        body = bodies[name]
        truth = body.world(body.local() * np.array([1.0, 1.0, -1.0]))
        target = folder / f"{name}_mirrored.ply"
        ply.write_ply(target, truth, body.faces[:, ::-1])
        pairs.append(VerdictPair(target.stem, "wrong", body.path, target, wrong="mirrored"))
    return pairs


def shuffled(bodies, folder):
    random = np.random.default_rng(3)
    pairs = []
    for body in list(bodies.values())[:3]:
        target = folder / f"{body.name}_shuffled.ply"
        ply.write_ply(target, body.points[random.permutation(len(body.points))], body.faces)
        pairs.append(VerdictPair(target.stem, "wrong", body.path, target, wrong="shuffled"))
    return pairs


def faulty_files(bodies, folder):
    """Pairs with faults of files that a fit must cope with: their results should be good."""
    pairs = []
    for name in ("dolphin_bend", "heart_partial", "kidney_partial"):
        body = bodies[name]
        truth = body.world(bend(25.0)(body.local()))
        points, faces = remeshed(truth, body.faces)
        soup = np.arange(3 * len(faces)).reshape(-1, 3)
        half = np.arange(len(faces)) % 3 == 0
        stray = np.concatenate([points, np.zeros((5, 3)), [body.center + 500.0 * body.diagonal]])
        variants = {"inside_out": (points, faces[:, ::-1]),
                    "patches_wound": (points, np.where(half[:, None], faces[:, ::-1], faces)),
                    "soup": (points[faces].reshape(-1, 3), soup),
                    "stray": (stray, faces)}
        for variant, (p, f) in variants.items():
            target = folder / f"{name}_{variant}.ply"
            ply.write_ply(target, p, f)
            pairs.append(VerdictPair(target.stem, "faulty file", body.path, target, truth))
    return pairs


def given_pairs(folders):
    """Pairs with the truth in `folders`, with each target that they have."""
    pairs = []
    for folder in folders:
        for truth in sorted(folder.glob("*/gt.ply")):
            at = truth.parent
            for target in ("target.ply", "target_resampled.ply"):
                if not (at / "source.ply").exists() or not (at / target).exists():
                    continue
                suffix = "" if target == "target.ply" else "_resampled"
                pairs.append(VerdictPair(at.name + suffix, "given", at / "source.ply", at / target,
                                         ply.points(ply.read_ply(truth))))
    return pairs


def verdict_pairs(folders, work):
    """Returns all pairs; the files of those that are made are in `work`."""
    given = given_pairs(folders)
    sources = {}
    for pair in given:
        sources.setdefault(pair.source.parent.name, pair.source)
    # Two pairs of one body need not both be deformed again.
    skipped = ("liver_partial_noise2", "liver_noise_10", "liver_vis_0.23", "shirt_flow",
               "tosca_michael_view", "plane_bumps")
    bodies = {name: Body(name, path) for name, path in sources.items() if name not in skipped}
    made = [deformed_pair(body, scene, work, seed) for seed, (body, scene) in enumerate(
        (body, scene) for body in bodies.values() for scene in SCENES)]
    return (given + made + faulty_files(bodies, work) + wrong_bodies(bodies, work)
            + wrong_units(bodies, work) + random_points(bodies, work) + mirrored(bodies, work)
            + shuffled(bodies, work))
