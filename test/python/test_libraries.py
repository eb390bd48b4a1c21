"""Surfaces of trimesh and Open3D go in as they are."""
import importlib.util

import numpy as np
import pytest

import ceres_ed
from conftest import make_grid


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
    # Open3D 0.16 takes no arrays that cannot be written, such as views of results.
    fitted = mesh(result.points.copy(), result.triangles.copy())
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


# A texture of brightness on a plane that slides within itself: only the colours say by how much.
def colored_plane(shift=0.0):
    points, triangles = make_grid(n=40)
    gray = 0.5 + 0.25 * np.sin(12 * (points[:, 0] - shift)) + 0.2 * np.cos(9 * points[:, 1])
    return points, triangles, np.round(255 * np.tile(gray[:, None], (1, 3))).astype(np.uint8)


class ColoredTrimesh(TrimeshLike):
    """A mesh with colours of its vertices, as trimesh has them: RGBA below `visual`."""

    def __init__(self, points, triangles, colors, kind="vertex"):
        super().__init__(points, triangles)
        rgba = np.concatenate([colors, np.full((len(colors), 1), 255, np.uint8)], axis=1)
        self.visual = type("ColorVisuals", (), {"kind": kind, "vertex_colors": rgba})()


def colored(library, points, triangles, colors):
    if library == "the real open3d":
        return ceres_ed.Cloud(points, triangles, colors=colors).to_open3d()
    if library == "trimesh":
        return ColoredTrimesh(points, triangles, colors)
    if library == "open3d":
        return Open3dLike(vertices=points, triangles=triangles, vertex_normals=[],
                          vertex_colors=colors / 255.0)
    return ceres_ed.Cloud(points, triangles, colors=colors)


def test_colors_of_meshes_reach_the_photometric_energy(tmp_path):
    """The energy says nothing about clouds without colours, and what a PLY file says with them."""
    options = {"energies": "photometric:weight=20", "rigid_first": False, "levels": 1}
    for name, shift in (("source", 0.0), ("target", 0.03)):
        points, triangles, colors = colored_plane(shift)
        ceres_ed.save(tmp_path / f"{name}.ply",
                      ceres_ed.Cloud(points, triangles, colors=colors), double_precision=True)
    pair = ceres_ed.load(tmp_path / "source.ply"), ceres_ed.load(tmp_path / "target.ply")
    np.testing.assert_array_equal(pair[0].colors, colored_plane()[2])
    expected = ceres_ed.fit(*pair, **options)

    def residuals(result):
        return [term["residuals"] for term in result.terms if term["name"] == "photometric"]

    assert residuals(expected)[0] > 100
    assert not any(residuals(ceres_ed.fit(colored_plane()[:2], colored_plane(0.03)[:2], **options)))
    for library in ("trimesh", "open3d", "arrays", "the real open3d"):
        if library == "the real open3d" and importlib.util.find_spec("open3d") is None:
            continue
        result = ceres_ed.fit(colored(library, *colored_plane()),
                              colored(library, *colored_plane(0.03)), **options)
        assert residuals(result) == residuals(expected), library
        np.testing.assert_allclose(result.points, expected.points, atol=1e-12)
        np.testing.assert_array_equal(result.colors, colored_plane()[2])


def test_colors_that_are_not_there_are_not_made_up():
    points, triangles, colors = colored_plane()
    assert ceres_ed.Cloud(ColoredTrimesh(points, triangles, colors, kind=None)).colors is None
    with pytest.warns(UserWarning, match="texture.*to_color"):
        assert ceres_ed.Cloud(ColoredTrimesh(points, triangles, colors, kind="texture")).colors is None
    assert ceres_ed.Cloud(points).colors is None


@pytest.mark.parametrize("colors, message", [
    (np.zeros((3, 3), np.uint8), r"has shape \(3, 3\), expected \(1600, 3\)"),
    (np.full((1600, 3), 2.0), r"outside \[0, 1\] in row 0"),
    (np.zeros((1600, 3), np.int32), "expected an array of uint8, or of floats"),
    (np.zeros(1600), "has shape")])
def test_colors_that_cannot_be_used_say_so(colors, message):
    with pytest.raises(ValueError, match=message):
        ceres_ed.Cloud(*colored_plane()[:2], colors=colors)


def test_what_is_not_installed_is_named(monkeypatch):
    cloud = ceres_ed.Cloud(np.eye(3))
    for name in ("trimesh", "open3d"):
        monkeypatch.setitem(__import__("sys").modules, name, None)
        with pytest.raises(ImportError, match=f"needs the package {name}"):
            getattr(cloud, f"to_{name}")()
        with pytest.raises(TypeError, match=f"expected a mesh or cloud of {name}"):
            getattr(ceres_ed.Cloud, f"from_{name}")(np.eye(3))


def test_there_and_back_with_trimesh():
    trimesh = pytest.importorskip("trimesh")
    points, triangles, colors = colored_plane()
    mesh = ceres_ed.Cloud(points, triangles, colors=colors).to_trimesh()
    assert isinstance(mesh, trimesh.Trimesh)
    again = ceres_ed.Cloud.from_trimesh(mesh)
    for name in ("points", "triangles", "colors"):
        np.testing.assert_array_equal(getattr(again, name), (dict(
            points=points, triangles=triangles, colors=colors))[name])
    cloud = ceres_ed.Cloud(points, colors=colors).to_trimesh()
    assert isinstance(cloud, trimesh.PointCloud)
    np.testing.assert_array_equal(ceres_ed.Cloud.from_trimesh(cloud).colors, colors)
    assert ceres_ed.Cloud(trimesh.Trimesh(points, triangles, process=False)).colors is None
    assert ceres_ed.Cloud(trimesh.PointCloud(points)).colors is None
    result = ceres_ed.fit(mesh, landmarks={0: points[0]}).to_trimesh()
    np.testing.assert_array_equal(result.visual.vertex_colors[:, :3], colors)


def test_there_and_back_with_open3d():
    o3d = pytest.importorskip("open3d")
    points, triangles, colors = colored_plane()
    up = np.tile([0.0, 0, 1], (len(points), 1))
    for faces, kind in ((triangles, o3d.geometry.TriangleMesh), (None, o3d.geometry.PointCloud)):
        cloud = ceres_ed.Cloud(points, faces, normals=up, colors=colors)
        mesh = cloud.to_open3d()
        assert isinstance(mesh, kind)
        again = ceres_ed.Cloud.from_open3d(mesh)
        for name in ("points", "normals", "colors"):
            np.testing.assert_array_equal(getattr(again, name), getattr(cloud, name))
