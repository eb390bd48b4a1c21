"""The length of a long object, such as a pipe that is bent, in the live clouds of a run of ed_slam.

The object is what the mask of the first frame shows. Its map points are cut into slices along the
axis in which they are longest. In each frame its length is that of the polyline through the middles
of the slices, whichever way the object is bent. Tissue and foam keep it.

  /usr/bin/python3 scripts/object_length.py SEQUENCE RESULT      # prints the length of each frame
"""
import sys
from pathlib import Path

from sequence_runs import outlines_object

SLICES = 14
# The share of the points at each end that is left out.
ENDS = 0.02
# Fewer points than this do not show where a slice is.
FEWEST = 5


def read_camera(folder):
    """Returns fx, fy, cx, cy, width and height."""
    line = next(line for line in (folder / "camera.txt").read_text().splitlines()
                if line and not line.startswith("#"))
    fx, fy, cx, cy, width, height = (float(word) for word in line.split()[:6])
    return fx, fy, cx, cy, int(width), int(height)


def slices_of(first, mask, camera):
    """Returns the identifiers of the points of each slice in the cloud of the first frame."""
    import numpy as np

    from ply import points
    fx, fy, cx, cy, width, height = camera
    places = points(first)
    u = np.rint(fx * places[:, 0] / places[:, 2] + cx).astype(int).clip(0, width - 1)
    v = np.rint(fy * places[:, 1] / places[:, 2] + cy).astype(int).clip(0, height - 1)
    on = mask[v, u] > 0
    ids, places = first["vertex"]["id"][on], places[on]
    centred = places - places.mean(axis=0)
    along = centred @ np.linalg.svd(centred, full_matrices=False)[2][0]
    bounds = np.quantile(along, np.linspace(ENDS, 1.0 - ENDS, SLICES + 1))
    return [ids[(along >= low) & (along < high)] for low, high in zip(bounds, bounds[1:])]


def lengths(folder, output):
    """Returns {frame: length in metres}; empty without masks or live clouds."""
    import numpy as np
    from PIL import Image

    from ply import points, read_ply
    clouds = sorted((output / "live").glob("*.ply"))
    masks = folder / "mask"
    if not clouds or not (masks / f"{clouds[0].stem}.png").exists():
        return {}
    mask = np.asarray(Image.open(masks / f"{clouds[0].stem}.png").convert("L"))
    slices = slices_of(read_ply(clouds[0]), mask, read_camera(folder))
    result = {}
    for path in clouds:
        cloud = read_ply(path)
        places, ids = points(cloud), cloud["vertex"]["id"]
        kept = [places[np.isin(ids, members)] for members in slices]
        middles = [part.mean(axis=0) for part in kept if len(part) >= FEWEST]
        result[int(path.stem)] = sum(np.linalg.norm(b - a) for a, b in zip(middles, middles[1:]))
    return result


def worst_length_change(folder, output):
    """Returns the largest change of the length of the object, in percent of its length in the first
    frame; None for a sequence without such an object."""
    if not outlines_object(folder):
        return None
    values = list(lengths(folder, output).values())
    return max((abs(value / values[0] - 1.0) for value in values), default=0.0) * 100.0 or None


if __name__ == "__main__":
    for frame, length in lengths(Path(sys.argv[1]), Path(sys.argv[2])).items():
        print(f"{frame:6d} {1e3 * length:8.2f} mm")
