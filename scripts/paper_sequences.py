"""Experiments of the paper on growing maps: time and nodes a frame, and accuracy."""
import statistics
from concurrent.futures import ThreadPoolExecutor

from mesh_picture import BATCH_COLOR, TWO_LEVEL_COLOR
from bench_tables import cell, table
from program_runs import Variant
from sequence_runs import evaluate, followed, read_frames, simulate, track

import matplotlib.pyplot as plt

MODES = (("batch", "batch", BATCH_COLOR), ("two_level", "two-level", TWO_LEVEL_COLOR))
# Frames at the end over which a time is a median.
LAST = 20

# Field, what it is.
ACCURACY = (("plane", "map to scan, planes"), ("scan", "map to scan, pixels"),
            ("surface", "map to true surface"), ("seen", "tracking, seen"),
            ("hidden", "tracking, hidden"))


def mean(values):
    values = [value for value in values if value is not None]
    return statistics.fmean(values) if values else None


def errors(evaluation, frames):
    """Returns {field of ACCURACY: mm}: means of a frame, mean of the frames."""
    def across(part, figure):
        rows = evaluation[part]["frames"] if evaluation[part] else []
        found = mean(row[figure]["mean"] for row in rows if row[figure])
        return None if found is None else 1e3 * found
    return {"plane": mean(1e3 * row["rms_plane"] for row in frames),
            "scan": across("depth", "residual"), "surface": across("truth", "surface_seen"),
            "seen": across("truth", "tracking_seen"),
            "hidden": across("truth", "tracking_hidden")}


def run_scene(sequence, options, work):
    """Returns {mode: {"frames": rows of frames.csv, "errors", "lost"}} of one sequence."""
    result = {}
    for mode, _, _ in MODES:
        output = work / f"{sequence.name}_{mode}"
        variant = Variant(mode, options.bin / "ed_slam",
                          [f"--mode={mode}", f"--live_every={options.live_every}",
                           "--checkpoint_every=0", *options.slam_flags])
        track(variant, sequence, output)
        rows = read_frames(output)
        frames = followed(rows)
        evaluation = evaluate(options.bin / "ed_eval", sequence, output)
        result[mode] = {"frames": [{key: row[key] for key in
                                    ("frame", "t_total", "t_level1", "t_level2", "nodes", "pr",
                                     "active", "updated_pi", "rms_plane")} for row in frames],
                        "errors": errors(evaluation, frames),
                        "total": len(rows), "lost": sum(row["status"] == "lost" for row in rows)}
    return result


def simulate_all(options):
    """Makes the sequences, two at a time: nothing is being measured yet."""
    def make(scene):
        return simulate(options.bin / "ed_simulate", scene, options.simulate_flags, options.cache,
                        options.fresh)
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(make, options.scenes))


def smooth(values, width=9):
    """Returns running medians."""
    half = width // 2
    return [statistics.median(values[max(0, i - half):i + half + 1]) for i in range(len(values))]


def plot_growth(results, path):
    """Time (above) and nodes that Level I moves (below) against the frame, a column a sequence."""
    figure, grid = plt.subplots(2, len(results), figsize=(3.4 * len(results), 4.6), sharex="col",
                                squeeze=False)
    for column, (scene, result) in enumerate(results.items()):
        times, nodes = grid[0][column], grid[1][column]
        for mode, label, color in MODES:
            frames = result[mode]["frames"]
            numbers = [row["frame"] for row in frames]
            total = [1e3 * row["t_total"] for row in frames]
            times.plot(numbers, total, color=color, linewidth=0.5, alpha=0.3)
            times.plot(numbers, smooth(total), color=color, linewidth=1.6, label=label)
            nodes.plot(numbers, [row["active"] for row in frames], color=color, linewidth=1.6,
                       label=f"{label}, level I" if mode == "two_level" else "batch: all")
            if mode == "two_level":
                nodes.plot(numbers, [row["pr"] for row in frames], color=color, linewidth=1.0,
                           linestyle=":", label="PR")
        highest = max(max(smooth([1e3 * row["t_total"] for row in result[mode]["frames"]]))
                      for mode, _, _ in MODES)
        times.set(title=scene, ylim=(0.0, 1.15 * highest))
        nodes.set(xlabel="frame")
        nodes.set_ylim(bottom=0.0)
        for axes in (times, nodes):
            axes.grid(color="#e4e4e4", linewidth=0.6)
            axes.spines[["top", "right"]].set_visible(False)
            axes.tick_params(labelsize=8)
    grid[0][0].set_ylabel("ms a frame")
    grid[1][0].set_ylabel("nodes that are solved for")
    grid[0][0].legend(frameon=False, fontsize=8, loc="upper left")
    grid[1][0].legend(frameon=False, fontsize=8, loc="upper left")
    figure.tight_layout()
    figure.savefig(path, dpi=100, facecolor="white")
    plt.close(figure)


def at_the_end(result, mode, key):
    return statistics.median(row[key] for row in result[mode]["frames"][-LAST:])


def growth_table(results):
    """Times at the end of each sequence."""
    rows = []
    for scene, result in results.items():
        end = {(mode, key): at_the_end(result, mode, key) for mode, _, _ in MODES
               for key in ("t_total", "t_level1", "t_level2", "active", "pr", "nodes")}
        total = end["two_level", "t_total"] / end["batch", "t_total"]
        levels = end["two_level", "t_level1"] + end["two_level", "t_level2"]
        lost = [str(result[mode]["lost"]) for mode, _, _ in MODES]
        rows.append([scene, str(result["batch"]["total"]), " / ".join(lost),
                     f"{end['two_level', 'nodes']:.0f}", f"{end['two_level', 'pr']:.0f}",
                     f"{end['two_level', 'active']:.0f}", f"{1e3 * end['batch', 't_total']:.0f}",
                     f"{1e3 * end['two_level', 't_total']:.0f}", f"{total:.2f}",
                     f"{1e3 * end['batch', 't_level1']:.0f}",
                     f"{1e3 * end['two_level', 't_level1']:.0f} + "
                     f"{1e3 * end['two_level', 't_level2']:.0f}",
                     f"{levels / end['batch', 't_level1']:.2f}"])
    return table(["sequence", "frames", "lost", "nodes", "PR", "level I", "batch ms", "two-level ms",
                  "ratio", "batch solve ms", "levels I + II ms", "ratio"], rows)


def loss(result, field):
    """Returns the percent that two-level loses against batch; None without both."""
    batch, two_level = (result[mode]["errors"][field] for mode, _, _ in MODES)
    return 100.0 * (two_level / batch - 1.0) if batch and two_level is not None else None


def accuracy_table(results):
    rows = []
    for field, name in ACCURACY:
        row, losses = [name], []
        for result in results.values():
            lost = loss(result, field)
            losses.append(lost)
            row += [cell(result[mode]["errors"][field], 3) for mode, _, _ in MODES]
            row.append("-" if lost is None else f"{lost:+.1f}")
        average = mean(losses)
        rows.append(row + ["-" if average is None else f"{average:+.1f}"])
    headings = ["mean error, mm"]
    for scene in results:
        headings += [f"{scene}: batch", "two-level", "loss %"]
    return table(headings + ["mean loss %"], rows)


def run_growing(options, work, output):
    """Runs (a) and (b); returns results for the JSON file and the Markdown of both tables."""
    results = {}
    for sequence in simulate_all(options):
        options.say(f"{sequence.name}: batch and two-level")
        results[sequence.name] = run_scene(sequence, options, work)
    plot_growth(results, output / "paper_time.png")
    return results, growth_table(results), accuracy_table(results)
