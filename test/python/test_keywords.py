"""Options are keywords that completion and help see, and results show themselves."""
import inspect
import io
import os

import numpy as np
import pytest

import ceres_ed
from ceres_ed import _core

TAKERS = [(ceres_ed.fit, ceres_ed.FitOptions), (ceres_ed.Graph.build, ceres_ed.GraphOptions),
          (ceres_ed.Tracker, ceres_ed.TrackerOptions),
          (ceres_ed.SurfaceFitter, ceres_ed.FitOptions),
          (ceres_ed.open_sequence, ceres_ed.SequenceOptions), (ceres_ed.FitOptions, ceres_ed.FitOptions)]


@pytest.mark.parametrize("function, options", TAKERS)
def test_signatures_list_every_option_with_its_default(function, options):
    parameters = inspect.signature(function).parameters
    assert set(options.names) <= set(parameters)
    for name in options.names:
        assert parameters[name].kind is inspect.Parameter.KEYWORD_ONLY
        assert parameters[name].default == getattr(options(), name)


def test_help_names_what_it_takes():
    assert list(inspect.signature(ceres_ed.fit).parameters)[:3] == ["source", "target", "landmarks"]
    assert "node_spacing" in str(inspect.signature(ceres_ed.fit))
    assert "Returns: a FitResult" in inspect.getdoc(ceres_ed.fit)


@pytest.mark.parametrize("function", [
    lambda **options: ceres_ed.fit(np.eye(3), np.eye(3), **options),
    lambda **options: ceres_ed.Graph.build(np.eye(3), **options),
    lambda **options: ceres_ed.FitOptions(**options)])
def test_an_unknown_keyword_names_the_nearest(function):
    with pytest.raises(TypeError, match=r"no 'nod_spacing' \(did you mean 'node_spacing'\?\)"):
        function(nod_spacing=0.1)


@pytest.mark.parametrize("threads", [0, "auto"])
def test_all_threads_of_the_machine(grid, hill, threads):
    expected = ceres_ed.fit(grid, hill)
    result = ceres_ed.fit(grid, hill, threads=threads)
    np.testing.assert_array_equal(result.points, expected.points)
    assert ceres_ed.FitOptions(threads=threads).threads == os.cpu_count()
    assert ceres_ed.TrackerOptions(threads=threads).threads == os.cpu_count()
    np.testing.assert_array_equal(result.warp.apply(grid, threads=threads),
                                  result.warp.apply(grid))


def test_words_stand_for_special_values():
    for kind in (ceres_ed.FitOptions, ceres_ed.GraphOptions, ceres_ed.TrackerOptions):
        for name, word in kind.words.items():
            setattr(kind(), name, word)
    assert ceres_ed.FitOptions(time_limit_s="none").time_limit_s == float("inf")


CLASSES = [value for value in vars(_core).values() if inspect.isclass(value)]


@pytest.mark.parametrize("kind", CLASSES)
def test_every_class_has_a_repr(kind):
    assert "__repr__" in vars(kind)


def test_a_notebook_shows_a_table_and_a_picture(grid, hill):
    result = ceres_ed.fit(grid, hill)
    shown = result._repr_html_()
    for text in (result.status, result.verdict.grade, str(len(result.graph)), "seconds"):
        assert text in shown
    picture = result.picture(width=400)
    if picture:
        # The picture of the report: what PIL sees in it has the width and more than one colour.
        image = pytest.importorskip("PIL.Image").open(io.BytesIO(picture))
        assert image.width == 400 and len(image.convert("RGB").getcolors(1 << 20)) > 20
        assert result._repr_png_().startswith(b"\x89PNG")
        assert "data:image/png;base64," in shown
        assert len(shown) < 300_000
    else:
        assert "<img" not in shown and result._repr_png_() is None
    with pytest.raises(ValueError, match="width is 10, expected 200"):
        result.picture(width=10)
    assert "p95" in ceres_ed.evaluate(result, hill)._repr_html_()


def test_paths_are_taken_where_clouds_are(plane, data, tmp_path):
    source, target = data / "plane_bumps/source.ply", data / "plane_bumps/target.ply"
    expected = ceres_ed.fit(*plane)
    for result in (ceres_ed.fit(source, target), ceres_ed.fit(str(source), str(target))):
        np.testing.assert_array_equal(result.points, expected.points)
    assert ceres_ed.evaluate(result, target).symmetric.mean == \
        ceres_ed.evaluate(expected, plane[1]).symmetric.mean
    assert [f.code for f in result.checks] == [f.code for f in expected.checks]
    np.testing.assert_array_equal(result.warp.apply(source), result.warp.apply(plane[0]))
    ceres_ed.save(tmp_path / "a.ply", result, like=source)
    ceres_ed.save(tmp_path / "b.ply", result, like=plane[0])
    assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()
    with pytest.raises(FileNotFoundError, match="missing.ply"):
        ceres_ed.fit(tmp_path / "missing.ply", target)
    with pytest.raises(ValueError, match="target is <class 'set'>, expected a surface"):
        ceres_ed.fit(source, {1, 2})
