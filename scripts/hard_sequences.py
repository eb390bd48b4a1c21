"""Sequences that break trackers, made from those of ed_simulate: long orbits, depth that is exact or
noisy, cover, holes, gaps, jumps, large steps, and scenes that do not deform.

A sequence that is derived from another one links its files; what is covered has a mask.
"""
import random
import shutil
import struct
import zlib

from sequence_runs import Sequence, simulate

SIZE = ["--width=320", "--height=240"]
ORGANS = ("heart", "kidney", "stomach")
# Two orbits. Live clouds show all of the map, which costs time: one in eight frames has one.
ORBIT = ["--frames=640", *SIZE]
LONG = ["--frames=2000", *SIZE]
SHORT = ["--frames=120", *SIZE]
SPARSE = ["--live_every=8"]
# Tissue that moves there and back in more frames than there are stands still.
STILL = ["--period=1e9"]
COVERED = range(30, 60)
BLANK = range(40, 50)
JUMP = range(40, 58)
STEPS = (3, 5)
# With what a hard sequence is compared, and in which figure (a key of COLUMNS): scenes at rest with
# a tracker that knows that they are, large steps with every frame, cover with none.
REFERENCES = {
    **{f"still_{scene}": (f"still_{scene}_rigid", "camera") for scene in ORGANS},
    **{f"step{step}_{scene}": (f"step1_{scene}", "tracking_seen")
       for scene in ORGANS for step in STEPS},
    **{name: ("plain_heart", "seen_late")
       for name in ("cover45_heart", "cover60_heart", "blank_heart", "holes_heart")},
}


def write_mask(path, rows):
    """Writes a grey PNG of 8 bits; rows are bytes, one of them for each pixel."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    pixels = b"".join(b"\0" + row for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))


def columns_covered(share, width, height):
    """Returns the rows of a mask that leaves out the left part of the picture."""
    row = bytes(width * [255])
    covered = int(share * width)
    return height * [bytes(covered) + row[covered:]]


def discs_covered(share, width, height, seed):
    """Returns the rows of a mask that leaves out discs at random places."""
    generator = random.Random(seed)
    rows = [bytearray(width * [255]) for _ in range(height)]
    left = (1.0 - share) * width * height
    while sum(width - row.count(0) for row in rows) > left:
        radius = generator.uniform(8.0, 30.0)
        x, y = generator.uniform(0, width), generator.uniform(0, height)
        for v in range(max(0, int(y - radius)), min(height, int(y + radius) + 1)):
            half = max(0.0, radius ** 2 - (v - y) ** 2) ** 0.5
            first, last = max(0, int(x - half)), min(width, int(x + half) + 1)
            if first < last:
                rows[v][first:last] = bytes(last - first)
    return [bytes(row) for row in rows]


def derive(base, name, frames, mask_of=None):
    """Returns the sequence of some frames of `base`, numbered from 0.

    mask_of(frame, width, height) returns the rows of a mask, or None for a frame without one.
    """
    folder = base.folder.parent / name
    if folder.exists():
        shutil.rmtree(folder)
    for part in ("depth", "color", "mask"):
        (folder / part).mkdir(parents=True)
    for file in ("camera.txt", "gt_mesh_000000.ply"):
        (folder / file).symlink_to((base.folder / file).resolve())
    words = next(line for line in (base.folder / "camera.txt").read_text().splitlines()
                 if not line.startswith("#")).split()
    width, height = int(words[4]), int(words[5])
    poses = {int(line.split()[0]): line.split()[1:]
             for line in (base.folder / "poses.txt").read_text().splitlines()
             if line and not line.startswith("#")}
    truth = base.folder / "gt_vertices.f32"
    size = truth.stat().st_size // len(poses)
    with open(truth, "rb") as vertices, open(folder / "gt_vertices.f32", "wb") as kept:
        lines = []
        for number, frame in enumerate(frames):
            for part in ("depth", "color"):
                source = base.folder / part / f"{frame:06d}.png"
                (folder / part / f"{number:06d}.png").symlink_to(source.resolve())
            rows = mask_of(frame, width, height) if mask_of else None
            if rows:
                write_mask(folder / "mask" / f"{number:06d}.png", rows)
            vertices.seek(size * frame)
            kept.write(vertices.read(size))
            lines.append(" ".join([str(number), *poses[frame]]))
    (folder / "poses.txt").write_text("\n".join(lines) + "\n")
    return Sequence(name, folder, base.flags)


def hard_sequences(ed_simulate, cache, fresh=False):
    """Returns {name: function that makes the sequence}."""
    def organ(scene, flags, name, run_flags=()):
        made = simulate(ed_simulate, scene, flags, cache, fresh)
        return Sequence(name, made.folder, [*made.flags, *run_flags])

    def covered(scene, name, mask_of, frames=range(100)):
        return derive(organ(scene, SHORT, name), name, frames, mask_of)

    def while_in(frames, rows_of):
        return lambda frame, width, height: rows_of(width, height, frame) if frame in frames else None

    makers = {}
    for scene in ORGANS:
        for kind, flags in (("", []), ("_exact", ["--noise=0"]), ("_noisy", ["--noise=0.00075"])):
            makers[f"orbit_{scene}{kind}"] = (
                lambda scene=scene, flags=flags, name=f"orbit_{scene}{kind}":
                organ(scene, [*ORBIT, *flags], name, SPARSE))
        makers[f"plain_{scene}"] = lambda scene=scene: organ(scene, SHORT, f"plain_{scene}",
                                                             ["--last=99"])
        makers[f"still_{scene}"] = lambda scene=scene: organ(scene, [*SHORT, *STILL],
                                                             f"still_{scene}")
        makers[f"still_{scene}_rigid"] = lambda scene=scene: organ(
            scene, [*SHORT, *STILL], f"still_{scene}_rigid", ["--rigid"])
        for step in (1, *STEPS):
            makers[f"step{step}_{scene}"] = lambda scene=scene, step=step: organ(
                scene, ORBIT, f"step{step}_{scene}", [f"--step={step}", "--last=209"])
        makers[f"jump_{scene}"] = lambda scene=scene: covered(
            scene, f"jump_{scene}", None, [k for k in range(120) if k not in JUMP])
    makers["long_heart"] = lambda: organ("heart", LONG, "long_heart", SPARSE)
    for share in (45, 60):
        makers[f"cover{share}_heart"] = lambda share=share: covered(
            "heart", f"cover{share}_heart",
            while_in(COVERED, lambda w, h, _: columns_covered(share / 100.0, w, h)))
    makers["holes_heart"] = lambda: covered(
        "heart", "holes_heart",
        while_in(range(10, 100), lambda w, h, frame: discs_covered(0.5, w, h, frame)))
    makers["blank_heart"] = lambda: covered(
        "heart", "blank_heart", while_in(BLANK, lambda w, h, _: h * [bytes(w)]))
    return makers
