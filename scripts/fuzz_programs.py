#!/usr/bin/env python3
"""Runs the programs on random small inputs with random flags, and looks whether they keep their word.

A run is one of: ed_fit on a pair, ed_fit followed by ed_apply and ed_eval, ed_slam on a sequence. Pairs
are small clouds and meshes of any kind: spheres, sheets, sticks, single points, copies of one point, far
points, values that are no numbers, any unit, cut files. Sequences are some tiny depth images with faults. Each
run keeps these rules:

  - the exit code is 0 to 4 (see the README), within --timeout seconds;
  - what does not end with 0 prints one line on stderr, printable, after any warnings; what ends with 1 or 2
    leaves no output;
  - success leaves whole outputs: a PLY with the source's vertices, all finite, and JSON that can be parsed;
  - ed_apply on the source moves what the fit has moved to the same places (to a millionth of the size).

What breaks a rule is kept in --keep with its command, and the script ends with 1. The same --seed gives the
same runs. Needs numpy.

  scripts/fuzz_programs.py --runs=500
  scripts/fuzz_programs.py --runs=1 --seed=SEED_OF_A_FAULT --keep=build/faults
"""
import argparse
import collections
import json
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import numpy as np

from program_runs import ROOT

FIT_FLAGS = {
    "mode": ["batch", "two_level", "marginal"],
    "boundary": ["keep", "cut"],
    "rings": ["0", "1", "4", "1000"],
    "rigid_first": ["true", "false"],
    "rigid_scale": ["true"],
    "node_spacing": ["1e-3", "0.01", "0.1", "1", "1e9"],
    "neighbors": ["1", "2", "4", "8"],
    "w_rot": ["0", "1", "1e9"],
    "w_reg": ["0", "1", "1e9"],
    "w_data": ["0", "1e-9", "1", "1e9"],
    "loss": ["squared", "huber", "welsch", "tukey"],
    "max_distance": ["1e-9", "0.01", "1", "1e9"],
    "max_angle_deg": ["1", "45", "90", "180"],
    "threads": ["1", "2", "3"],
    "time_limit_s": ["0.001", "0.1", "10"],
    "covariance": ["true"],
    "linear_solver": ["block", "ceres", "pcg", "auto", "ceres_cgnr"],
    "energy": ["point_to_point", "point_to_plane:loss=huber", "photometric", "point_to_point:weight=0"],
}
SLAM_FLAGS = {
    "covariance": ["true"],
    "mode": ["batch", "two_level", "marginal"],
    "rings": ["0", "2"],
    "camera": ["estimate", "fixed"],
    "first": ["0", "1", "9"],
    "step": ["1", "2"],
    "node_spacing": ["1e-4", "0.01", "1", "1e6"],
    "threads": ["1", "2"],
    "rigid": ["true"],
}


class Fault(Exception):
    pass


def random_points(rng):
    """Returns points (n, 3) and triangles (m, 3), either of which may be empty."""
    kind = rng.choice([0, 0, 1, 2, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 6])
    n = int(rng.choice([0, 1, 3, 5, 20, 100, 100, 300, 300]))
    none = np.zeros((0, 3), int)
    if kind == 0:
        points, faces = rng.normal(size=(n, 3)), none
    elif kind == 1:
        points, faces = np.repeat(rng.normal(size=(1, 3)), n, axis=0), none
    elif kind == 2:
        points, faces = np.outer(rng.random(n), [1, 0, 0]), none
    elif kind in (3, 4, 5):
        points, faces = grid_surface(rng, kind)
    else:
        points = rng.normal(size=(n, 3)) * 10.0 ** rng.integers(-9, 2, 3)
        faces = rng.integers(0, max(n, 1), (int(rng.integers(0, 200)) if n else 0, 3))
    for _ in range(rng.choice([0, 0, 0, 1, 2])):
        spoil(rng, points)
    return points * 10.0 ** rng.choice([-6, -3, 0, 0, 0, 3, 6]), faces


def grid_surface(rng, kind):
    """Returns a sheet (3), a sphere (4) or a tube (5) of a grid of points."""
    rows, columns = int(rng.integers(2, 16)), int(rng.integers(2, 16))
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows))
    u, v = u.ravel(), v.ravel()
    if kind == 3:
        points = np.stack([u, v, 0.1 * np.sin(5 * u) * rng.random()], axis=1)
    elif kind == 4:
        points = np.stack([np.sin(np.pi * v) * np.cos(2 * np.pi * u), np.sin(np.pi * v) * np.sin(2 * np.pi * u),
                           np.cos(np.pi * v)], axis=1)
    else:
        points = np.stack([np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 10 * v], axis=1)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    faces = np.concatenate([np.stack([corner, corner + 1, corner + columns], axis=1),
                            np.stack([corner + 1, corner + columns + 1, corner + columns], axis=1)])
    if rng.random() < 0.3:
        flipped = rng.random(len(faces)) < rng.random()
        faces[flipped] = faces[flipped][:, ::-1]
    return points, faces


def spoil(rng, points):
    """Puts into the points what sensors and converters put there."""
    if not len(points):
        return
    which = rng.random(len(points)) < rng.choice([0.02, 0.5])
    kind = rng.integers(6)
    if kind == 0:
        points[which] = np.nan
    elif kind == 1:
        points[which] = 0.0
    elif kind == 2:
        points[rng.integers(len(points))] = rng.normal(size=3) * 1e4
    elif kind == 3:
        points += rng.normal(size=3) * 1e6
    elif kind == 4:
        points[which] = points[0]
    else:
        points *= rng.choice([1.0, 1e-12, 1.0], 3)


def write_ply(path, points, faces, rng):
    """Writes a binary PLY; sometimes with normals or colours, sometimes cut."""
    real = rng.choice(["f4", "f8"])
    fields = [(name, real) for name in "xyz"]
    extra = rng.integers(4)
    if extra == 1:
        fields += [(name, "f4") for name in ("nx", "ny", "nz")]
    elif extra == 2:
        fields += [(name, "u1") for name in ("red", "green", "blue")]
    vertices = np.zeros(len(points), [(name, "<" + kind if kind != "u1" else kind) for name, kind in fields])
    for axis, name in enumerate("xyz"):
        with np.errstate(over="ignore"):
            vertices[name] = points[:, axis]
    for name, kind in fields[3:]:
        vertices[name] = rng.integers(0, 255, len(points)) if kind == "u1" else rng.normal(size=len(points))
    words = {"f4": "float", "f8": "double", "u1": "uchar"}
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    header += "".join(f"property {words[kind]} {name}\n" for name, kind in fields)
    if len(faces):
        header += f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
    body = vertices.tobytes() + b"".join(struct.pack("<B3i", 3, *face) for face in faces.tolist())
    data = header.encode() + b"end_header\n" + body
    if rng.random() < 0.02:
        data = data[:int(rng.integers(len(data)))]
    path.write_bytes(data)


def read_vertices(path):
    """Returns the positions of a binary PLY whose vertices come first, and have scalars only."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    types = {"float": "<f4", "double": "<f8", "uchar": "u1", "char": "i1", "int": "<i4", "uint": "<u4",
             "short": "<i2", "ushort": "<u2"}
    fields, count = [], None
    for line in data[:end].decode("latin-1").split("\n"):
        words = line.split()
        if words[:2] == ["element", "vertex"]:
            count = int(words[2])
        elif words[:1] == ["element"]:
            break
        elif words[:1] == ["property"]:
            fields.append((words[2], types[words[1]]))
    rows = np.frombuffer(data, np.dtype(fields), count, end)
    return np.stack([rows[name].astype(float) for name in "xyz"], axis=1)


def png(pixels):
    """Returns a PNG of 16-bit grey pixels."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    height, width = pixels.shape
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in pixels)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_sequence(folder, rng):
    """Writes some depth images of a wavy surface that moves, with faults."""
    width, height = int(rng.choice([8, 40, 64])), int(rng.choice([8, 30, 48]))
    u, v = np.meshgrid(np.arange(width), np.arange(height))
    (folder / "depth").mkdir()
    for frame in range(int(rng.integers(1, 5))):
        depth = 800 + 100 * np.sin(u / 5.0 + 0.1 * frame) + 50 * np.cos(v / 4.0) + rng.normal(size=u.shape) * rng.choice([0, 1])
        fault = rng.integers(8)
        if fault == 0:
            depth[rng.random(u.shape) < 0.5] = 0
        elif fault == 1:
            depth[rng.random(u.shape) < rng.choice([0.1, 1.0])] = 65535
        elif fault == 2:
            depth[:] = 0
        elif fault == 3:
            depth = rng.integers(0, 65536, u.shape)
        data = png(np.clip(depth, 0, 65535).astype(np.uint16))
        if rng.random() < 0.03:
            data = data[:int(rng.integers(len(data)))]
        (folder / "depth" / f"{frame:06d}.png").write_bytes(data)
    numbers = [60, 60, width / 2, height / 2, width, height, rng.choice([1000, 1e-3, 1e6])]
    if rng.random() < 0.05:
        numbers[int(rng.integers(7))] = rng.choice([0, -1, 1e9])
    (folder / "camera.txt").write_text(" ".join(f"{number:g}" for number in numbers) + "\n")


def random_flags(rng, table):
    names = [name for name in table if rng.random() < 0.1]
    return [f"--{name}={rng.choice(table[name])}" for name in names]


def run(command, timeout):
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=timeout, check=False)
    except subprocess.TimeoutExpired as error:
        raise Fault(f"still running after {timeout} s") from error
    stderr = done.stderr.decode("utf-8", "replace")
    if done.returncode not in (0, 1, 2, 3, 4):
        raise Fault(f"exit code {done.returncode}: {stderr[-500:]}")
    lines = stderr.splitlines()
    if any(not line.isprintable() for line in lines):
        raise Fault(f"stderr has control characters: {stderr!r}")
    program = Path(command[0]).name
    errors = [line for line in lines if not line.startswith(f"{program}: warning: ")]
    if done.returncode != 0 and (len(errors) != 1 or not errors[0].startswith(program + ":")):
        raise Fault(f"exit code {done.returncode}, and not one line on stderr: {stderr!r}")
    if done.returncode == 0 and errors:
        raise Fault(f"stderr has more than warnings: {stderr!r}")
    return done.returncode


def check_fit(options, rng, folder):
    """Fits a random pair, and applies its warp to the source."""
    source, faces = random_points(rng)
    write_ply(folder / "source.ply", source, faces, rng)
    if rng.random() < 0.5:
        angle = rng.normal() * 0.3
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        with np.errstate(all="ignore"):
            target = source @ turn.T * rng.choice([1, 1, 1, 1000]) + 0.05 * np.sin(source)
        write_ply(folder / "target.ply", target, faces, rng)
    else:
        write_ply(folder / "target.ply", *random_points(rng), rng)
    out, warp, report = folder / "out.ply", folder / "warp.json", folder / "report.json"
    code = run([f"{options.bin}/ed_fit", folder / "source.ply", folder / "target.ply", f"--output={out}",
                f"--warp={warp}", f"--report={report}", "--quiet", *random_flags(rng, FIT_FLAGS)], options.timeout)
    if code not in (0, 4):
        left = [path.name for path in (out, warp, report) if path.exists()]
        if left and code != 3:
            raise Fault(f"exit code {code} left {left}")
        return f"ed_fit {code}"
    json.loads(report.read_text())
    result, given = read_vertices(out), read_vertices(folder / "source.ply")
    if len(result) != len(given):
        raise Fault(f"{len(given)} vertices became {len(result)}")
    finite = np.isfinite(given).all(axis=1)
    if not np.isfinite(result[finite]).all():
        raise Fault("the result is not finite")
    applied = folder / "applied.ply"
    code_apply = run([f"{options.bin}/ed_apply", warp, folder / "source.ply", f"--output={applied}"],
                     options.timeout)
    if code_apply != 0:
        raise Fault(f"ed_apply ends with {code_apply} on the fit's own warp and source")
    # Stray vertices, which the fit leaves where they are, are points like others to ed_apply.
    moved = finite & (result != given).any(axis=1)
    if not moved.any():
        return f"ed_fit {code}"
    size = np.ptp(result[moved], axis=0).max() + np.abs(result[moved]).max() * 1e-6
    apart = np.abs(read_vertices(applied)[moved] - result[moved]).max()
    if not apart <= 1e-6 * size:
        raise Fault(f"ed_apply is {apart:g} from the fit, whose size is {size:g}")
    run([f"{options.bin}/ed_eval", out, folder / "target.ply"], options.timeout)
    return f"ed_fit {code}"


def check_slam(options, rng, folder):
    """Tracks a random sequence."""
    sequence = folder / "sequence"
    sequence.mkdir()
    write_sequence(sequence, rng)
    out = folder / "out"
    code = run([f"{options.bin}/ed_slam", sequence, f"--output={out}", "--quiet", *random_flags(rng, SLAM_FLAGS)],
               options.timeout)
    if code in (0, 4):
        json.loads((out / "report.json").read_text())
        if not np.isfinite(read_vertices(out / "map.ply")).all():
            raise Fault("the map is not finite")
    return f"ed_slam {code}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", default=ROOT / "build/release/apps", metavar="DIR",
                        help="folder of the programs [build/release/apps]")
    parser.add_argument("--runs", type=int, default=500, help="number of runs [500]")
    parser.add_argument("--seed", type=int, default=0, help="seed of the first run; the next have the next ones [0]")
    parser.add_argument("--timeout", type=float, default=60.0, help="seconds that a program may take [60]")
    parser.add_argument("--keep", type=Path, default=ROOT / "build/fuzz_faults", metavar="DIR",
                        help="folder for what breaks a rule [build/fuzz_faults]")
    options = parser.parse_args()
    outcomes = collections.Counter()
    for seed in range(options.seed, options.seed + options.runs):
        rng = np.random.default_rng(seed)
        folder = Path(tempfile.mkdtemp(prefix="ceres_ed_fuzz_"))
        check = check_slam if rng.random() < 0.2 else check_fit
        try:
            outcomes[check(options, rng, folder)] += 1
            shutil.rmtree(folder)
        except Fault as fault:
            outcomes["fault"] += 1
            kept = options.keep / str(seed)
            shutil.rmtree(kept, ignore_errors=True)
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(folder, kept)
            print(f"seed {seed}: {fault} (kept in {shlex.quote(str(kept))})", flush=True)
        if sys.stderr.isatty():
            print(f"\r{seed - options.seed + 1} of {options.runs}", end="", file=sys.stderr)
    print(f"{sum(outcomes.values())} runs: " + ", ".join(f"{n} {name}" for name, n in sorted(outcomes.items())))
    return 1 if outcomes["fault"] else 0


if __name__ == "__main__":
    sys.exit(main())
