"""A SurfaceFitter has the results of fit(), for one source and many targets."""
import numpy as np
import pytest

import ceres_ed
from conftest import make_grid


def bumps(where):
    return make_grid(height=lambda x, y: 0.1 * np.exp(-20 * ((x - where)**2 + (y - 0.4)**2)))


def test_results_are_those_of_fit(grid):
    fitter = ceres_ed.SurfaceFitter(grid, node_spacing=0.15)
    assert len(fitter) == len(grid[0])
    for where in (0.3, 0.6):
        expected = ceres_ed.fit(grid, bumps(where), node_spacing=0.15)
        result = fitter.fit(bumps(where))
        np.testing.assert_array_equal(result.points, expected.points)
        np.testing.assert_array_equal(result.triangles, expected.triangles)
        np.testing.assert_array_equal(result.source_points, grid[0])
        assert repr(result.verdict) == repr(expected.verdict)
    landmarks = {0: grid[0][0] + [0, 0, 0.1]}
    np.testing.assert_array_equal(fitter.fit(landmarks=landmarks).points,
                                  ceres_ed.fit(grid, landmarks=landmarks, node_spacing=0.15).points)


def test_bad_options_and_inputs_are_named(grid):
    with pytest.raises(TypeError, match="SurfaceFitter.*did you mean 'node_spacing'"):
        ceres_ed.SurfaceFitter(grid, nod_spacing=1)
    with pytest.raises(ValueError, match="w_reg"):
        ceres_ed.SurfaceFitter(grid, w_reg=-1)
    with pytest.raises(ValueError, match="a fit needs a target or landmarks"):
        ceres_ed.SurfaceFitter(grid).fit()


def test_it_stops_and_goes_on(grid):
    fitter = ceres_ed.SurfaceFitter(grid)
    assert fitter.fit(bumps(0.3), should_stop=lambda: True).status == "interrupted"

    def fails():
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        fitter.fit(bumps(0.3), should_stop=fails)
    np.testing.assert_array_equal(fitter.fit(bumps(0.3)).points, ceres_ed.fit(grid, bumps(0.3)).points)
