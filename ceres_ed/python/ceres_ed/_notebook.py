"""How results look in a notebook: a short table and, where matplotlib is installed, a small picture."""
import base64
import html
import importlib
import io
from typing import Any, Iterable, Optional

import numpy as np

from . import _core

# Pixels of the picture, and the most points in it.
WIDTH, HEIGHT, POINTS = 320, 240, 4000


def _table(title: str, rows: "Iterable[tuple[str, str]]") -> str:
    cells = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                    f"<td style='text-align:left'>{html.escape(text)}</td></tr>" for name, text in rows)
    return f"<table><caption>{html.escape(title)}</caption>{cells}</table>"


def _picture(points: Any, values: Any) -> Optional[str]:
    """Returns an <img> of the points, seen along the direction in which they spread least."""
    try:
        canvas = importlib.import_module("matplotlib.backends.backend_agg").FigureCanvasAgg
        figures = importlib.import_module("matplotlib.figure")
    except ImportError:
        return None
    step = -(-len(points) // POINTS)
    points, values = points[::step], values[::step]
    centred = points - points.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1]
    dots = 100  # per inch
    figure = figures.Figure(figsize=(WIDTH / dots, HEIGHT / dots), dpi=dots)
    canvas(figure)
    plot = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    plot.scatter(centred @ axes[:, 2], centred @ axes[:, 1], c=values, s=2, linewidths=0)
    plot.set_aspect("equal")
    plot.set_axis_off()
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return (f"<img alt='the points, coloured by their displacement' width='{WIDTH}' "
            f"src='data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}'/>")


def _fit_rows(result: "_core.FitResult") -> "Iterable[tuple[str, str]]":
    verdict = result.verdict
    yield "status", result.status
    reasons = [str(reason["text"]) for reason in verdict.reasons]
    yield "verdict", ": ".join([verdict.grade, *reasons[:1]])
    yield "nodes", str(len(result.graph))
    yield "points", str(len(result))
    yield "rms to planes", f"{result.rms_point_to_plane:.4g}"
    yield "rms to points", f"{result.rms_point_to_point:.4g}"
    yield "matches", str(result.inliers)
    times = {name: seconds for name, seconds in result.times.items() if seconds >= 0.001}
    yield "seconds", ", ".join(f"{name} {seconds:.3f}" for name, seconds in times.items())
    for warning in result.warnings:
        yield "warning", warning


def fit_html(self: "_core.FitResult") -> str:
    """Returns the table of a fit, and a picture of its points, coloured by their displacement."""
    rigid = self.rigid
    start = self.source_points @ rigid[:3, :3].T + rigid[:3, 3]
    picture = _picture(np.asarray(self.points), np.linalg.norm(self.points - start, axis=1))
    return _table("ceres_ed.FitResult", _fit_rows(self)) + (picture or "")


def evaluation_html(self: "_core.Evaluation") -> str:
    """Returns the table of an evaluation."""
    parts = [("result to target", self.forward), ("target to result", self.backward),
             ("both", self.symmetric), ("to the truth", self.truth)]
    rows = [(name, f"mean {part.mean:.4g}, rms {part.rms:.4g}, p95 {part.p95:.4g}, max {part.max:.4g}")
            for name, part in parts if part is not None]
    return _table("ceres_ed.Evaluation", rows)


_result: Any = _core.FitResult
_evaluation: Any = _core.Evaluation
_result._repr_html_ = fit_html
_evaluation._repr_html_ = evaluation_html
