"""Surfaces of trimesh and Open3D go in as they are."""
import numpy as np
import pytest

import ceres_ed


class TrackedArray(np.ndarray):
    """What trimesh keeps arrays in: a subclass of ndarray that notes changes."""


class TrimeshLike:
    """The attributes of trimesh.Trimesh that are looked at, computed when asked for as there."""

    def __init__(self, points, triangles):
        self._points, self._triangles = points, triangles

    @property
    def vertices(self):
        return self._points.view(TrackedArray)

    @property
    def faces(self):
        return self._triangles.astype(np.int64).view(TrackedArray)

    @property
    def vertex_normals(self):
        raise AssertionError("normals of a mesh are not asked for")


def test_a_mesh_of_trimesh(grid, hill):
    expected = ceres_ed.fit(grid, hill)
    result = ceres_ed.fit(TrimeshLike(*grid), TrimeshLike(*hill))
    np.testing.assert_array_equal(result.points, expected.points)
    np.testing.assert_array_equal(result.triangles, grid[1])
    np.testing.assert_array_equal(result.warp.apply(TrimeshLike(*grid)), expected.warp.apply(grid))
    assert ceres_ed.evaluate(result, TrimeshLike(*hill)).symmetric.mean < 0.01


def test_a_mesh_of_the_real_trimesh(grid):
    trimesh = pytest.importorskip("trimesh")
    cloud = ceres_ed.Cloud(trimesh.Trimesh(*grid, process=False))
    np.testing.assert_array_equal(cloud.points, grid[0])
    np.testing.assert_array_equal(cloud.triangles, grid[1])
    np.testing.assert_array_equal(ceres_ed.Cloud(trimesh.PointCloud(grid[0])).points, grid[0])


class Open3dLike:
    """A mesh or a cloud of Open3D, with vectors that are no arrays and may be empty."""

    class Vector(list):
        pass

    def __init__(self, **vectors):
        for name, rows in vectors.items():
            setattr(self, name, self.Vector(np.asarray(rows).tolist()))


def test_what_has_the_attributes_of_open3d(grid):
    points, triangles = grid
    up = np.tile([0.0, 0, 1], (len(points), 1))
    mesh = ceres_ed.Cloud(Open3dLike(vertices=points, triangles=triangles, vertex_normals=[]))
    np.testing.assert_array_equal(mesh.triangles, triangles)
    assert mesh.normals is None
    cloud = ceres_ed.Cloud(Open3dLike(points=points, normals=up, colors=[]))
    np.testing.assert_array_equal(cloud.points, points)
    np.testing.assert_array_equal(cloud.normals, up)
    assert cloud.triangles is None


def test_the_real_open3d(grid, hill):
    o3d = pytest.importorskip("open3d")

    def mesh(points, triangles):
        return o3d.geometry.TriangleMesh(o3d.utility.Vector3dVector(points),
                                         o3d.utility.Vector3iVector(triangles.astype(np.int32)))
    expected = ceres_ed.fit(grid, hill)
    result = ceres_ed.fit(mesh(*grid), mesh(*hill))
    np.testing.assert_array_equal(result.points, expected.points)
    # And back.
    fitted = mesh(result.points, result.triangles)
    np.testing.assert_array_equal(np.asarray(fitted.vertices), expected.points)
    with_normals = mesh(*hill)
    with_normals.compute_vertex_normals()
    np.testing.assert_allclose(ceres_ed.Cloud(with_normals).normals,
                               np.asarray(with_normals.vertex_normals), atol=1e-15)
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(hill[0]))
    np.testing.assert_array_equal(ceres_ed.Cloud(cloud).points, hill[0])
    np.testing.assert_array_equal(ceres_ed.Cloud(cloud.points).points, hill[0])


def test_what_is_no_surface_says_so():
    with pytest.raises(ValueError, match="target is .*dict"):
        ceres_ed.fit(np.eye(4)[:, :3], {"a": 1})
