"""Arrays go in as they come, and out without copies."""
import gc

import numpy as np
import pytest

import ceres_ed


def shares_memory(a, b):
    return np.shares_memory(a, b)


def test_cloud_keeps_what_it_was_given(grid):
    points, triangles = grid
    cloud = ceres_ed.Cloud(points, triangles)
    np.testing.assert_array_equal(cloud.points, points)
    np.testing.assert_array_equal(cloud.triangles, triangles)
    assert cloud.normals is None
    assert len(cloud) == len(points)
    assert cloud.points.dtype == np.float64 and cloud.triangles.dtype == np.int32


def test_views_share_memory_and_outlive_the_cloud(grid):
    cloud = ceres_ed.Cloud(*grid)
    points = cloud.points
    assert shares_memory(points, cloud.points)
    del cloud
    gc.collect()
    np.testing.assert_array_equal(points, grid[0])


def test_views_cannot_be_written(grid):
    # An index that does not exist, or a coordinate that is not finite, would reach the library.
    cloud = ceres_ed.Cloud(*grid, normals=grid[0] + 1, colors=np.zeros((len(grid[0]), 3)))
    for view in (cloud.points, cloud.triangles, cloud.normals, cloud.colors):
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 1
        with pytest.raises(ValueError, match="WRITEABLE"):
            view.flags.writeable = True


@pytest.mark.parametrize("change", [
    lambda a: a.astype(np.float32),
    lambda a: np.asfortranarray(a),
    lambda a: np.repeat(a, 2, axis=0)[::2],
    lambda a: a[:, ::-1].copy()[:, ::-1],
    lambda a: a.astype(">f8"),
    lambda a: a.tolist(),
    lambda a: [tuple(row) for row in a],
], ids=["float32", "fortran", "strided", "reversed", "big-endian", "lists", "tuples"])
def test_any_array_of_numbers_is_taken(grid, change):
    points = np.round(grid[0] * 64) / 64  # exact in float32, too
    cloud = ceres_ed.Cloud(change(points))
    np.testing.assert_array_equal(cloud.points, points)


def test_read_only_arrays_are_taken_and_left_alone(grid):
    points, triangles = (array.copy() for array in grid)
    points.flags.writeable = False
    triangles.flags.writeable = False
    cloud = ceres_ed.Cloud(points, triangles)
    assert cloud.points.flags.owndata is False
    np.testing.assert_array_equal(points, grid[0])


@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint8, np.uint64])
def test_triangles_may_be_any_integers(kind):
    cloud = ceres_ed.Cloud(np.eye(3), np.array([[0, 1, 2]], dtype=kind))
    np.testing.assert_array_equal(cloud.triangles, [[0, 1, 2]])


def test_normals_are_brought_to_unit_length():
    cloud = ceres_ed.Cloud(np.eye(3), normals=[[0, 0, 5], [0, 0, 0], [np.nan, 0, 1]])
    np.testing.assert_array_equal(cloud.normals, [[0, 0, 1], [0, 0, 0], [0, 0, 0]])


@pytest.mark.parametrize("points, message", [
    (np.zeros((4, 2)), r"points has shape \(4, 2\), expected \(N, 3\)"),
    (np.zeros(3), r"points has shape \(3,\), expected \(N, 3\)"),
    (np.zeros((2, 3, 3)), r"\(2, 3, 3\)"),
    ([[0, 0, 0], [0, np.nan, 0]], "row 1, expected finite numbers"),
    ([[np.inf, 0, 0]], "row 0, expected finite numbers"),
    (np.zeros((4, 3), dtype=complex), "complex128, expected real numbers"),
    ([["a", "b", "c"]], "expected real numbers"),
    (object(), "is <class 'object'>, expected a surface: an .* array of points.* the path of a file"),
], ids=["columns", "flat", "cube", "nan", "inf", "complex", "text", "object"])
def test_bad_points_are_value_errors(points, message):
    with pytest.raises(ValueError, match=message):
        ceres_ed.Cloud(points)


@pytest.mark.parametrize("triangles, message", [
    ([[0, 1, 3]], "names point 3 in row 0, there are 3"),
    ([[0, 1, -1]], "names point -1"),
    ([[0, 1]], r"shape \(1, 2\), expected \(M, 3\)"),
    ([[0.0, 1.0, 2.0]], "float64, expected integers"),
])
def test_bad_triangles_are_value_errors(triangles, message):
    with pytest.raises(ValueError, match=message):
        ceres_ed.Cloud(np.eye(3), triangles)


def test_triangles_with_a_repeated_corner_are_left_out():
    with pytest.warns(UserWarning, match="1 with a repeated corner"):
        cloud = ceres_ed.Cloud(np.eye(3), [[0, 1, 2], [0, 0, 2]])
    np.testing.assert_array_equal(cloud.triangles, [[0, 1, 2]])


def test_a_pair_of_points_is_no_pair_of_arrays():
    # A tuple of two rows: points, and no triangles.
    cloud = ceres_ed.Cloud(((0.0, 1.0, 2.0), (3.0, 4.0, 5.0)))
    np.testing.assert_array_equal(cloud.points, [[0, 1, 2], [3, 4, 5]])


def test_files_come_back_as_they_were(data, tmp_path):
    cloud = ceres_ed.load(data / "dolphin_bend/source.ply")
    copy = tmp_path / "copy.ply"
    ceres_ed.save(copy, cloud)
    assert copy.read_bytes() == (data / "dolphin_bend/source.ply").read_bytes()
    ceres_ed.save(copy, (cloud.points, cloud.triangles), double_precision=True)
    again = ceres_ed.load(str(copy))
    np.testing.assert_array_equal(again.points, cloud.points)
    np.testing.assert_array_equal(again.triangles, cloud.triangles)


def test_files_that_cannot_be_used_say_why(tmp_path):
    with pytest.raises(FileNotFoundError, match="missing.ply"):
        ceres_ed.load(tmp_path / "missing.ply")
    with pytest.raises(IsADirectoryError):
        ceres_ed.load(tmp_path)
    bad = tmp_path / "bad.ply"
    bad.write_text("no ply\n")
    with pytest.raises(ValueError, match="bad.ply"):
        ceres_ed.load(bad)
    with pytest.raises(OSError, match="nowhere"):
        ceres_ed.save(tmp_path / "nowhere/out.ply", np.eye(3))
    with pytest.raises(TypeError):
        ceres_ed.load(3.5)


def test_like_must_have_as_many_points(data, tmp_path):
    cloud = ceres_ed.load(data / "dolphin_bend/source.ply")
    with pytest.raises(ValueError, match="expected as many"):
        ceres_ed.save(tmp_path / "out.ply", np.eye(3), like=cloud)
