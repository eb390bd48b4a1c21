"""Energies by name and parameters, and from plugins."""
import os

import numpy as np
import pytest

import ceres_ed


@pytest.fixture(scope="module")
def plugin():
    """A shared object with the energy `anchor`: pulls every node's translation to zero."""
    if "CERES_ED_GOOD_PLUGIN" not in os.environ:
        pytest.skip("CERES_ED_GOOD_PLUGIN names no plugin")
    return os.environ["CERES_ED_GOOD_PLUGIN"]


def test_lists_what_the_library_has():
    energies = {energy.name: energy for energy in ceres_ed.list_energies()}
    assert {"rotation", "regularization", "point_to_plane", "landmark"} <= set(energies)
    assert energies["landmark"].is_observation and not energies["rotation"].is_observation
    sigma = {p.name: p for p in energies["pose_prior"].parameters}["rotation_sigma"]
    assert sigma.unit == "degree" and sigma.minimum <= sigma.default <= sigma.maximum
    assert sigma.type == "real" and sigma.doc


def test_lists_what_a_plugin_brings(plugin):
    own = {energy.name for energy in ceres_ed.list_energies()}
    assert {energy.name for energy in ceres_ed.list_energies(plugin)} - own == {"anchor"}
    assert {energy.name for energy in ceres_ed.list_energies()} == own


def weighted(result, name):
    return [term["weighted"] for term in result.terms if term["name"] == name]


def test_a_plugins_energy_takes_part_in_a_fit(plane, plugin):
    free = ceres_ed.fit(*plane, finish=False)
    held = ceres_ed.fit(*plane, finish=False, plugin=plugin, energies="anchor:weight=1e6,gain=10")
    assert weighted(held, "anchor") and not weighted(free, "anchor")
    moved = np.abs(free.warp.translation).max()
    assert np.abs(held.warp.translation).max() < 0.1 * moved


def test_texts_energies_and_lists_say_the_same(plane, plugin):
    ways = ["anchor:weight=5,gain=3",
            ceres_ed.Energy("anchor", weight=5, gain=3),
            [ceres_ed.Energy("anchor", 5.0, gain=3)],
            ["anchor:weight=5,gain=3"]]
    points = [ceres_ed.fit(*plane, plugin=[plugin], energies=way, levels=1, finish=False).points
              for way in ways]
    for other in points[1:]:
        np.testing.assert_array_equal(other, points[0])


def test_an_energy_is_what_it_was_given():
    energy = ceres_ed.Energy("floor", weight=2, loss="huber", loss_width=0.5, height=-1)
    assert (energy.name, energy.weight, energy.loss, energy.loss_width) == ("floor", 2, "huber", 0.5)
    assert energy.parameters == {"height": -1.0}
    assert repr(energy) == "Energy('floor', weight=2.0, loss='huber', loss_width=0.5, height=-1.0)"
    with pytest.raises(ValueError, match="hubert"):
        ceres_ed.Energy("floor", loss="hubert")


def test_parameters_are_checked(plane, plugin):
    with pytest.raises(ValueError, match="gain"):
        ceres_ed.fit(*plane, plugin=plugin, energies="anchor:gain=11")
    with pytest.raises(ValueError, match="strength"):
        ceres_ed.fit(*plane, plugin=plugin, energies=ceres_ed.Energy("anchor", strength=1))


def test_files_that_are_no_plugin_say_why(tmp_path, data):
    with pytest.raises(FileNotFoundError):
        ceres_ed.list_energies(tmp_path / "missing.so")
    with pytest.raises(ValueError, match="cannot be loaded"):
        ceres_ed.list_energies(data / "dolphin_bend/source.ply")
