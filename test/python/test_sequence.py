"""Sequences are read frame by frame, and results on them evaluated, as by the programs."""
import json

import numpy as np
import pytest

import ceres_ed
from conftest import ROOT

Image = pytest.importorskip("PIL.Image")


@pytest.fixture(scope="module")
def folder(tmp_path_factory, run_app):
    folder = tmp_path_factory.mktemp("sequence")
    run_app("ed_simulate", "plane", f"--output={folder / 'plane'}", "--frames=4")
    return folder / "plane"


def test_frames_are_those_of_the_files(folder):
    sequence = ceres_ed.open_sequence(folder)
    fx, fy, cx, cy, width, height, units = np.loadtxt(folder / "camera.txt")
    assert len(sequence) == len(sequence.numbers) == 4
    assert (sequence.camera.fx, sequence.camera.width) == (fx, width)
    assert sequence.has_color and not sequence.is_stereo
    for number, frame in enumerate(sequence):
        assert frame.number == number == sequence.numbers[number]
        depth = np.array(Image.open(folder / f"depth/{number:06d}.png"))
        assert frame.depth.dtype == np.float32 and frame.depth.shape == (height, width)
        np.testing.assert_array_equal(frame.depth, (depth / units).astype(np.float32))
        color = np.array(Image.open(folder / f"color/{number:06d}.png").convert("RGB"))
        np.testing.assert_array_equal(frame.color, color)
        assert frame.pose.shape == (4, 4)
    np.testing.assert_array_equal(sequence[-1].depth, frame.depth)
    with pytest.raises(IndexError):
        sequence[4]


def test_frames_outlive_the_sequence_and_are_taken_by_a_tracker(folder):
    sequence = ceres_ed.open_sequence(str(folder), last=1)
    tracker = ceres_ed.Tracker(sequence.camera)
    frames = list(sequence)
    del sequence
    for frame in frames:
        report = tracker.track(frame.depth, frame.color, number=frame.number)
    assert report.status == "tracked"


def test_options_select_frames(folder):
    assert ceres_ed.open_sequence(folder, first=1, step=2).numbers == [1, 3]
    assert ceres_ed.open_sequence(folder, ceres_ed.SequenceOptions(color=False))[0].color is None
    with pytest.raises(TypeError, match="did you mean 'first'"):
        ceres_ed.open_sequence(folder, frist=1)
    with pytest.raises(ValueError, match="no such folder|there is no"):
        ceres_ed.open_sequence(folder / "missing")


def test_stereo_pictures_have_depth(tmp_path, run_app):
    run_app("ed_simulate", "plane", f"--output={tmp_path / 's'}", "--frames=1", "--stereo")
    sequence = ceres_ed.open_sequence(tmp_path / "s", depth_from="stereo")
    assert sequence.is_stereo
    assert (sequence[0].depth > 0).mean() > 0.3


def test_a_result_is_evaluated_as_by_the_program(folder, tmp_path, run_app):
    run_app("ed_slam", folder, f"--output={tmp_path / 'result'}", "--live_every=1")
    run_app("ed_eval", f"--sequence={folder}", f"--result={tmp_path / 'result'}",
            f"--report={tmp_path / 'eval.json'}")
    expected = json.loads((tmp_path / "eval.json").read_text())
    found = ceres_ed.evaluate_sequence(folder, tmp_path / "result")
    for name in ("truth", "camera", "depth", "tracks_2d", "log"):
        assert found[name] == expected[name], name
    assert found["truth"] is not None
    with pytest.raises(ValueError, match="missing"):
        ceres_ed.evaluate_sequence(folder, tmp_path / "missing")


def test_an_evaluation_of_a_pair_as_a_dict(plane, data, tmp_path, run_app):
    pair = data / "plane_bumps"
    run_app("ed_eval", pair / "source.ply", pair / "target.ply", f"--truth={pair / 'gt.ply'}",
            f"--report={tmp_path / 'eval.json'}")
    expected = json.loads((tmp_path / "eval.json").read_text())
    found = ceres_ed.evaluate(*plane, truth=pair / "gt.ply").as_dict()
    assert found
    for name, value in found.items():
        assert expected[name] == value, name
