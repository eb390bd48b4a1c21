"""Runs of ed_slam with different ways to decouple, from the first frame or from a checkpoint of another run."""
import math
import re
import shutil
import statistics

from program_runs import RunFailed, Variant, run
from sequence_runs import STAGES, followed, read_frames, simulate

# Frames up to a size over which a time is a median.
WINDOW = 50
# What ed_simulate takes as the nodes of a view; NODES_IN_VIEW gives that many PR nodes.
NODES_OF_VIEW = 300
NODES_IN_VIEW = 430
# A strip is so much longer than the map asks for.
SPARE = 1.05
STOPPED_EARLY = 4


def make_strip(options, nodes, flags):
    """Returns a strip long enough for a map of `nodes` nodes, and the number of its frames."""
    per_view = NODES_OF_VIEW * options.nodes_in_view / NODES_IN_VIEW
    views = max(1.0 + options.speed, SPARE * nodes / per_view)
    frames = math.ceil((views - 1.0) / options.speed) + 1
    hint = max(NODES_OF_VIEW, math.ceil(views * NODES_OF_VIEW))
    return simulate(options.bin / "ed_simulate", "strip",
                    [f"--nodes_hint={hint}", f"--frames={frames}", *options.simulate_flags, *flags],
                    options.work / "sequences", options.fresh), frames


class Scheme:
    """A way to solve: its name in tables, its flags of ed_slam, and its place in the figure."""

    def __init__(self, name, mode, rings=None, boundary=None, level2=None):
        self.name = name
        self.mode = mode
        self.rings = rings
        self.boundary = boundary
        self.level2 = level2

    def flags(self):
        said = {"mode": self.mode, "rings": self.rings, "boundary": self.boundary,
                "level2": self.level2}
        return [f"--{key}={value}" for key, value in said.items() if value is not None]

    def place(self):
        return {"mode": self.mode, "rings": self.rings, "boundary": self.boundary,
                "level2": self.level2}


BATCH = Scheme("batch", "batch")
MARGINAL = Scheme("marginal", "marginal")
PAPER_KEEP = Scheme("paper's, keep", "two_level", 0, "keep", "full")
PAPER_CUT = Scheme("paper's, cut", "two_level", 0, "cut", "full")
# With no flags: whatever ed_slam does by itself.
DEFAULT = Scheme("default", None)


def ring_schemes(rings, boundary, level2):
    """Returns two-level schemes with these numbers of rings."""
    return [Scheme(f"{count} rings, {boundary}, {level2}", "two_level", count, boundary, level2)
            for count in rings]


def common_flags(options):
    return ["--quiet", "--progress=none", "--threads=1", f"--nodes_in_view={options.nodes_in_view}",
            *options.slam_flags]


def reason(error):
    """Returns the message of a failed run in one line."""
    line = str(error).strip().splitlines()[-1].strip()
    return re.sub(r"^exit code -?[0-9]+: (ed_slam: )?", "", line).replace("|", "/")


def slam(options, scheme, sequence, output, flags, budget_s=None):
    """Runs ed_slam; returns the rows of frames.csv, and None or the reason why there are no more rows.

    After `budget_s` it stops at the end of the current frame. It is killed if that frame takes far longer.
    """
    variant = Variant(scheme.name, options.bin / "ed_slam", scheme.flags())
    limit = [f"--time_limit_s={budget_s}"] if budget_s else []
    command = [variant.program, sequence.folder, f"--output={output}", *common_flags(options),
               *sequence.flags, *variant.flags, *flags, *limit]
    note = None
    try:
        run(command, output.with_suffix(".log"), accepted=(0, STOPPED_EARLY),
            kill_after_s=2.0 * budget_s + 30.0 if budget_s else None)
    except RunFailed as error:
        killed = "exit code -9" in str(error)
        note = f"killed after {2.0 * budget_s + 30.0:.0f} s" if killed else reason(error)
    rows = read_frames(output) if (output / "frames.csv").exists() else []
    return rows, note


def is_verified(row):
    """Whether a frame was compared with batch; the frames after it may then be slower than usual."""
    value = row.get("verify_gap")
    return value is not None and value == value


def times(rows):
    """Returns medians in milliseconds of the whole frame and of its stages, or None without frames."""
    rows = [row for row in followed(rows) if not is_verified(row)]
    if not rows:
        return None
    figures = {"ms": 1e3 * statistics.median(row["t_total"] for row in rows), "frames": len(rows)}
    for stage in STAGES:
        figures[f"ms_{stage}"] = 1e3 * statistics.median(row[f"t_{stage}"] for row in rows)
    for count in ("nodes", "pr", "active", "updated_pi"):
        figures[count] = statistics.median(row[count] for row in rows)
    return figures


class LongRun:
    """A run of the default scheme along a long strip, in parts that end at checkpoints.

    ed_slam writes a checkpoint after every `options.checkpoint_every` frames, so that a leg of a
    multiple of these ends with one.
    """

    def __init__(self, options, sequence, total_frames):
        self.options = options
        self.sequence = sequence
        self.total = total_frames
        self.output = options.work / "strip_default"
        self.rows = []
        shutil.rmtree(self.output, ignore_errors=True)

    def advance(self, legs):
        """Continues by so many checkpoints; returns False if there are no more frames."""
        if len(self.rows) >= self.total:
            return False
        every = self.options.checkpoint_every
        end = min(len(self.rows) + legs * every, self.total)
        flags = [f"--last={end - 1}", f"--checkpoint_every={every}", "--live_every=0"]
        resume = ["--resume"] if self.rows else []
        rows, note = slam(self.options, DEFAULT, self.sequence, self.output, flags + resume)
        if note:
            raise RunFailed(f"strip, default, frames {len(self.rows)} to {end - 1}: {note}")
        self.rows = rows
        return True

    def nodes(self):
        return int(self.rows[-1]["nodes"]) if self.rows else 0

    def frames_until(self, size):
        """Returns how many more frames the map needs at its recent growth; 0 before it has grown."""
        if len(self.rows) < 10:
            return 0
        lately = self.rows[-min(200, len(self.rows)):]
        rate = (lately[-1]["nodes"] - lately[0]["nodes"]) / (len(lately) - 1)
        return max(0.0, (size - self.nodes()) / max(rate, 0.1))

    def approach(self, size):
        """Continues to the last checkpoint before the map has `size` nodes; returns its frames."""
        if not self.rows:
            self.advance(1)
        # A little less than what is foreseen; what is left is foreseen anew.
        while True:
            legs = int(0.95 * self.frames_until(size) / self.options.checkpoint_every)
            if legs < 1 or not self.advance(legs):
                return len(self.rows) if self.nodes() < size else 0

    def reach(self, size):
        """Continues until the map has `size` nodes; returns the frame's index, or None at the end."""
        while self.nodes() < size:
            if not self.advance(1):
                return None
        return next(i for i, row in enumerate(self.rows) if row["nodes"] >= size)


def beside(options, scheme, long_run, begin, index, checkpoint):
    """Runs a scheme on the frames after a checkpoint of the default run; returns its figures.

    `checkpoint` is a copy of that run's folder after `begin` frames; with none, of a small map, the
    scheme starts with the first frame and goes on to frame `index`.
    """
    output = options.work / "strip_beside"
    shutil.rmtree(output, ignore_errors=True)
    end = begin + options.beside if begin else index + 1
    flags = [f"--last={end - 1}", "--live_every=0",
             f"--checkpoint_every={options.checkpoint_every}"]
    if begin:
        shutil.copytree(checkpoint, output)
        flags.append("--resume")
    rows, note = slam(options, scheme, long_run.sequence, output, flags, options.budget_s)
    # The first of them also sets up what later ones share.
    first = max(begin + 1, end - options.beside)
    mine = rows[first:]
    if note is None and len(rows) < end:
        note = f"{max(0, len(rows) - begin)} of {end - begin} frames within {options.budget_s:.0f} s"
    return {"scheme": scheme.name, "begin": begin, "note": note, "times": times(mine),
            "default": times(long_run.rows[first:first + max(1, len(mine))])}


def growth(options, sequence, total_frames, schemes):
    """Returns a record for each size: times of the default scheme up to it, and of the other schemes at it."""
    long_run = LongRun(options, sequence, total_frames)
    records = []
    for size in options.sizes:
        begin = long_run.approach(size)
        checkpoint = options.work / f"checkpoint_{size}"
        shutil.rmtree(checkpoint, ignore_errors=True)
        if begin:
            shutil.copytree(long_run.output, checkpoint)
        # As far as the others will go, too.
        while len(long_run.rows) < begin + options.beside and long_run.advance(1):
            pass
        index = long_run.reach(size)
        record = {"size": size, "reached": index is not None, "nodes": long_run.nodes()}
        if index is not None:
            rows = long_run.rows[max(1, index + 1 - WINDOW):index + 1]
            record.update(frame=index, times=times(rows), nodes=rows[-1]["nodes"],
                          map_points=rows[-1]["map_points"])
        options.say(f"strip: {record['nodes']:.0f} nodes after {len(long_run.rows)} frames")
        record["beside"] = []
        for scheme in schemes:
            if record["reached"] and scheme.name not in options.given_up:
                figures = beside(options, scheme, long_run, begin, index, checkpoint)
                record["beside"].append(figures)
                if figures["times"] is None:
                    # What is too much at one size is so at the next.
                    options.given_up[scheme.name] = figures["note"]
                options.say(f"strip: {scheme.name} at {size} nodes: {figures['note'] or 'done'}")
        shutil.rmtree(checkpoint, ignore_errors=True)
        records.append(record)
    return records


def paired(options, sequence, repeats=3):
    """Returns times of the default scheme at both ends of a long run, measured in turn.

    A machine that others use may be half as fast a quarter of an hour later, which is what lies
    between the ends of the run itself. Here WINDOW frames go on from a checkpoint of a small map and
    from the last one of the long run, one after the other, `repeats` times.
    """
    large = options.work / "strip_default"
    small = options.work / "strip_small"
    shutil.rmtree(small, ignore_errors=True)
    flags = ["--live_every=0", f"--checkpoint_every={options.checkpoint_every}"]
    _, note = slam(options, DEFAULT, sequence, small,
                   flags + [f"--last={options.checkpoint_every - 1}"])
    if note:
        raise RunFailed(f"strip, default, from the start: {note}")
    rounds = []
    for _ in range(repeats):
        ends = []
        for folder in (small, large):
            begin = len(read_frames(folder))
            output = options.work / "strip_beside"
            shutil.rmtree(output, ignore_errors=True)
            shutil.copytree(folder, output)
            rows, note = slam(options, DEFAULT, sequence, output,
                              ["--resume", "--live_every=0", f"--last={begin + WINDOW}",
                               "--checkpoint_every=0"])
            if note or len(rows) < begin + 10:
                raise RunFailed(f"strip, default, from frame {begin}: {note or 'too few frames'}")
            # The first of them also sets up what later ones share.
            ends.append(times(rows[begin + 1:]))
        rounds.append(ends)
    return rounds
