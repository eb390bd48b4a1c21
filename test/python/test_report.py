"""FitResult.report(): the page and the picture of a fit."""
import pytest

import ceres_ed


@pytest.fixture(scope="module")
def result(plane):
    return ceres_ed.fit(*plane, levels=1, fine_steps=1)


def test_a_page_has_the_verdict_and_the_view(result, tmp_path):
    result.report(tmp_path / "fit.html")
    page = (tmp_path / "fit.html").read_text()
    assert "Verdict." in page
    assert 'id="scene"' in page or "without three.js" in page
    assert "true place" not in page.split("<script")[0]


def test_a_truth_gives_the_true_errors(result, plane, tmp_path):
    result.report(tmp_path / "fit.html", truth=plane[0])
    assert "distance to the true place" in (tmp_path / "fit.html").read_text()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_picture_is_a_png(result, tmp_path, theme):
    result.report(str(tmp_path / "fit.png"), theme=theme)
    assert (tmp_path / "fit.png").read_bytes().startswith(b"\x89PNG")


def test_what_cannot_be_written_is_an_error(result, plane, hill, tmp_path):
    with pytest.raises(ValueError, match="expected a name that ends in .html or .png"):
        result.report(tmp_path / "fit.pdf")
    with pytest.raises(ValueError, match="theme is 'grey', expected 'light' or 'dark'"):
        result.report(tmp_path / "fit.png", theme="grey")
    with pytest.raises(ValueError, match="truth has 400 points"):
        result.report(tmp_path / "fit.html", truth=hill)
    with pytest.raises(OSError, match="none"):
        result.report(tmp_path / "none" / "fit.html")


def test_finished_runs_of_tracking_have_a_page(run_app, tmp_path):
    run_app("ed_simulate", "heart", f"--output={tmp_path / 'heart'}", "--frames=3", "--quiet")
    run_app("ed_slam", tmp_path / "heart", f"--output={tmp_path / 'out'}", "--quiet")
    ceres_ed.report(tmp_path / "out", html=tmp_path / "slam.html", png=tmp_path / "slam.png")
    assert "distance to the true place" in (tmp_path / "slam.html").read_text()
    assert (tmp_path / "slam.png").read_bytes().startswith(b"\x89PNG")
    ceres_ed.report([tmp_path / "out", tmp_path / "out"], html=tmp_path / "both.html")
    assert "2 runs compared" in (tmp_path / "both.html").read_text()


def test_runs_that_cannot_be_shown_are_errors(tmp_path):
    with pytest.raises(ValueError, match="neither html nor png"):
        ceres_ed.report(tmp_path)
    with pytest.raises(ValueError, match="report.json"):
        ceres_ed.report(tmp_path, html=tmp_path / "page.html")
