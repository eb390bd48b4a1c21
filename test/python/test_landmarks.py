"""Landmarks by name: files, spaces, fits that they draw or measure."""
import copy
import json
import pickle

import numpy as np
import pytest

import ceres_ed
from conftest import make_grid

PLACES = {"nasion": (0.25, 0.75, 0.0), "left, upper": (0.5, 0.5, 0.1), "F-3": (1 / 3, 0.2, -1e-7)}


def test_they_are_names_and_positions():
    marks = ceres_ed.Landmarks(PLACES, space="RAS")
    assert marks.names == list(PLACES) and len(marks) == 3 and marks.space == "RAS"
    np.testing.assert_array_equal(marks.positions, list(PLACES.values()))
    np.testing.assert_array_equal(marks["F-3"], PLACES["F-3"])
    assert list(dict(marks)) == list(PLACES)
    assert "3 points in RAS" in repr(marks)
    turned = marks.to("LPS")
    np.testing.assert_array_equal(turned.positions, marks.positions * [-1, -1, 1])
    np.testing.assert_array_equal(turned.to("RAS").positions, marks.positions)
    assert ceres_ed.Landmarks(PLACES).space is None
    with pytest.raises(ValueError, match="read-only"):
        marks.positions[0] = 0


def test_what_is_no_landmark_says_so():
    marks = ceres_ed.Landmarks(PLACES)
    for error, match, call in (
            (KeyError, "no landmark is named 'x'", lambda: marks["x"]),
            (ValueError, "space of the landmarks is not known", lambda: marks.to("LPS")),
            (ValueError, "positions has 2 rows", lambda: marks.at(np.zeros((2, 3)))),
            (ValueError, "space is 'lps', expected 'LPS'", lambda: ceres_ed.Landmarks(PLACES, "lps")),
            (ValueError, "at least one", lambda: ceres_ed.Landmarks({})),
            (TypeError, "name 3", lambda: ceres_ed.Landmarks({3: (0, 0, 0)})),
            (TypeError, "expected {name", lambda: ceres_ed.Landmarks(np.eye(3))),
            (ValueError, "side is 'left'", lambda: ceres_ed.Landmarks.load("x.csv", side="left")),
            (FileNotFoundError, "none.csv", lambda: ceres_ed.Landmarks.load("none.csv"))):
        with pytest.raises(error, match=match):
            call()


@pytest.mark.parametrize("ending", [".mrk.json", ".fcsv", ".csv"])
@pytest.mark.parametrize("space", ["LPS", "RAS"])
def test_files_have_the_same_bits(tmp_path, ending, space):
    ceres_ed.Landmarks(PLACES, space=space).save(tmp_path / f"new{ending}")
    again = ceres_ed.Landmarks.load(tmp_path / f"new{ending}")
    assert again.names == list(PLACES) and again.space == space and again.warnings == []
    np.testing.assert_array_equal(again.positions, list(PLACES.values()))


def test_a_file_keeps_what_it_has_and_its_space(tmp_path):
    """Slicer's file in RAS is worked on in LPS, and written back: only the positions change."""
    tree = {"markups": [{"type": "Fiducial", "coordinateSystem": "RAS", "display": {"opacity": 0.25},
                         "controlPoints": [{"label": "a", "position": [1.0, 2.0, 3.0], "locked": True},
                                           {"label": "b", "position": [4.0, 5.0, 6.0]}]}]}
    (tmp_path / "in.mrk.json").write_text(json.dumps(tree))
    marks = ceres_ed.Landmarks.load(tmp_path / "in.mrk.json").to("LPS")
    np.testing.assert_array_equal(marks["a"], [-1, -2, 3])
    marks.at(marks.positions + [0, 0, 1]).save(tmp_path / "out.mrk.json")
    tree["markups"][0]["controlPoints"][0]["position"] = [1.0, 2.0, 4.0]
    tree["markups"][0]["controlPoints"][1]["position"] = [4.0, 5.0, 7.0]
    assert json.loads((tmp_path / "out.mrk.json").read_text()) == tree
    # Another format is a new file, in the space that the positions are in.
    marks.save(tmp_path / "out.fcsv")
    other = ceres_ed.Landmarks.load(tmp_path / "out.fcsv")
    assert other.space == "LPS"
    np.testing.assert_array_equal(other.positions, marks.positions)
    with pytest.raises(OSError, match="expected LPS or RAS"):
        ceres_ed.Landmarks(PLACES).save(tmp_path / "out.mrk.json")


def test_copies_and_pickles(tmp_path):
    ceres_ed.Landmarks(PLACES, space="LPS").save(tmp_path / "new.fcsv")
    marks = ceres_ed.Landmarks.load(tmp_path / "new.fcsv")
    for twin in (copy.deepcopy(marks), pickle.loads(pickle.dumps(marks))):
        assert twin.names == marks.names and twin.space == "LPS"
        np.testing.assert_array_equal(twin.positions, marks.positions)
        twin.save(tmp_path / "twin.fcsv")
        assert (tmp_path / "twin.fcsv").read_bytes() == (tmp_path / "new.fcsv").read_bytes()


# A plane that is lifted and moved; nothing but the landmarks says by how much within itself.
SHIFT = np.array([0.05, -0.03, 0.2])
ON_SOURCE = {str(i): np.array(at) for i, at in enumerate(
    [(0.31, 0.22, 0), (0.72, 0.18, 0), (0.24, 0.83, 0), (0.77, 0.74, 0), (0.5, 0.5, 0)])}
ON_TARGET = {name: at + SHIFT for name, at in ON_SOURCE.items()}


def moved_plane():
    points, triangles = make_grid()
    return points + SHIFT, triangles


def test_they_draw_a_fit_and_are_measured(grid):
    free = ceres_ed.fit(grid, moved_plane(), source_landmarks=ON_SOURCE, target_landmarks=ON_TARGET,
                        landmark_use="measure")
    drawn = ceres_ed.fit(grid, moved_plane(), source_landmarks=ON_SOURCE, target_landmarks=ON_TARGET)
    assert [error["name"] for error in drawn.landmark_errors] == list(ON_SOURCE)
    for error in drawn.landmark_errors:
        assert error["before"] == pytest.approx(np.linalg.norm(SHIFT), rel=1e-12)
        assert error["after"] < 1e-3
    # Only measured, they change nothing.
    np.testing.assert_array_equal(free.points, ceres_ed.fit(grid, moved_plane()).points)
    assert len(free.landmark_errors) == len(ON_SOURCE)
    assert ceres_ed.fit(grid, moved_plane()).landmark_errors == []
    twin = pickle.loads(pickle.dumps(drawn))
    assert twin.landmark_errors == drawn.landmark_errors


def test_all_ways_to_name_them_and_the_fitter_agree(grid, tmp_path):
    """Also with the landmarks of the target in RAS, which is turned."""
    expected = ceres_ed.fit(grid, moved_plane(), source_landmarks=ON_SOURCE,
                            target_landmarks=ON_TARGET)
    ceres_ed.Landmarks(ON_SOURCE, space="LPS").save(tmp_path / "source.mrk.json")
    in_ras = ceres_ed.Landmarks(ON_TARGET, space="LPS").to("RAS")
    marks = {"source_landmarks": tmp_path / "source.mrk.json", "target_landmarks": in_ras}
    result = ceres_ed.fit(grid, moved_plane(), **marks)
    np.testing.assert_array_equal(result.points, expected.points)
    result = ceres_ed.SurfaceFitter(grid).fit(moved_plane(), **marks)
    np.testing.assert_array_equal(result.points, expected.points)
    assert result.landmark_errors == expected.landmark_errors
    # Alone they are enough, too.
    alone = ceres_ed.fit(grid, source_landmarks=ON_SOURCE, target_landmarks=ON_TARGET)
    assert max(error["after"] for error in alone.landmark_errors) < 1e-3


def test_a_fit_has_the_figures_of_ed_fit(plane, data, tmp_path, run_app):
    source, target = data / "plane_bumps/source.ply", data / "plane_bumps/target.ply"
    points = plane[0].points
    marks = ceres_ed.Landmarks({str(i): points[i] + [0.001, 0, 0] for i in (3, 50, 400, 700)})
    marks.save(tmp_path / "s.csv")
    marks.at(marks.positions + [0, 0, 0.004]).save(tmp_path / "t.csv")
    run_app("ed_fit", source, target, f"--output={tmp_path / 'o.ply'}",
            f"--source_landmarks={tmp_path / 's.csv'}", f"--target_landmarks={tmp_path / 't.csv'}",
            f"--report={tmp_path / 'r.json'}")
    report = json.loads((tmp_path / "r.json").read_text())
    result = ceres_ed.fit(source, target, source_landmarks=tmp_path / "s.csv",
                          target_landmarks=tmp_path / "t.csv")
    for mine, theirs in zip(result.landmark_errors, report["landmarks"]["pairs"], strict=True):
        assert mine == {key: theirs[key] for key in ("name", "before", "rigid", "after")}
    assert result.verdict.grade == report["verdict"]["grade"]


def test_bad_arguments_of_a_fit_are_named(grid):
    for error, match, options in (
            (ValueError, "belong together", {"source_landmarks": PLACES}),
            (ValueError, "no name is in both", {"source_landmarks": PLACES,
                                                "target_landmarks": {"other": (0, 0, 0)}}),
            (ValueError, "landmark_use is 'draw', expected 'fit' or 'measure'",
             {"landmark_use": "draw"}),
            (ValueError, "mesh_space is 'XYZ'", {"mesh_space": "XYZ"}),
            (TypeError, "source_landmarks is .*ndarray", {"source_landmarks": np.eye(3),
                                                          "target_landmarks": PLACES}),
            (FileNotFoundError, "none.csv", {"source_landmarks": "none.csv",
                                             "target_landmarks": PLACES})):
        with pytest.raises(error, match=match):
            ceres_ed.fit(grid, grid, **options)


def test_singles_are_warned_of(grid):
    result = ceres_ed.fit(grid, moved_plane(), source_landmarks={**ON_SOURCE, "more": (0, 0, 0)},
                          target_landmarks=ON_TARGET)
    assert any("without a partner and not used: 'more'" in text for text in result.warnings)
