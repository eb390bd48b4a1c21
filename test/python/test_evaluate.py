"""evaluate(): distances that are known in closed form, and those of ed_eval."""
import json

import numpy as np
import pytest

import ceres_ed


def test_a_shifted_plane_is_at_its_shift(grid):
    points, triangles = grid
    shifted = points + [0, 0, 0.25]
    found = ceres_ed.evaluate((shifted, triangles), grid, truth=points, source=grid)
    for distances in (found.forward, found.backward, found.symmetric, found.truth):
        for figure in ("mean", "rms", "p50", "p95", "max", "trimmed"):
            assert getattr(distances, figure) == pytest.approx(0.25, rel=1e-12)
    assert found.diagonal == pytest.approx(2**0.5)
    assert found.forward.in_percent_of(0.5).mean == pytest.approx(50)
    assert found.point_to_plane == pytest.approx(0.25)
    assert found.normal_error_deg == pytest.approx(0.0, abs=1e-6)
    assert found.shape.edge_mean == pytest.approx(0.0, abs=1e-12)
    assert found.shape.flipped == found.shape.degenerate == 0


def test_stretch_and_flips_are_seen(grid):
    points, triangles = grid
    found = ceres_ed.evaluate((2 * points, triangles), grid, source=grid)
    assert found.shape.edge_mean == pytest.approx(1.0)
    turned = ceres_ed.evaluate((points * [1, 1, 1], triangles[:, ::-1]), grid, source=grid)
    assert turned.normal_error_deg == pytest.approx(180.0)


def test_what_is_not_asked_for_is_none(grid):
    found = ceres_ed.evaluate(grid[0], grid[0])
    assert found.truth is None and found.shape is None and found.point_to_plane is None


def test_a_result_brings_its_source(data, run_app, tmp_path):
    pair = data / "plane_bumps"
    source, target, truth = (ceres_ed.load(pair / f"{name}.ply")
                             for name in ("source", "target", "gt"))
    result = ceres_ed.fit(source, target)
    found = ceres_ed.evaluate(result, target, truth)
    explicit = ceres_ed.evaluate((result.points, result.triangles), target, truth, source)
    assert found.shape.edges > 0
    assert found.shape.edge_p99 == explicit.shape.edge_p99
    # ed_eval reads points in the file's single precision.
    ceres_ed.save(tmp_path / "result.ply", result, like=source)
    run_app("ed_eval", tmp_path / "result.ply", pair / "target.ply", f"--truth={pair / 'gt.ply'}",
            f"--source={pair / 'source.ply'}", f"--report={tmp_path / 'report.json'}")
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["truth"]["mean"] == pytest.approx(found.truth.mean, rel=1e-4)
    saved = ceres_ed.evaluate(ceres_ed.load(tmp_path / "result.ply"), target, truth, source)
    assert report["truth"]["mean"] == saved.truth.mean
    assert report["symmetric"]["p95"] == saved.symmetric.p95


def test_unequal_counts_are_value_errors(grid, hill):
    with pytest.raises(ValueError, match="truth"):
        ceres_ed.evaluate(grid, hill, truth=grid[0][:-1])
    with pytest.raises(ValueError):
        ceres_ed.evaluate(np.zeros((0, 3)), hill)
