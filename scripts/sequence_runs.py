"""Depth sequences and runs of ed_slam on them, for benchmarks and experiments."""
import csv
import hashlib
import json
import shlex
import shutil
import statistics
from pathlib import Path

from program_runs import ROOT, RunFailed, run, wrong_call

CACHE = ROOT / "build/sequences"
STAGES = ("observe", "features", "associate", "camera", "level1", "level2", "warp", "grow")
FOLLOWED = ("tracked", "relocalized")
# The first frame of the figure seen_late: what covers or breaks a hard sequence is over by then.
LATE_FROM = 60
# A sheet that rises under a still camera: with nothing else in view no one could tell which of
# the two has moved.
STILL_CAMERA = ["--camera=fixed"]
SCENES = {"heart": [], "kidney": [], "stomach": [], "strip": [], "plane": STILL_CAMERA}


class Sequence:
    """A folder that ed_slam reads, and the flags that it needs."""

    def __init__(self, name, folder, flags=()):
        self.name = name
        self.folder = Path(folder)
        self.flags = list(flags)
        if outlines_object(self.folder):
            self.flags.append("--masks=false")


def outlines_object(folder):
    """Whether the masks outline an object by which a result is judged, and ed_slam may not see them:
    those of a sequence whose authors outlined it."""
    return (Path(folder) / "mask_authors").is_dir()


def is_sequence(folder):
    """Whether there are at least three depth images; two are a pair."""
    if (folder / "depth.txt").exists():
        return True
    images = folder / "depth"
    return (folder / "camera.txt").exists() and images.is_dir() and len(list(images.iterdir())) > 2


def find_sequences(folders):
    for folder in folders:
        if not folder.is_dir():
            wrong_call(f"{folder} is no folder")
    return [Sequence(child.name, child) for folder in folders for child in sorted(folder.iterdir())
            if child.is_dir() and is_sequence(child)]


def simulate(ed_simulate, scene, flags, cache, fresh=False):
    """Returns a simulated sequence, or the one in `cache` if it was made with the same flags.

    With `fresh` it is always made again, because ed_simulate may have changed.
    """
    words = [scene, *flags]
    name = "_".join([scene, *(flag.lstrip("-").replace("=", "") for flag in flags)])
    folder, stamp = cache / name, cache / f"{name}.txt"
    # Written last: where it is, the sequence is whole.
    if fresh or not stamp.exists() or stamp.read_text() != shlex.join(words):
        stamp.unlink(missing_ok=True)
        if folder.exists():
            shutil.rmtree(folder)
        cache.mkdir(parents=True, exist_ok=True)
        run([ed_simulate, *words, f"--output={folder}", "--quiet"], cache / f"{name}.log")
        stamp.write_text(shlex.join(words))
    return Sequence(scene, folder, SCENES[scene])


def read_frames(output):
    """Returns the rows of frames.csv: status is text, everything else a number, NaN where it is empty."""
    with open(output / "frames.csv", newline="") as file:
        return [{key: value if key == "status" else float(value or "nan")
                 for key, value in row.items()}
                for row in csv.DictReader(file)]


def digest(output):
    """Returns a hash of everything that a second run must repeat, that is, all except times."""
    sha = hashlib.sha256()
    for row in read_frames(output):
        sha.update(repr([row[key] for key in sorted(row) if not key.startswith("t_")]).encode())
    names = ["trajectory.txt", "map.ply", "graph.ply"]
    for path in [output / name for name in names] + sorted((output / "live").glob("*.ply")):
        sha.update(path.read_bytes())
    return sha.hexdigest()


def track(variant, sequence, output, flags=()):
    """Runs ed_slam into `output`, made new; returns wall and CPU seconds and peak megabytes."""
    if output.exists():
        shutil.rmtree(output)
    log = output.with_suffix(".log")
    return run([variant.program, sequence.folder, f"--output={output}", "--quiet",
                "--progress=none", *sequence.flags, *variant.flags, *flags], log)


def evaluate(ed_eval, sequence, output):
    """Returns the report of ed_eval on a run."""
    report = output.with_suffix(".eval.json")
    run([ed_eval, f"--sequence={sequence.folder}", f"--result={output}", f"--report={report}"],
        output.with_suffix(".eval.log"))
    return json.loads(report.read_text())


def percentile(values, share):
    """Returns the value that `share` of all values do not exceed (nearest rank)."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, max(0, -int(-share * len(ordered) // 1) - 1))]


def followed(frames):
    """Returns the tracked frames, whose times and residuals count."""
    return [row for row in frames if row["status"] in FOLLOWED]


def times_of(frames):
    """Returns the times of a frame: median and p95 of all, medians of the stages, milliseconds."""
    rows = followed(frames)
    if not rows:
        return {}
    total = [1e3 * row["t_total"] for row in rows]
    figures = {"ms": statistics.median(total), "ms_p95": percentile(total, 0.95)}
    # Whether a frame takes longer when the recording gets long.
    part = max(1, len(total) // 4)
    figures["late_ratio"] = statistics.median(total[-part:]) / statistics.median(total[part:2 * part])
    for stage in STAGES:
        figures[f"ms_{stage}"] = statistics.median(1e3 * row[f"t_{stage}"] for row in rows)
    return figures


def counts_of(frames):
    figures = {"frames": len(frames)}
    for status in ("initialized", "tracked", "relocalized", "lost", "skipped"):
        figures[status] = sum(row["status"] == status for row in frames)
    rows = followed(frames)
    if rows:
        figures.update(nodes=int(frames[-1]["nodes"]), points=int(frames[-1]["map_points"]),
                       pr=statistics.median(row["pr"] for row in rows),
                       active=statistics.median(row["active"] for row in rows),
                       rms_plane=1e3 * statistics.median(row["rms_plane"] for row in rows))
    return figures


def errors_of(evaluation):
    """Returns the errors by ed_eval in millimetres and pixels, without those that it could not measure."""
    figures = {}
    if evaluation["truth"]:
        summary = evaluation["truth"]["summary"]
        for name, figure, across in (("surface_seen", "surface_seen_median", "median"),
                                     ("tracking_seen", "tracking_seen_mean", "mean"),
                                     ("tracking_hidden", "tracking_hidden_mean", "mean")):
            if summary[figure]:
                figures[name] = 1e3 * summary[figure][across]
        if summary["tracking_seen_mean"]:
            figures["seen_worst"] = 1e3 * summary["tracking_seen_mean"]["max"]
        late = [frame["tracking_seen"]["mean"] for frame in evaluation["truth"]["frames"]
                if frame["frame"] >= LATE_FROM and frame["tracking_seen"]]
        if late:
            figures["seen_late"] = 1e3 * statistics.mean(late)
        figures["map_p99"] = 1e3 * evaluation["truth"]["frames"][-1]["surface_all"]["p99"]
    if evaluation["camera"]:
        camera = evaluation["camera"]["from_first_frame"]
        figures["camera"] = 1e3 * camera["translation_rmse"]
    if evaluation["depth"]:
        figures["depth"] = 1e3 * evaluation["depth"]["summary"]["residual_median"]["mean"]
        figures["far"] = 100.0 * evaluation["depth"]["summary"]["far_share"]["mean"]
    tracks = evaluation["tracks_2d"]
    if tracks and tracks["error"]:
        figures.update(track_px=tracks["error"]["p50"],
                       tracks=f"{tracks['followed']}/{tracks['tracks']}")
        if tracks["moved_error"]:
            figures["moved_px"] = tracks["moved_error"]["p50"]
    return figures


def static_residual(variant, sequence, work):
    """Returns the rms distance to planes, mm, that a pair of frames leaves where nothing moves.

    It is the residual of noise and calibration alone. ed_slam makes the map from frame k alone and places
    it on frame k + 1, with its own planes, inliers and rms. E_rot and E_reg are so strong that only the
    camera can move, and there are no features, so only the distance to the planes counts. Tissue that
    moves between the two frames adds to the residual; therefore the result is the median over the
    quietest quarter of all neighbouring frames. A map of many frames averages its noise, which a pair
    cannot do, so its residual on still tissue is smaller.
    """
    rigid = ["--w_rot=1e6", "--w_reg=1e6", "--features=none", "--live_every=0"]
    frames = sorted(int(path.stem) for path in (sequence.folder / "depth").iterdir())
    residuals = []
    for first, second in zip(frames, frames[1:]):
        output = work / "static"
        try:
            track(variant, sequence, output,
                  rigid + [f"--first={first}", f"--last={second}"])
        except RunFailed:  # a frame without depth
            continue
        residuals += [1e3 * row["rms_plane"] for row in followed(read_frames(output))]
    quiet = sorted(residuals)[:max(1, len(residuals) // 4)]
    return statistics.median(quiet) if quiet else None
