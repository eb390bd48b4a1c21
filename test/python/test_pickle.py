"""Clouds, warps, options and results go through pickles and copies with the same bits."""
import copy
import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import ceres_ed
from conftest import make_grid

PROTOCOLS = range(2, pickle.HIGHEST_PROTOCOL + 1)
WAYS = [copy.copy, copy.deepcopy, *(lambda x, p=p: pickle.loads(pickle.dumps(x, p)) for p in PROTOCOLS)]


@pytest.fixture(scope="module")
def fitted():
    hill = make_grid(height=lambda x, y: 0.1 * np.exp(-20 * ((x - 0.5)**2 + (y - 0.4)**2)))
    colors = np.random.default_rng(1).integers(0, 256, (400, 3), dtype=np.uint8)
    return ceres_ed.fit(ceres_ed.Cloud(*make_grid(), colors=colors), hill, covariance=True,
                        landmarks={5: hill[0][5]})


def public(value):
    """Everything that can be read from an object, with arrays as bytes."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if type(value).__module__.startswith("ceres_ed"):
        names = [name for name in dir(value) if not name.startswith("_")]
        return {name: public(getattr(value, name)) for name in names
                if not callable(getattr(value, name))}
    return value


@pytest.mark.parametrize("way", WAYS)
def test_results_keep_every_bit(fitted, way, tmp_path):
    again = way(fitted)
    assert again is not fitted
    assert public(again) == public(fitted)
    assert again.covariance is not None and again.colors is not None
    for name, result in (("a", fitted), ("b", again)):
        result.warp.save(tmp_path / f"{name}.json")
        ceres_ed.save(tmp_path / f"{name}.ply", result)
    for kind in ("json", "ply"):
        assert (tmp_path / f"a.{kind}").read_bytes() == (tmp_path / f"b.{kind}").read_bytes()


@pytest.mark.parametrize("way", WAYS)
def test_warps_and_graphs_are_copies(fitted, way):
    warp = way(fitted.warp)
    assert public(warp) == public(fitted.warp)
    points = fitted.source_points
    np.testing.assert_array_equal(warp.apply(points), fitted.warp.apply(points))
    # A copy does not change with the original.
    warp.translation = warp.translation + 1
    assert not np.array_equal(warp.translation, fitted.warp.translation)
    assert public(way(fitted.graph)) == public(fitted.graph)


@pytest.mark.parametrize("way", WAYS)
def test_clouds_keep_their_file(data, tmp_path, way):
    cloud = ceres_ed.load(data / "plane_bumps/source.ply")
    again = way(cloud)
    assert public(again) == public(cloud)
    ceres_ed.save(tmp_path / "a.ply", cloud)
    ceres_ed.save(tmp_path / "b.ply", again)
    assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()


@pytest.mark.parametrize("way", WAYS)
def test_options_and_energies(way):
    options = ceres_ed.FitOptions(node_spacing=0.1 + 0.2, mode="two_level", finish=False,
                                  max_distance=float("inf"))
    assert repr(way(options)) == repr(options)
    assert way(options).node_spacing == options.node_spacing
    for kind in (ceres_ed.GraphOptions, ceres_ed.TrackerOptions):
        assert repr(way(kind())) == repr(kind())
    energy = ceres_ed.Energy("floor", weight=1 / 3, loss="huber", height=-0.1)
    assert repr(way(energy)) == repr(energy)
    assert way(energy).weight == energy.weight


def test_a_pickle_of_another_version_or_a_damaged_one_is_refused(fitted):
    state = fitted.warp.__getstate__()
    with pytest.raises(ValueError, match="expected 'ceres_ed"):
        ceres_ed.Warp.__new__(ceres_ed.Warp).__setstate__(state.replace(b"ceres_ed 0", b"ceres_ed 9"))
    for cut in (3, 40, len(state) // 2, len(state) - 1):
        with pytest.raises(ValueError):
            ceres_ed.Warp.__new__(ceres_ed.Warp).__setstate__(state[:cut])
    with pytest.raises(ValueError):
        ceres_ed.Warp.__new__(ceres_ed.Warp).__setstate__(state + b"x")


def bumps():
    return [make_grid(height=lambda x, y: 0.1 * np.exp(-20 * ((x - where)**2 + (y - 0.4)**2)))
            for where in (0.2, 0.4, 0.6, 0.8)]


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_a_process_pool_has_the_bytes_of_fits_in_a_row(start):
    source = ceres_ed.Cloud(*make_grid())
    one_by_one = [ceres_ed.fit(source, target) for target in bumps()]
    with ProcessPoolExecutor(4, mp_context=multiprocessing.get_context(start)) as pool:
        side_by_side = list(pool.map(ceres_ed.fit, [source] * 4, bumps()))
    for expected, result in zip(one_by_one, side_by_side):
        left, right = public(expected), public(result)
        left.pop("times"), right.pop("times")
        assert left == right
