"""Experiments of the paper on a plane under a still camera and on a dolphin bent by handles."""
import json

from mesh_picture import (BLUE, GRAY, PI_COLOR, PR_COLOR, SUPERSAMPLING, View, draw_graph, render,
                          smaller)
import ply
from bench_tables import cell, table
from program_runs import ROOT, Variant, run
from sequence_runs import followed, read_frames, simulate, track

import matplotlib
import matplotlib.colors
import matplotlib.pyplot as plt
import matplotlib.tri
import numpy as np

# Name, what the picture says, flags; the first is what the others are held against.
VARIANTS = (("batch", "batch", ["--mode=batch"]),
            ("keep 2", "two-level, keep, 2 rings",
             ["--mode=two_level", "--boundary=keep", "--rings=2"]),
            ("keep 0", "two-level, keep, 0 rings",
             ["--mode=two_level", "--boundary=keep", "--rings=0"]),
            ("cut 2", "two-level, cut, 2 rings",
             ["--mode=two_level", "--boundary=cut", "--rings=2"]),
            ("cut 0", "two-level, cut, 0 rings",
             ["--mode=two_level", "--boundary=cut", "--rings=0"]))
HEAT = matplotlib.colors.LinearSegmentedColormap.from_list(
    "difference", ["#e8e9eb", "#fdc25a", "#f4783b", "#cf2431", "#6a0f2b"])
# In a camera frame y is down and z away from the camera; in the pictures z is up.
UP = np.array([1.0, -1.0, -1.0])


def node_legend(figure, at):
    handles = [plt.Line2D([], [], marker="o", linestyle="", color=color, markersize=5, label=label)
               for color, label in ((PR_COLOR, "PR: an observation reaches it"),
                                    (PI_COLOR, "PI: follows the energies"))]
    figure.legend(handles=handles, loc="lower right", bbox_to_anchor=at, fontsize=8.5,
                  frameon=False, ncol=2, handletextpad=0.2)


def show(axes, image, panel, caption):
    axes.imshow(smaller(image), interpolation="nearest", zorder=1, aspect="equal",
                extent=(0, panel[0], panel[1], 0))
    axes.set(xlim=(0, panel[0]), ylim=(panel[1], 0))
    axes.set_axis_off()
    axes.text(4, panel[1] - 2, caption, fontsize=8.5, color="#404040", va="bottom")


def panels(count, columns, panel):
    """Returns a figure with this many panels and space for a legend below."""
    rows = -(-count // columns)
    dpi, margin = 100, 26
    height = rows * panel[1] + margin
    figure = plt.figure(figsize=(columns * panel[0] / dpi, height / dpi), dpi=dpi)
    grid = figure.add_gridspec(rows, columns, left=0.0, right=1.0, top=1.0, bottom=margin / height,
                               wspace=0.0, hspace=0.0)
    return figure, [figure.add_subplot(grid[k // columns, k % columns]) for k in range(count)]


def upright(graph):
    """Returns a graph of read_ply() with the nodes as the pictures show them."""
    vertex = graph["vertex"].copy()
    for axis, sign in zip("xyz", UP):
        vertex[axis] *= sign
    return {**graph, "vertex": vertex}


def true_plane(sequence, frame):
    """Returns the true vertices in the camera frame of a frame, and the triangles."""
    mesh = ply.read_ply(sequence.folder / "gt_mesh_000000.ply")
    count = len(mesh["vertex"])
    truth = np.fromfile(sequence.folder / "gt_vertices.f32", "<f4").reshape(-1, count, 3)
    poses = np.loadtxt(sequence.folder / "poses.txt", ndmin=2)
    pose = poses[poses[:, 0] == frame][0]
    x, y, z, w = pose[4:8]
    world_from_camera = np.array(
        [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return (truth[frame] - pose[1:4]) @ world_from_camera, ply.triangles(mesh)


def plane_errors(sequence, vertex, last):
    """Returns mean tracking errors in mm of the points that the mask shows and of those that it hides.

    The sheet is a graph over x and y at rest: the truth of a point is interpolated there. What
    ed_eval calls seen is everything inside the picture, masked or not.
    """
    rest, triangles = true_plane(sequence, 0)
    now, _ = true_plane(sequence, last)
    born = vertex[vertex["birth_frame"] == 0]
    mesh = matplotlib.tri.Triangulation(rest[:, 0], rest[:, 1], triangles)
    true = np.stack([matplotlib.tri.LinearTriInterpolator(mesh, now[:, axis])(
        born["bx"].astype(float), born["by"].astype(float)).filled(np.nan)
        for axis in range(3)], axis=1)
    errors = 1e3 * np.linalg.norm(ply.points({"vertex": born}) - true, axis=1)
    fx, fy, cx, cy = np.loadtxt(sequence.folder / "camera.txt", ndmin=2)[0, :4]
    mask = plt.imread(sequence.folder / f"mask/{last:06d}.png")
    mask = mask if mask.ndim == 2 else mask[:, :, 0]
    column = np.round(fx * true[:, 0] / true[:, 2] + cx)
    row = np.round(fy * true[:, 1] / true[:, 2] + cy)
    known = (np.isfinite(errors) & (column >= 0) & (column < mask.shape[1]) & (row >= 0)
             & (row < mask.shape[0]))
    seen = np.zeros(len(errors), bool)
    seen[known] = mask[row[known].astype(int), column[known].astype(int)] > 0
    return tuple(errors[part].mean() for part in (seen, np.isfinite(errors) & ~seen))


def plane_row(name, sequence, output, reference):
    """Returns the row of a run and its points, id -> place, at the last frame."""
    frames = followed(read_frames(output))
    last = frames[-1]
    live = ply.read_ply(sorted((output / "live").glob("*.ply"))[-1])
    places = dict(zip(live["vertex"]["id"].tolist(), ply.points(live)))
    shared = [np.linalg.norm(places[key] - reference[key]) for key in places
              if reference is not None and key in reference]
    seen, hidden = plane_errors(sequence, live["vertex"], int(last["frame"]))
    row = [name, f"{last['nodes']:.0f}", f"{last['pr']:.0f}", f"{last['active']:.0f}",
           cell(1e3 * last["rms_plane"], 3), cell(seen, 3), cell(hidden, 3),
           cell(1e3 * float(np.mean(shared)) if shared else None, 3),
           cell(1e3 * float(np.median([row["t_total"] for row in frames])), 0)]
    return row, places


def run_plane(options, work, output):
    """Runs (c); returns the Markdown of its table."""
    sequence = simulate(options.bin / "ed_simulate", "plane", options.plane_flags, options.cache,
                        options.fresh)
    rows, reference, outputs = [], None, {}
    for name, label, flags in VARIANTS:
        options.say(f"plane: {label}")
        result = work / f"plane_{name.replace(' ', '_')}"
        track(Variant(name, options.bin / "ed_slam", [*flags, *options.slam_flags]), sequence,
              result)
        row, places = plane_row(label, sequence, result, reference)
        reference = places if reference is None else reference
        rows.append(row)
        outputs[name] = result
    draw_plane(sequence, outputs, output / "paper_plane.png")
    return table(["last frame", "nodes", "PR", "level I", "to scan mm", "seen mm", "hidden mm",
                  "to batch mm", "ms"], rows)


def draw_plane(sequence, outputs, path):
    """The sheet at rest, then the truth as it is warped with the nodes of batch and two-level."""
    panel = (330, 250)
    pixels = (panel[0] * SUPERSAMPLING, panel[1] * SUPERSAMPLING)
    last = int(sorted((outputs["batch"] / "live").glob("*.ply"))[-1].stem)
    flat, triangles = true_plane(sequence, 0)
    warped, _ = true_plane(sequence, last)
    view = View(np.concatenate([flat, warped]) * UP, -60.0, 33.0, pixels)
    figure, axes = panels(3, 3, panel)
    image, _ = render(view, flat * UP, triangles[:, ::-1], np.broadcast_to(GRAY, flat.shape))
    show(axes[0], image, panel, "before: all of it is seen")
    image, depth = render(view, warped * UP, triangles[:, ::-1],
                          np.broadcast_to(0.5 * BLUE + 0.5, warped.shape))
    dots = view.project(flat[::7] * UP)[:, :2] / SUPERSAMPLING
    for place, name, title in ((axes[1], "batch", "batch"), (axes[2], "keep 0", "two-level")):
        graph = upright(ply.read_ply(outputs[name] / "graph.ply"))
        show(place, image, panel, f"{title}: {int((graph['vertex']['pr'] == 1).sum())} PR, "
             f"{int((graph['vertex']['pr'] == 0).sum())} PI")
        place.scatter(*dots.T, s=0.3, c="#9a9a9a", linewidths=0.0, zorder=1.5)
        draw_graph(place, view, depth, graph, SUPERSAMPLING)
    node_legend(figure, (0.995, 0.0))
    figure.savefig(path, dpi=100, facecolor="white")
    plt.close(figure)


def bend(options, work, name, flags):
    """Bends the dolphin by its handles; returns points, graph and report."""
    data = ROOT / "data/dolphin_bend"
    stem = work / f"dolphin_{name.replace(' ', '_')}"
    result, graph, report = (stem.with_suffix(end) for end in (".ply", ".graph.ply", ".json"))
    run([options.bin / "ed_fit", data / "source.ply", f"--landmarks={data / 'landmarks.csv'}",
         f"--fixed={data / 'fixed.txt'}", f"--output={result}", f"--graph={graph}",
         f"--report={report}", "--quiet", *flags], stem.with_suffix(".log"))
    return (ply.points(ply.read_ply(result)), ply.read_ply(graph),
            json.loads(report.read_text()))


def run_dolphin(options, work, output):
    """Runs (d); returns the Markdown of its table."""
    source = ply.read_ply(ROOT / "data/dolphin_bend/source.ply")
    at_rest = ply.points(source)
    diagonal = np.linalg.norm(at_rest.max(axis=0) - at_rest.min(axis=0))
    bent, rows = {}, []
    for name, label, flags in VARIANTS:
        options.say(f"dolphin: {label}")
        points, graph, report = bend(options, work, name, flags)
        bent[name] = (points, graph, label)
        difference = 100.0 * np.linalg.norm(points - bent["batch"][0], axis=1) / diagonal
        terms = report["energy"]["terms"]
        handles = np.sqrt(terms["landmark"]["raw"] / (terms["landmark"]["residuals"] / 3.0))
        rows.append([label, str(report["nodes"]["pr"]), str(report["nodes"]["pi"]),
                     f"{difference.mean():.3f}", f"{difference.max():.3f}",
                     f"{100.0 * handles:.4f}",
                     f"{report['energy']['final']:.3g}", f"{report['time_s']['solve']:.2f}"])
    draw_dolphin(source, bent, diagonal, output / "paper_dolphin.png")
    return table(["mode", "PR", "PI", "to batch, mean %", "max %", "handles off %", "energy",
                  "solve s"], rows)


def draw_dolphin(source, bent, diagonal, path):
    """The dolphin at rest with the graph, then each result coloured by its distance to batch."""
    panel, full_scale = (330, 210), 1.0
    pixels = (panel[0] * SUPERSAMPLING, panel[1] * SUPERSAMPLING)
    triangles, at_rest = ply.triangles(source), ply.points(source)
    view = View(np.concatenate([at_rest, *(points for points, _, _ in bent.values())]), 38.0, 22.0,
                pixels)
    figure, axes = panels(1 + len(bent), 3, panel)
    image, _ = render(view, at_rest, triangles, np.broadcast_to(GRAY, at_rest.shape))
    show(axes[0], image, panel, "at rest")
    batch = bent["batch"][0]
    for place, (points, graph, label) in zip(axes[1:], bent.values()):
        difference = 100.0 * np.linalg.norm(points - batch, axis=1) / diagonal
        colors = HEAT(np.clip(difference / full_scale, 0.0, 1.0))[:, :3]
        image, depth = render(view, points, triangles, colors)
        caption = label if points is batch else f"{label}: {difference.mean():.2f} % off"
        show(place, image, panel, caption)
        if points is batch:
            draw_graph(place, view, depth, graph, SUPERSAMPLING)
    node_legend(figure, (0.995, 0.0))
    height = figure.get_figheight() * 100
    bar = figure.add_axes([0.03, 16.0 / height, 0.2, 7.0 / height])
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0.0, full_scale), HEAT)
    figure.colorbar(scale, cax=bar, orientation="horizontal", extend="max")
    bar.tick_params(labelsize=6.5, length=2, pad=1)
    figure.text(0.245, 13.0 / height, "distance to batch, % of the diagonal", fontsize=8)
    figure.savefig(path, dpi=100, facecolor="white")
    plt.close(figure)
