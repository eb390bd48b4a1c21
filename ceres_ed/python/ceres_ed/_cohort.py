"""Fits one template to many shapes, several at a time: what ed_cohort does, with arrays."""
import os
import queue
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _core


class Cohort:
    """The fits of one template to N shapes, in their order.

    `points` (N, V, 3) has the points of the template on each shape, NaN where a fit has failed;
    `verdicts` a Verdict or None, `errors` the sentence of a fit that has failed or None, and `used`
    (N,) whether a shape takes part in the statistics.
    """

    def __init__(self, template: NDArray[np.float64], points: NDArray[np.float64],
                 verdicts: "list[Optional[_core.Verdict]]", errors: "list[Optional[str]]",
                 worst: str) -> None:
        self.template = template
        self.points = points
        self.verdicts = verdicts
        self.errors = errors
        grades = ("good", "doubtful", "bad")
        accepted = grades[:grades.index(worst) + 1]
        self.used = np.array([v is not None and v.grade in accepted for v in verdicts], dtype=bool)

    def __len__(self) -> int:
        return len(self.verdicts)

    def aligned(self, align: str = "similarity") -> NDArray[np.float64]:
        """Returns the shapes that are used, aligned (align_shapes), in the frame of the template."""
        shapes, _ = _core.align_shapes(self.points[self.used], align=align, frame=self.template)
        return shapes

    def model(self, align: str = "similarity", components: int = 20) -> "_core.ShapeModel":
        """Returns mean and principal components of the shapes that are used."""
        return _core.fit_shape_model(self.aligned(align), components=components)

    def compare(self, groups: Sequence[Any], align: str = "similarity",
                permutations: int = 1000) -> "dict[str, NDArray[np.float64]]":
        """Tests whether the shapes differ by group (compare_groups); `groups` has N labels."""
        if len(groups) != len(self):
            raise ValueError(f"groups: {len(groups)} labels, expected {len(self)}")
        labels = [group for group, used in zip(groups, self.used) if used]
        return _core.compare_groups(self.aligned(align), labels, permutations=permutations)

    def __repr__(self) -> str:
        return f"<ceres_ed.Cohort of {len(self)} shapes, {int(self.used.sum())} used>"


def fit_cohort(template: Any, shapes: Sequence[Any], *,
               landmarks: Optional[Sequence[Any]] = None,
               jobs: Optional[int] = None, worst: str = "doubtful",
               on_progress: Optional[Callable[[int, int], Any]] = None,
               **options: Any) -> Cohort:
    """Fits `template` to each of `shapes`, `jobs` at a time (None: one for each core), and returns a Cohort.

    Shapes are surfaces, or paths of files, which are read when their turn comes. `landmarks` has for
    each shape what fit() takes, or None. A fit that fails stops no other one. `worst` ("good",
    "doubtful", "bad") is the worst verdict with which a shape takes part in the statistics.
    `on_progress(done, total)` is called after each fit. The options are those of SurfaceFitter; each
    fit has one thread. The result does not depend on `jobs`.
    """
    if worst not in ("good", "doubtful", "bad"):
        raise ValueError(f"worst is {worst!r}, expected 'good', 'doubtful' or 'bad'")
    shapes = list(shapes)
    marks = [None] * len(shapes) if landmarks is None else list(landmarks)
    if len(marks) != len(shapes):
        raise ValueError(f"landmarks: {len(marks)} entries, expected {len(shapes)}")
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs is {jobs}, expected at least 1")
    workers = max(1, min(jobs or len(os.sched_getaffinity(0)), len(shapes)))
    options.setdefault("threads", 1)
    # A fitter serves one thread at a time.
    fitters: "queue.Queue[_core.SurfaceFitter]" = queue.Queue()
    for _ in range(workers):
        fitters.put(_core.SurfaceFitter(template, **options))
    first = fitters.queue[0]
    points = np.full((len(shapes), len(first), 3), np.nan)
    verdicts: "list[Optional[_core.Verdict]]" = [None] * len(shapes)
    errors: "list[Optional[str]]" = [None] * len(shapes)
    frames: "list[NDArray[np.float64]]" = []

    def run(number: int) -> None:
        fitter = fitters.get()
        try:
            result = fitter.fit(shapes[number], landmarks=marks[number])
            if result.status == "failed":
                errors[number] = result.message
                return
            points[number] = result.points
            verdicts[number] = result.verdict
            frames.append(result.source_points)
        except (ValueError, OSError, MemoryError) as error:
            errors[number] = str(error)
        finally:
            fitters.put(fitter)

    done = 0
    with ThreadPoolExecutor(workers) as pool:
        futures = [pool.submit(run, number) for number in range(len(shapes))]
        try:
            for future in futures:
                future.result()
                done += 1
                if on_progress is not None:
                    on_progress(done, len(shapes))
        except BaseException:
            for future in futures:
                future.cancel()
            raise
    return Cohort(frames[0] if frames else points[:0].reshape(-1, 3), points, verdicts, errors, worst)
