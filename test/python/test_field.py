"""Displacement fields of warps: arrays, files, and the options of both."""
import copy
import inspect
import re
import zlib

import numpy as np
import pytest

import ceres_ed


@pytest.fixture(scope="module")
def warp(plane):
    """Smooth waves, a turn and a shift."""
    graph = ceres_ed.Graph.build(plane[0], target_nodes=60)
    warp = ceres_ed.Warp(graph)
    size = np.ptp(graph.nodes, axis=0).max()
    warp.translation = 0.03 * size * np.sin(3 * graph.nodes / size)
    turn = np.eye(4)
    turn[:2, :2] = [[0.96, -0.28], [0.28, 0.96]]
    turn[:3, 3] = [0.01, 0.02, -0.03]
    warp.target_from_source = turn
    return warp


def grid_points(field):
    """The points of the grid by the formula of Field's text, in the order of `vectors`."""
    k, j, i = np.meshgrid(*map(np.arange, field.vectors.shape[:3]), indexing="ij")
    return field.origin + (np.stack([i, j, k], axis=-1) * field.spacing) @ field.direction.T


def test_the_points_of_the_grid_move_as_the_warp_moves_them(warp, plane):
    field = warp.field(plane[0])
    moved = grid_points(field) + field.vectors
    inside = grid_points(field).reshape(-1, 3)
    expected = warp.apply(inside)
    # The library's rule for points beside the surface is that of ed_apply --field.
    assert np.median(np.linalg.norm(moved.reshape(-1, 3) - expected, axis=1)) < \
        0.01 * field.spacing.min()
    assert field.inverse is None
    error = field.error
    assert error["points"] == len(plane[0].points) and error["mean"] <= error["max"]
    through = field.apply(plane[0].points)
    off = np.linalg.norm(through - warp.apply(plane[0]), axis=1) / field.spacing.min()
    assert off.mean() == pytest.approx(error["mean"], rel=1e-6)
    assert off.max() == pytest.approx(error["max"], rel=1e-6)
    assert np.isnan(field.apply([[1e3, 0, 0]])).all()
    with pytest.raises(ValueError, match="read-only"):
        field.vectors[0] = 0


def test_an_inverse_field_leads_back(warp, plane):
    spacing = 2 * np.linalg.norm(np.ptp(plane[0].points, axis=0)) / 100
    field = warp.field(plane[0], inverse=True, spacing=spacing)
    assert field.inverse["mean_residual"] < 0.05
    back = field.apply(warp.apply(plane[0]))
    off = np.linalg.norm(back - plane[0].points, axis=1) / spacing
    assert np.nanmean(off) < 0.1


def nrrd(path):
    """Reads header and vectors of an NRRD file by the words of its format."""
    head, _, body = path.read_bytes().partition(b"\n\n")
    fields = dict(re.findall(rb"^([\w ]+): (.*)$", head, re.MULTILINE))
    raw = zlib.decompress(body, 31) if fields[b"encoding"] == b"gzip" else body
    sizes = [int(n) for n in fields[b"sizes"].split()]
    numbers = [float(n) for n in re.findall(rb"[-+.\de]+", fields[b"space origin"])]
    return fields, np.frombuffer(raw, "<f4").reshape(sizes[::-1]), np.array(numbers)


def test_a_file_has_what_is_returned(warp, plane, tmp_path):
    """In LPS and mm, of surfaces in RAS and metres: x and y turn, and all is a thousand times as long."""
    options = {"spacing": 0.02, "frame": "ras", "unit": "m"}
    own = warp.field(plane[0], **options)
    written = warp.write_field(tmp_path / "f.nrrd", plane[0], **options)
    fields, vectors, origin = nrrd(tmp_path / "f.nrrd")
    assert fields[b"space"] == b"left-posterior-superior"
    np.testing.assert_array_equal(vectors, written.vectors)
    np.testing.assert_allclose(origin, written.origin, rtol=1e-15)
    assert "LPS, mm" in written.description and "LPS" in repr(written)
    assert "LPS" not in repr(own)
    factors = np.array([-1000.0, -1000, 1000])
    # The same map: a point of the surface goes the same way through both.
    points = plane[0].points[::7]
    np.testing.assert_allclose(written.apply(points * factors) / factors, own.apply(points),
                               atol=0.02 * own.spacing.min())


def test_the_bytes_are_those_of_ed_apply(warp, data, tmp_path, run_app):
    source = data / "plane_bumps/source.ply"
    warp.save(tmp_path / "w.json")
    for name, flags, options in (("a.mha", [], {}), ("b.vti", ["--inverse"], {"inverse": True}),
                                 ("c.nii", ["--spacing=0.03", "--unit=cm"],
                                  {"spacing": 0.03, "unit": "cm"})):
        run_app("ed_apply", tmp_path / "w.json", source, f"--field={tmp_path / name}", *flags)
        warp.write_field(tmp_path / ("py_" + name), source, **options)
        assert (tmp_path / ("py_" + name)).read_bytes() == (tmp_path / name).read_bytes(), name
    run_app("ed_apply", tmp_path / "w.json", f"--rigid={tmp_path / 'r.tfm'}", "--frame=ras")
    warp.write_rigid(tmp_path / "py.tfm", frame="ras")
    assert (tmp_path / "py.tfm").read_bytes() == (tmp_path / "r.tfm").read_bytes()
    warp.write_rigid(tmp_path / "r.txt")
    np.testing.assert_allclose(np.loadtxt(tmp_path / "r.txt"), warp.target_from_source, atol=1e-15)


def test_options_are_keywords_and_an_object(warp, plane):
    names = ceres_ed.FieldOptions.names
    assert {"inverse", "spacing", "frame", "unit", "bounds", "like"} <= set(names)
    assert not {"field", "rigid"} & set(names)
    for function in (ceres_ed.Warp.field, ceres_ed.Warp.write_field):
        assert set(names) <= set(inspect.signature(function).parameters)
    assert list(inspect.signature(warp.field).parameters)[0] == "around"
    options = ceres_ed.FieldOptions(bounds="0,1,0,1,0,1", spacing=0.5)
    assert copy.copy(options).spacing == 0.5
    field = warp.field(options=options)
    assert field.vectors.shape == (3, 3, 3, 3)
    np.testing.assert_array_equal(field.origin, np.zeros(3))
    assert warp.field(options=options, spacing=0.25).vectors.shape == (5, 5, 5, 3)


def test_what_cannot_be_used_says_so(warp, plane, tmp_path):
    for error, match, call in (
            (TypeError, "did you mean 'spacing'", lambda: warp.field(spacin=1)),
            (TypeError, "knows no 'field'", lambda: warp.field(field="x.nrrd")),
            (ValueError, "spacing", lambda: warp.field(spacing=-1.0)),
            (ValueError, "frame is 'xyz', expected 'lps' or 'ras'", lambda: warp.field(frame="xyz")),
            (ValueError, "six finite numbers", lambda: warp.field(bounds="0,1")),
            (ValueError, "would fit", lambda: warp.field(spacing=1e-5)),
            (ValueError, "unknown format", lambda: warp.write_field(tmp_path / "f.png")),
            (OSError, "none", lambda: warp.write_field(tmp_path / "none" / "f.mha"))):
        with pytest.raises(error, match=match):
            call()
