"""How results look in a notebook: a short table and the picture of a report."""
import base64
import html
from typing import Any, Iterable, Optional

from . import _core

# Pixels of the picture.
WIDTH = 900


def _table(title: str, rows: "Iterable[tuple[str, str]]") -> str:
    cells = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                    f"<td style='text-align:left'>{html.escape(text)}</td></tr>" for name, text in rows)
    return f"<table><caption>{html.escape(title)}</caption>{cells}</table>"


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


def fit_png(self: "_core.FitResult") -> Optional[bytes]:
    """Returns the picture of a fit; None if the library was built without pictures."""
    return self.picture(width=WIDTH) or None


def fit_html(self: "_core.FitResult") -> str:
    """Returns the table of a fit, and its picture."""
    table = _table("ceres_ed.FitResult", _fit_rows(self))
    picture = fit_png(self)
    if picture is None:
        return table
    return (f"{table}<img alt='source, target and result of the fit' width='{WIDTH}' "
            f"src='data:image/png;base64,{base64.b64encode(picture).decode()}'/>")


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
_result._repr_png_ = fit_png
_evaluation._repr_html_ = evaluation_html
