"""Fits a template to the shapes of a folder with Dask, and shows the first components.

  dask_cohort.py TEMPLATE FOLDER [ADDRESS OF A SCHEDULER]

Without an address, Dask starts workers on this machine. Each worker prepares the template once.
"""
import functools
import sys
from pathlib import Path

import numpy as np
from distributed import Client, LocalCluster

import ceres_ed


@functools.lru_cache(maxsize=1)
def fitter(template):
    """Returns the fitter of this process."""
    return ceres_ed.SurfaceFitter(template, threads=1)


def fit_shape(template, shape):
    """Returns the points of the template on a shape, and the verdict; None for both if it fails."""
    try:
        result = fitter(template).fit(shape)
    except (ValueError, OSError) as error:
        return None, str(error)
    return np.array(result.points), result.verdict.grade


def main(template, folder, address=None):
    shapes = sorted(str(path) for path in Path(folder).glob("*.ply"))
    cluster = None if address else LocalCluster(threads_per_worker=1, n_workers=2, dashboard_address=None)
    with Client(address or cluster) as client:
        futures = client.map(functools.partial(fit_shape, template), shapes, pure=False)
        results = client.gather(futures)
    for shape, (_, verdict) in zip(shapes, results):
        print(f"{Path(shape).stem}: {verdict}")
    points = np.array([points for points, verdict in results if verdict in ("good", "doubtful")])
    aligned, _ = ceres_ed.align_shapes(points, frame=ceres_ed.load(template).points)
    model = ceres_ed.fit_shape_model(aligned)
    print(f"{len(points)} shapes; explained variance: {np.round(100 * model.explained[:3], 1)} %")


if __name__ == "__main__":
    main(*sys.argv[1:])
