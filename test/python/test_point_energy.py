"""Energies that are functions of Python over all points: one call a step, and the numbers of a plugin."""
import os
import pickle
import threading
import traceback

import numpy as np
import pytest

import ceres_ed
from conftest import make_grid

FIT = {"rigid_first": False}


def bowl(points, normals):
    """The function of test/plugin/bowl_plugin.cc."""
    x, y, z = points.T
    residuals = z - 0.5 * (x * x + y * y)
    return residuals, np.stack([-x, -y, np.ones_like(x)], axis=1)


@pytest.fixture(scope="module")
def pair():
    height = lambda x, y: 0.1 * np.exp(-20 * ((x - 0.5)**2 + (y - 0.4)**2))
    return make_grid(n=30), make_grid(n=30, height=height)


@pytest.mark.parametrize("mode", ["batch", "two_level", "marginal"])
@pytest.mark.parametrize("loss", ["squared", "huber"])
def test_a_function_has_the_result_of_the_plugin(pair, mode, loss):
    if "CERES_ED_BOWL_PLUGIN" not in os.environ:
        pytest.skip("CERES_ED_BOWL_PLUGIN names no plugin")
    options = {"weight": 50, "loss": loss, "loss_width": 0.05}
    expected = ceres_ed.fit(*pair, mode=mode, plugin=os.environ["CERES_ED_BOWL_PLUGIN"],
                            energies=ceres_ed.Energy("bowl", **options), **FIT)
    result = ceres_ed.fit(*pair, mode=mode, energies=ceres_ed.PointEnergy(bowl, **options), **FIT)
    np.testing.assert_allclose(result.points, expected.points, atol=1e-9)
    free = ceres_ed.fit(*pair, mode=mode, **FIT)
    assert np.abs(free.points - expected.points).max() > 0.01
    names = [term["name"] for term in result.terms]
    assert "bowl" in names


def test_the_function_is_called_once_a_step_with_all_points(pair):
    calls = []

    def count(points, normals, indices):
        calls.append((len(points), points.flags.owndata, normals.shape, indices))
        return bowl(points, normals)

    result = ceres_ed.fit(*pair, energies=ceres_ed.PointEnergy(count), **FIT)
    # Several hundred: rounds, trial steps, the finish. One a point would be a hundred times more.
    assert len(calls) < 40 * result.solver_iterations
    assert len(calls) < 1500
    assert {size for size, *_ in calls} == {len(pair[0][0])}
    for _, owns, shape, indices in calls:
        assert owns and shape == (900, 3)
        np.testing.assert_array_equal(indices, np.arange(900))


def test_threads_and_repetition_change_no_bit(pair):
    energy = ceres_ed.PointEnergy(bowl, weight=20)
    expected = ceres_ed.fit(*pair, energies=energy)
    for threads in (1, 2, 5):
        np.testing.assert_array_equal(ceres_ed.fit(*pair, energies=energy, threads=threads).points,
                                      expected.points)
    found = [None] * 3

    def work(i):
        found[i] = ceres_ed.fit(*pair, energies=energy, threads=2).points

    workers = [threading.Thread(target=work, args=(i,)) for i in range(3)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    for points in found:
        np.testing.assert_array_equal(points, expected.points)


def test_normals_turn_with_the_surface(pair):
    """A function that only looks at normals sees those of the surface as it is fitted."""
    seen = []

    def look(points, normals):
        seen.append((points.copy(), normals.copy()))
        return np.zeros(len(points)), np.zeros((len(points), 3))

    ceres_ed.fit(*pair, energies=ceres_ed.PointEnergy(look), **FIT)
    first, last = seen[0][1], seen[-1][1]
    np.testing.assert_allclose(np.linalg.norm(last, axis=1), 1, atol=1e-9)
    np.testing.assert_allclose(first, np.tile([0, 0, 1.0], (900, 1)), atol=1e-6)
    grid = seen[-1][0].reshape(30, 30, 3)
    expected = np.cross(np.gradient(grid, axis=1), np.gradient(grid, axis=0)).reshape(-1, 3)
    expected /= np.linalg.norm(expected, axis=1)[:, None]
    assert np.abs(expected[:, 2]).min() < 0.97
    # The warp of the nodes is a smooth one, so its normals are about those of the triangles.
    def error(normals):
        return np.linalg.norm(normals - expected, axis=1).mean()

    assert error(last) < 0.3 * error(first)


class Mine(Exception):
    pass


@pytest.mark.parametrize("after", [0, 1, 7])
def test_an_exception_reaches_the_caller_with_its_traceback(pair, after):
    calls = []

    def fails(points, normals):
        calls.append(1)
        if len(calls) > after:
            raise Mine("of the function")
        return bowl(points, normals)

    with pytest.raises(Mine, match="of the function") as caught:
        ceres_ed.fit(*pair, energies=ceres_ed.PointEnergy(fails))
    assert any(frame.name == "fails" for frame in traceback.extract_tb(caught.value.__traceback__))
    assert len(calls) == after + 1


def returns(residuals, jacobian):
    return lambda points, normals: (residuals(len(points)), jacobian(len(points)))


def spoiled(n):
    values = np.zeros(n)
    values[17] = np.nan
    return values


@pytest.mark.parametrize("function, error, message", [
    (lambda p, n: None, TypeError, "returned .*NoneType.*expected a pair"),
    (returns(lambda n: np.zeros(n - 1), lambda n: np.zeros((n, 3))), ValueError,
     r"residuals have shape \(899,\), expected \(900,\) or \(900, R\)"),
    (returns(lambda n: np.zeros((n, 2)), lambda n: np.zeros((n, 3))), ValueError,
     r"jacobian has shape \(900, 3\), expected \(900, 2, 3\)"),
    (returns(lambda n: np.zeros(n), lambda n: np.zeros((3, n))), ValueError,
     r"jacobian has shape \(3, 900\), expected \(900, 1, 3\) or \(900, 3\)"),
    (returns(spoiled, lambda n: np.zeros((n, 3))), ValueError,
     r"residuals has nan in row 17 \(point 17, at .*expected finite"),
    (returns(lambda n: np.zeros(n), lambda n: np.full((n, 3), np.inf)), ValueError,
     "jacobian has inf in row 0"),
    (returns(lambda n: ["a"] * n, lambda n: np.zeros((n, 3))), ValueError, "residuals"),
    (lambda p: p, TypeError, "positional argument"),
])
def test_what_a_function_returns_is_checked(pair, function, error, message):
    with pytest.raises(error, match=message):
        ceres_ed.fit(*pair, energies=ceres_ed.PointEnergy(function, name="mine"))


def test_an_energy_is_what_it_was_given():
    energy = ceres_ed.PointEnergy(bowl, 2.0, kind="observation", loss="huber", loss_width=0.5)
    assert (energy.name, energy.weight, energy.kind) == ("bowl", 2.0, "observation")
    assert (energy.loss, energy.loss_width, energy.function) == ("huber", 0.5, bowl)
    assert ceres_ed.PointEnergy(lambda p, n: None).name == "function"
    again = pickle.loads(pickle.dumps(energy))
    assert (again.function, again.kind, again.weight) == (bowl, "observation", 2.0)
    with pytest.raises(TypeError, match="function is .*int"):
        ceres_ed.PointEnergy(3)
    with pytest.raises(ValueError, match="'prior' or 'observation'"):
        ceres_ed.PointEnergy(bowl, kind="data")


def test_names_are_taken_once(pair):
    with pytest.raises(ValueError, match="bowl"):
        ceres_ed.fit(*pair, energies=[ceres_ed.PointEnergy(bowl), ceres_ed.PointEnergy(bowl)])
    result = ceres_ed.fit(*pair, finish=False, energies=[
        ceres_ed.PointEnergy(bowl), ceres_ed.PointEnergy(bowl, name="second")])
    assert {"bowl", "second"} <= {term["name"] for term in result.terms}


def test_a_tracker_takes_a_function():
    camera = ceres_ed.Camera(150, 150, 79.5, 59.5, 160, 120)
    v, u = np.mgrid[:120, :160]
    depth = (0.2 + 0.006 * np.sin(u / 12) * np.cos(v / 15)).astype(np.float32)
    calls = []

    def still(points, normals):
        calls.append(len(points))
        return 1e-3 * points, 1e-3 * np.tile(np.eye(3), (len(points), 1, 1))

    tracker = ceres_ed.Tracker(camera, energies=ceres_ed.PointEnergy(still))
    for _ in range(3):
        status = tracker.track(depth).status
    assert status == "tracked" and calls

    def fails(points, normals):
        raise Mine("in a frame")

    tracker = ceres_ed.Tracker(camera, energies=ceres_ed.PointEnergy(fails))
    with pytest.raises(Mine, match="in a frame"):
        for _ in range(3):
            tracker.track(depth)
