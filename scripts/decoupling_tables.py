"""Tables and the figure of bench_decoupling.py."""
import math
import statistics

from mesh_picture import BATCH_COLOR, TWO_LEVEL_COLOR
from bench_tables import cell, table
from sequence_runs import STAGES

import matplotlib.pyplot as plt

MARGINAL_COLOR, KEEP_COLOR, CUT_COLOR = "#2f8f4e", "#d98a00", "#7d5ba6"
COLORS = {"batch": BATCH_COLOR, "marginal": MARGINAL_COLOR, "default": TWO_LEVEL_COLOR,
          "paper's, keep": KEEP_COLOR, "paper's, cut": CUT_COLOR}
# Below this a gap, in percent, is drawn as none.
LEAST_GAP = 1e-3


def default_curve(records):
    """Returns nodes and milliseconds of the default scheme at each size that was reached."""
    reached = [record for record in records if record.get("times")]
    return [record["nodes"] for record in reached], [record["times"]["ms"] for record in reached]


def slope(nodes, ms):
    """Returns the slope of log time over log nodes by least squares, or None for a single size."""
    if len(nodes) < 2:
        return None
    x = [math.log(value) for value in nodes]
    y = [math.log(value) for value in ms]
    mean_x, mean_y = statistics.fmean(x), statistics.fmean(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) /
            sum((a - mean_x) ** 2 for a in x))


def beside_curve(records, scheme):
    """Returns nodes and milliseconds of another scheme at the sizes that it reached."""
    found = [one["times"] for record in records for one in record["beside"]
             if one["scheme"] == scheme and one["times"]]
    return [one["nodes"] for one in found], [one["ms"] for one in found]


def beside_names(records):
    names = [one["scheme"] for record in records for one in record["beside"]]
    return list(dict.fromkeys(names))


def beside_cell(record, scheme, notes):
    """Returns the time of a scheme beside the default; adds reasons for missing frames to `notes`."""
    one = next((one for one in record["beside"] if one["scheme"] == scheme), None)
    if one is None:
        return "not tried"
    if one["note"]:
        notes.append(f"{scheme} at {record['size']}: {one['note']}")
    mark = "*" if one["note"] else ""
    if one["times"] is None:
        return f"failed{mark}"
    text = f"{one['times']['ms']:.0f}"
    if one["default"]:
        text += f" ({one['times']['ms'] / one['default']['ms']:.2f})"
    return text + mark


def growth_lines(records):
    """Returns the Markdown of times against the size of the map."""
    names = beside_names(records)
    rows, notes = [], []
    for record in records:
        figures = record.get("times")
        if not figures:
            rows.append([f"{record['size']}", f"not reached: {record['nodes']:.0f} nodes"] +
                        ["-"] * (4 + len(STAGES) + len(names)))
            continue
        rows.append([f"{record['nodes']:.0f}", str(record["frame"]), cell(figures["pr"], 0),
                     cell(figures["active"], 0), cell(figures["updated_pi"], 0),
                     cell(figures["ms"], 0),
                     *(cell(figures[f"ms_{stage}"], 1) for stage in STAGES),
                     *(beside_cell(record, name, notes) for name in names)])
    lines = table(["nodes", "frame", "PR", "level I", "PI updated", "ms", *STAGES, *names], rows)
    if notes:
        lines += ["", "\\* " + "; ".join(notes) + "."]
    nodes, ms = default_curve(records)
    if len(nodes) > 1:
        lines += ["", f"From {nodes[0]:.0f} to {nodes[-1]:.0f} nodes a frame takes "
                  f"{ms[-1] / ms[0]:.2f} times as long; time goes as nodes^{slope(nodes, ms):.2f}."]
    return lines


def paired_lines(rounds):
    """Returns the Markdown of the ratio between the ends of a long run, measured in turn."""
    small, large = rounds[0]
    ratios = [after["ms"] / before["ms"] for before, after in rounds]
    ratio = statistics.median(ratios)
    slope_of = math.log(ratio) / math.log(large["nodes"] / small["nodes"])
    return [f"In turn, {len(rounds)} times {small['frames']} frames from a checkpoint at each end: at "
            f"{large['nodes']:.0f} nodes a frame takes {ratio:.2f} times as long as at "
            f"{small['nodes']:.0f} (" + ", ".join(f"{value:.2f}" for value in ratios) + "; "
            f"{statistics.median(one[1]['ms'] for one in rounds):.0f} against "
            f"{statistics.median(one[0]['ms'] for one in rounds):.0f} ms): time goes as "
            f"nodes^{slope_of:.3f}."]


def gap_text(row, key):
    value = row.get(key)
    return "-" if value is None else f"{value:.3g}"


def gap_lines(rows):
    """Returns the Markdown of what each scheme loses and saves, on each sequence."""
    lines = []
    for row in rows:
        camera = row.get("verify_camera_m")
        lines.append([row["sequence"], row["scheme"], cell(row.get("ms"), 0),
                      cell(row["share"], 2), gap_text(row, "gap"), gap_text(row, "gap_max"),
                      cell(None if camera is None else 1e3 * camera, 3),
                      cell(row.get("surface_seen"), 3), cell(row.get("tracking_seen"), 3),
                      cell(row.get("tracking_hidden"), 3), str(row["lost"]), row["note"] or ""])
    return table(["sequence", "scheme", "ms", "of batch", "gap %", "largest %", "camera mm",
                  "surface mm", "seen mm", "hidden mm", "lost", "note"], lines)


def draw_trade(axes, rows):
    """Draws lost accuracy against saved time on the first sequence, which has every scheme."""
    sequence = rows[0]["sequence"]
    for row in rows:
        name, gap, share = row["scheme"], row.get("gap"), row.get("share")
        if row["sequence"] != sequence or gap is None or share is None:
            continue
        # Circles keep the boundary, squares cut it; hollow ones solve all of Level II.
        marker = {"keep": "o", "cut": "s"}.get(row["boundary"], "D")
        color = COLORS.get(name, KEEP_COLOR if row["boundary"] == "keep" else CUT_COLOR)
        hollow = row["level2"] == "full"
        axes.plot([share], [max(gap, LEAST_GAP)], marker, markersize=7, color=color,
                  markerfacecolor="white" if hollow else color)
        label = name if row["rings"] is None else str(row["rings"])
        axes.annotate(label, (share, max(gap, LEAST_GAP)), xytext=(5, 3), fontsize=7,
                      textcoords="offset points")
    axes.set_yscale("log")
    axes.set(xlabel="time of a frame, of batch's", ylabel="energy above batch's, %",
             title=f"lost against saved, {sequence}")
    axes.set_xlim(left=0.0)
    handles = [plt.Line2D([], [], linestyle="", marker=marker, color="#555555", label=label,
                          markerfacecolor=face)
               for marker, face, label in (("o", "#555555", "keep, lazy (number: rings)"),
                                           ("o", "white", "keep, full"),
                                           ("s", "#555555", "cut, lazy"),
                                           ("s", "white", "cut, full"))]
    axes.legend(handles=handles, frameon=False, fontsize=7)


def draw_growth(axes, records):
    """Draws the time of a frame against the nodes of the map."""
    for name, (nodes, ms) in {"default": default_curve(records),
                              **{name: beside_curve(records, name)
                                 for name in beside_names(records)}}.items():
        if nodes:
            axes.plot(nodes, ms, "o-", color=COLORS.get(name, "#555555"), label=name,
                      markersize=4, linewidth=1.6)
    axes.set(xscale="log", yscale="log", xlabel="nodes of the map", ylabel="ms a frame",
             title="time against the map")
    if axes.get_legend_handles_labels()[1]:
        axes.legend(frameon=False, fontsize=8)


def draw(records, rows, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.0))
    if rows:
        draw_trade(left, rows)
    if records:
        draw_growth(right, records)
    for axes in (left, right):
        axes.grid(color="#e4e4e4", linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110, facecolor="white")
    plt.close(figure)
