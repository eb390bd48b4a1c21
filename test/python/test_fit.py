"""fit(): the same as ed_fit, with callbacks, and without the interpreter's lock."""
import gc
import json
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import ceres_ed


@pytest.fixture(scope="module")
def fitted(plane):
    return ceres_ed.fit(*plane)


def test_lands_on_the_target_and_near_the_truth(data, plane, fitted):
    truth = ceres_ed.load(data / "plane_bumps/gt.ply")
    found = ceres_ed.evaluate(fitted, plane[1], truth=truth)
    before = ceres_ed.evaluate(plane[0], plane[1], truth=truth)
    assert found.forward.mean < 0.05 * before.forward.mean
    assert found.truth.mean < 0.5 * before.truth.mean


def test_writes_what_ed_fit_writes(data, plane, fitted, run_app, tmp_path):
    pair = data / "plane_bumps"
    run_app("ed_fit", pair / "source.ply", pair / "target.ply", f"--output={tmp_path / 'app.ply'}",
            f"--warp={tmp_path / 'app.json'}", f"--report={tmp_path / 'report.json'}", "--quiet")
    ceres_ed.save(tmp_path / "python.ply", fitted, like=plane[0])
    fitted.warp.save(tmp_path / "python.json")
    assert (tmp_path / "python.ply").read_bytes() == (tmp_path / "app.ply").read_bytes()
    assert (tmp_path / "python.json").read_bytes() == (tmp_path / "app.json").read_bytes()
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["status"] == fitted.status
    assert report["nodes"]["total"] == len(fitted.graph) == len(fitted.point_relevant)
    assert report["nodes"]["pr"] == fitted.point_relevant.sum()
    assert report["nodes"]["edges"] == len(fitted.graph.edges)
    assert report["inliers"] == fitted.inliers
    assert report["energy"]["final"] == fitted.final_energy
    assert report["energy"]["initial"] == fitted.initial_energy
    assert report["rms"]["point_to_plane"] == fitted.rms_point_to_plane
    assert report["outer_iterations"] == fitted.outer_iterations
    terms = {term["name"]: term["weighted"] for term in fitted.terms}
    assert terms == {name: term["weighted"] for name, term in report["energy"]["terms"].items()}
    assert sum(terms.values()) == pytest.approx(fitted.final_energy, rel=1e-12)


def test_verdict_and_checks_are_those_of_ed_fit(data, run_app, tmp_path):
    # A target in another unit: the verdict is bad, and the checks name the unit.
    source = ceres_ed.load(data / "plane_bumps/source.ply")
    big = tmp_path / "target.ply"
    ceres_ed.save(big, ceres_ed.load(data / "plane_bumps/target.ply").points * 10)
    result = ceres_ed.fit(source, ceres_ed.load(big))
    run_app("ed_fit", data / "plane_bumps/source.ply", big, f"--output={tmp_path / 'app.ply'}",
            f"--report={tmp_path / 'report.json'}", "--quiet")
    report = json.loads((tmp_path / "report.json").read_text())
    assert result.verdict.grade == report["verdict"]["grade"] != "good"
    assert result.verdict.reasons == report["verdict"]["reasons"]
    assert result.verdict.advice == report["verdict"]["advice"]
    assert report["verdict"]["grade"] in repr(result.verdict)
    assert [f.code for f in result.checks] == [f["code"] for f in report["checks"]]
    assert [f.value for f in result.checks] == [f["value"] for f in report["checks"]]
    unit = next(f for f in result.checks if f.code == "units")
    assert unit.severity == "warning" and "--scale" in unit.fix and "source" in unit.text


def test_a_good_fit_has_a_good_verdict(fitted):
    assert fitted.verdict.grade == "good"
    assert fitted.verdict.reasons == [] and fitted.verdict.advice == []
    assert not any(finding.severity == "warning" for finding in fitted.checks)


def test_flags_are_options(data, run_app, tmp_path):
    pair = data / "dolphin_bend"
    run_app("ed_fit", pair / "source.ply", pair / "target.ply", "--mode=two_level", "--rings=1",
            "--boundary=cut", "--w_reg=3", "--loss=huber", "--nofinish", "--node_spacing=0.1",
            "--max_samples=3000", "--norigid_first", "--threads=2", "--quiet",
            f"--output={tmp_path / 'app.ply'}")
    source = ceres_ed.load(pair / "source.ply")
    result = ceres_ed.fit(source, ceres_ed.load(pair / "target.ply"), mode="two_level", rings=1,
                          boundary="cut", w_reg=3, loss="huber", finish=False, node_spacing=0.1,
                          max_samples=3000, rigid_first=False)
    ceres_ed.save(tmp_path / "python.ply", result, like=source)
    assert (tmp_path / "python.ply").read_bytes() == (tmp_path / "app.ply").read_bytes()
    assert result.warp.finish_points is None


def test_standard_deviations_are_those_of_ed_fit(data, plane, fitted, run_app, tmp_path):
    assert fitted.std_dev is None
    pair = data / "plane_bumps"
    run_app("ed_fit", pair / "source.ply", pair / "target.ply", f"--output={tmp_path / 'app.ply'}",
            f"--report={tmp_path / 'report.json'}", "--quiet", "--covariance")
    known = ceres_ed.fit(*plane, covariance=True)
    np.testing.assert_array_equal(known.points, fitted.points)
    assert known.std_dev.shape == (len(plane[0]),)
    report = json.loads((tmp_path / "report.json").read_text())["covariance"]
    assert np.nanmean(known.std_dev) == pytest.approx(report["mean"], rel=1e-12)
    assert np.nanmax(known.std_dev) == report["max"]


def test_the_number_of_threads_changes_nothing(plane, fitted):
    again = ceres_ed.fit(*plane, threads=2)
    np.testing.assert_array_equal(again.points, fitted.points)


def test_results_are_views_that_outlive_the_result(plane):
    source = ceres_ed.Cloud(plane[0], normals=np.tile([0.0, 0.0, 1.0], (len(plane[0]), 1)))
    result = ceres_ed.fit(source, plane[1], finish=False, levels=1, max_rounds=1)
    points, normals, triangles, warp = result.points, result.normals, result.triangles, result.warp
    assert np.shares_memory(points, result.points)
    assert np.shares_memory(normals, result.normals)
    assert points.flags.c_contiguous and not points.flags.owndata
    expected = points.copy(), warp.translation.copy()
    del result
    gc.collect()
    np.testing.assert_array_equal(points, expected[0])
    np.testing.assert_array_equal(warp.translation, expected[1])
    assert normals.shape == points.shape
    np.testing.assert_array_equal(triangles, plane[0].triangles)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-12)


def test_results_cannot_be_written(plane, fitted):
    for array in (fitted.points, fitted.normals):
        if array is not None:
            with pytest.raises(ValueError, match="read-only"):
                array[0, 0] = 1.0


def test_inputs_stay_as_they_are(grid, hill):
    points, triangles = (array.copy() for array in grid)
    ceres_ed.fit((points, triangles), hill)
    np.testing.assert_array_equal(points, grid[0])
    np.testing.assert_array_equal(triangles, grid[1])


def test_the_warp_takes_the_source_to_the_result(plane, fitted):
    np.testing.assert_allclose(fitted.warp.apply(plane[0]), fitted.points, rtol=0, atol=1e-14)


def test_rigid_is_where_a_moved_target_is(data):
    source = ceres_ed.load(data / "dolphin_bend/source.ply")
    points, triangles = source.points, source.triangles
    angle = 0.3
    rigid = np.eye(4)
    rigid[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    rigid[:3, 3] = [0.2, -0.1, 0.4]
    moved = points @ rigid[:3, :3].T + rigid[:3, 3]
    result = ceres_ed.fit(source, (moved, triangles))
    np.testing.assert_allclose(result.rigid, rigid, atol=2e-3)
    np.testing.assert_array_equal(result.rigid, result.warp.target_from_source)


def test_landmarks_and_fixed_points(grid):
    points, _ = grid
    lifted = len(points) - 1
    target = points[lifted] + [0, 0, 0.2]
    by_dict = ceres_ed.fit(grid, landmarks={lifted: target}, fixed=[0, 1, 20])
    np.testing.assert_allclose(by_dict.points[lifted], target, atol=5e-3)
    np.testing.assert_allclose(by_dict.points[[0, 1, 20]], points[[0, 1, 20]], atol=1e-3)
    assert by_dict.max_fixed_error < 1e-3
    np.testing.assert_array_equal(by_dict.rigid, np.eye(4))
    by_pair = ceres_ed.fit(grid, landmarks=(np.array([lifted]), target[None].astype(np.float64)),
                           fixed=np.array([0, 1, 20], dtype=np.uint16))
    np.testing.assert_array_equal(by_pair.points, by_dict.points)


def test_progress_goes_from_nothing_to_all(plane):
    seen = []
    ceres_ed.fit(*plane, progress=lambda p: seen.append((p.stage, p.fraction, p.inliers)))
    fractions = [fraction for _, fraction, _ in seen]
    assert len(seen) > 3 and fractions == sorted(fractions)
    assert 0 <= fractions[0] and fractions[-1] <= 1
    # Pairs are counted in the rounds of matching and solving.
    assert [inliers for stage, _, inliers in seen if stage == "fit"][-1] > 0


def test_should_stop_ends_a_fit_with_the_best_so_far(plane, fitted):
    rounds = []
    result = ceres_ed.fit(*plane, progress=rounds.append, should_stop=lambda: len(rounds) > 1)
    assert result.status == "interrupted"
    assert result.outer_iterations < fitted.outer_iterations
    assert np.isfinite(result.points).all()


def test_a_time_limit_ends_a_fit(plane):
    assert ceres_ed.fit(*plane, time_limit_s=0.02).status == "time_limit"


@pytest.mark.parametrize("name", ["progress", "should_stop"])
def test_an_exception_in_a_callback_ends_the_fit_and_is_raised(plane, name):
    class Mine(Exception):
        pass

    calls = []

    def raise_it(*_):
        calls.append(1)
        raise Mine("said so")
    with pytest.raises(Mine, match="said so"):
        ceres_ed.fit(*plane, **{name: raise_it})
    assert len(calls) == 1


def test_ctrl_c_ends_a_fit():
    code = """
import os, signal, sys, threading, time
import numpy as np, ceres_ed
x, y = np.meshgrid(np.linspace(0, 1, 200), np.linspace(0, 1, 200))
points = np.stack([x, y, 0.1 * np.sin(9 * x)], -1).reshape(-1, 3)
signal.signal(signal.SIGINT, signal.default_int_handler)
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
start = time.monotonic()
try:
    ceres_ed.fit(points, points + 0.05 * np.cos(7 * points), max_samples=40000, max_rounds=500,
                 tolerance=1e-12)
except KeyboardInterrupt:
    print("interrupted")
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.stdout == "interrupted\n", done.stderr


def test_other_threads_run_during_a_fit(plane):
    # A thread that counts: were the lock held, it would stand still all the while.
    counts, done = [], threading.Event()

    def count():
        while not done.is_set():
            counts.append(time.perf_counter())
            time.sleep(0.001)
    thread = threading.Thread(target=count)
    thread.start()
    try:
        time.sleep(0.02)
        start = time.perf_counter()
        ceres_ed.fit(*plane)
        end = time.perf_counter()
    finally:
        done.set()
        thread.join()
    inside = [t for t in counts if start < t < end]
    assert len(inside) > 0.05 * (end - start) / 0.001
    # In every fifth of the fit.
    assert len({int(5 * (t - start) / (end - start)) for t in inside}) == 5


def test_fits_may_run_side_by_side(plane, fitted):
    results = [None, None]

    def fit(i):
        results[i] = ceres_ed.fit(*plane)
    threads = [threading.Thread(target=fit, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        np.testing.assert_array_equal(result.points, fitted.points)


def test_options_hold_defaults_and_what_is_set():
    options = ceres_ed.FitOptions()
    assert options.mode == "batch" and options.threads == 1 and options.w_rot == 1.0
    changed = ceres_ed.FitOptions(mode="marginal", rings=3)
    copy = changed.copy()
    copy.rings = 4
    assert (changed.mode, changed.rings, copy.rings) == ("marginal", 3, 4)
    assert "rings=3" in repr(changed)
    assert all(f"{name}=" in repr(options) for name in options.names)


def test_keywords_come_before_options(plane):
    options = ceres_ed.FitOptions(levels=1, finish=False)
    result = ceres_ed.fit(*plane, options=options, finish=True)
    assert result.warp.finish_points is not None
    assert options.finish is False and options.levels == 1


@pytest.mark.parametrize("arguments, error, message", [
    ({"mode": "bach"}, ValueError, "mode is 'bach', expected 'batch' or 'two_level'"),
    ({"nod_spacing": 1}, TypeError, "knows no 'nod_spacing' .did you mean 'node_spacing'.*; its options are mode, rings"),
    ({"rings": 1.5}, TypeError, None),
    ({"w_rot": -1.0}, ValueError, "w_rot is -1, expected a finite number >= 0"),
    ({"match_max_deviations": float("nan")}, ValueError, "match_max_deviations is nan"),
    ({"threads": -1}, ValueError, "threads is -1, expected a whole number >= 1"),
    ({"threads": "two"}, TypeError, "threads is 'two', expected a whole number >= 1.* auto"),
    ({"finish": "no"}, TypeError, "finish is 'no', expected"),
    ({"mode": 3}, TypeError, "mode is 3, expected"),
    ({"landmarks": {9999999: (0, 0, 0)}}, ValueError, "names source point 9999999"),
    ({"landmarks": [1, 2]}, TypeError, "landmarks: expected"),
    ({"landmarks": ([1, 2], [[0, 0, 0]])}, ValueError, "2 source points and 1 positions"),
    ({"fixed": [-1]}, ValueError, "-1, expected an index"),
    ({"fixed": [0.5]}, ValueError, "expected integers"),
    ({"progress": 3}, TypeError, None),
    ({"energies": "unknown"}, ValueError, "unknown"),
    ({"energies": "anchor:weight="}, ValueError, "weight"),
    ({"energies": [3]}, TypeError, "expected an Energy, a PointEnergy or a str"),
])
def test_what_cannot_be_used_is_an_error(plane, arguments, error, message):
    with pytest.raises(error, match=message):
        ceres_ed.fit(*plane, **arguments)


def test_surfaces_that_cannot_be_fitted_are_value_errors(grid):
    with pytest.raises(ValueError, match="a fit needs a target or landmarks"):
        ceres_ed.fit(grid)
    with pytest.raises(ValueError, match="very different sizes"):
        ceres_ed.fit(grid, (1000 * grid[0], grid[1]))
    with pytest.raises(ValueError, match="source's points"):
        ceres_ed.fit((grid[0][:, :2], grid[1]), grid)
    with pytest.raises(ValueError, match="target"):
        ceres_ed.fit(grid, np.full((9, 3), np.nan))
