"""fit_cohort has the results of fit(), and their statistics are those of numpy."""
import numpy as np
import pytest

import ceres_ed
from conftest import make_grid


def bumps(height):
    return make_grid(height=lambda x, y: height * np.exp(-20 * ((x - 0.3)**2 + (y - 0.4)**2)))


HEIGHTS = (0.05, 0.1, 0.15, 0.2)


def test_results_are_those_of_fit_for_any_number_of_jobs(grid):
    shapes = [bumps(height) for height in HEIGHTS]
    calls = []
    cohort = ceres_ed.fit_cohort(grid, shapes, jobs=3, node_spacing=0.15,
                                 on_progress=lambda done, total: calls.append((done, total)))
    assert len(cohort) == 4 and calls[-1] == (4, 4)
    for points, verdict, shape in zip(cohort.points, cohort.verdicts, shapes):
        expected = ceres_ed.fit(grid, shape, node_spacing=0.15)
        np.testing.assert_array_equal(points, expected.points)
        assert repr(verdict) == repr(expected.verdict)
    np.testing.assert_array_equal(
        ceres_ed.fit_cohort(grid, shapes, jobs=1, node_spacing=0.15).points, cohort.points)
    np.testing.assert_array_equal(cohort.template, grid[0])


def test_a_failed_shape_stops_no_other_one(grid):
    cohort = ceres_ed.fit_cohort(grid, [bumps(0.1), "/no/such/file.ply", bumps(0.2)], worst="bad")
    assert cohort.errors[0] is None and "/no/such/file.ply" in cohort.errors[1]
    assert np.isnan(cohort.points[1]).all() and cohort.verdicts[1] is None
    assert list(cohort.used) == [True, False, True]
    assert cohort.aligned("none").shape == (2, len(grid[0]), 3)


def test_arguments_are_named(grid):
    with pytest.raises(ValueError, match="jobs is 0"):
        ceres_ed.fit_cohort(grid, [grid], jobs=0)
    with pytest.raises(ValueError, match="landmarks: 2 entries, expected 1"):
        ceres_ed.fit_cohort(grid, [grid], landmarks=[None, None])
    with pytest.raises(ValueError, match="worst is 'nice'"):
        ceres_ed.fit_cohort(grid, [grid], worst="nice")
    with pytest.raises(TypeError, match="did you mean 'node_spacing'"):
        ceres_ed.fit_cohort(grid, [grid], nod_spacing=1)


def random_shapes(count=12, vertices=30):
    return np.random.default_rng(1).normal(size=(count, vertices, 3))


def test_the_model_is_that_of_a_singular_value_decomposition():
    shapes = random_shapes()
    model = ceres_ed.fit_shape_model(shapes, components=5)
    flat = (shapes - shapes.mean(0)).reshape(len(shapes), -1)
    _, values, rows = np.linalg.svd(flat, full_matrices=False)
    np.testing.assert_allclose(model.mean, shapes.mean(0), atol=1e-12)
    np.testing.assert_allclose(model.variances, values[:5]**2 / (len(shapes) - 1))
    np.testing.assert_allclose(model.explained, values[:5]**2 / (values**2).sum())
    np.testing.assert_allclose(model.vertex_variances, shapes.var(0, ddof=1).sum(1))
    for k in range(5):
        assert abs(model.components[k].ravel() @ rows[k]) == pytest.approx(1)
    np.testing.assert_allclose(
        model.scores, flat @ model.components.reshape(5, -1).T, atol=1e-9)


def test_alignment_takes_motions_out():
    shape = random_shapes(1)[0]
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.]])
    aligned, transforms = ceres_ed.align_shapes([shape, 2 * shape @ turn.T + 5], frame=shape)
    np.testing.assert_allclose(aligned[0], aligned[1], atol=1e-9)
    moved = (2 * shape @ turn.T + 5) @ transforms[1][:3, :3].T + transforms[1][:3, 3]
    np.testing.assert_allclose(moved, aligned[1], atol=1e-9)
    rigid, _ = ceres_ed.align_shapes([shape, shape @ turn.T + 5], align="rigid", frame=shape)
    np.testing.assert_allclose(rigid[1], shape, atol=1e-9)


def test_groups_are_told_apart_where_they_differ():
    shapes = random_shapes(30)
    shapes[::2, 3] += 4
    test = ceres_ed.compare_groups(shapes, ["a", "b"] * 15)
    assert test["p_corrected"][3] < 0.01
    assert (np.delete(test["p_corrected"], 3) > 0.05).all()
    assert test["difference"][3] == pytest.approx(4 * 3**0.5, abs=1.5)


def test_the_quality_of_models_is_measured():
    quality = ceres_ed.measure_shape_model(random_shapes(), components=4)
    assert quality["shapes"] == 12 and len(quality["specificity"]) == 4
    assert (np.diff(quality["generalization"]) < 0).all()


def test_bad_shapes_are_named():
    with pytest.raises(ValueError, match=r"shapes: expected an array of \(N, V, 3\)"):
        ceres_ed.fit_shape_model(np.zeros((3, 4)))
    shapes = random_shapes(3)
    shapes[1, 0, 0] = np.nan
    with pytest.raises(ValueError, match="shape 1 is not finite"):
        ceres_ed.fit_shape_model(shapes)
    with pytest.raises(ValueError, match="align is 'x', expected one of similarity, rigid, none"):
        ceres_ed.align_shapes(random_shapes(2), align="x")
    with pytest.raises(ValueError, match="expected 2 to 255 groups"):
        ceres_ed.compare_groups(random_shapes(3), "aaa")
