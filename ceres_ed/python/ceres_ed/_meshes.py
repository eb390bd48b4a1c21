"""Conversions to and from meshes and clouds of trimesh and Open3D."""
import importlib
from typing import Any, Union

import numpy as np

from . import _core


def _library(name: str, caller: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"{caller}() needs the package {name} (pip install {name})") from error


def to_trimesh(self: "Union[_core.Cloud, _core.FitResult]") -> Any:
    """Returns a copy as trimesh.Trimesh, or as trimesh.PointCloud if there are no triangles.

    Points keep their order and number; colours are those of the vertices. Raises an ImportError if
    trimesh is not installed.
    """
    trimesh = _library("trimesh", "to_trimesh")
    colors = None if self.colors is None else np.array(self.colors)
    if self.triangles is None:
        return trimesh.PointCloud(np.array(self.points), colors=colors)
    normals = None if self.normals is None else np.array(self.normals)
    # Without process=False it would merge and reorder vertices.
    return trimesh.Trimesh(np.array(self.points), np.array(self.triangles), vertex_normals=normals,
                           vertex_colors=colors, process=False)


def to_open3d(self: "Union[_core.Cloud, _core.FitResult]") -> Any:
    """Returns a copy as open3d.geometry.TriangleMesh, or PointCloud if there are no triangles.

    Normals and colours are kept. Raises an ImportError if Open3D is not installed.
    """
    o3d = _library("open3d", "to_open3d")
    vectors = o3d.utility.Vector3dVector
    points = vectors(np.array(self.points))
    normals = None if self.normals is None else vectors(np.array(self.normals))
    colors = None if self.colors is None else vectors(np.array(self.colors) / 255.0)
    if self.triangles is None:
        cloud = o3d.geometry.PointCloud(points)
        if normals is not None:
            cloud.normals = normals
        if colors is not None:
            cloud.colors = colors
        return cloud
    mesh = o3d.geometry.TriangleMesh(points, o3d.utility.Vector3iVector(np.array(self.triangles)))
    if normals is not None:
        mesh.vertex_normals = normals
    if colors is not None:
        mesh.vertex_colors = colors
    return mesh


def _from(mesh: Any, library: str) -> "_core.Cloud":
    # Classes of Open3D's tensors lie in open3d.cuda.pybind or open3d.cpu.pybind.
    if not any(kind.__module__.split(".")[0] == library for kind in type(mesh).__mro__):
        raise TypeError(f"mesh is {type(mesh)}, expected a mesh or cloud of {library}")
    return _core.Cloud(mesh)


def from_trimesh(mesh: Any) -> "_core.Cloud":
    """Returns the Cloud of a trimesh.Trimesh or trimesh.PointCloud, with the colours of its vertices.

    Normals are left out: trimesh computes them from the triangles, and so does the library. Raises a
    TypeError for anything else.
    """
    return _from(mesh, "trimesh")


def from_open3d(mesh: Any) -> "_core.Cloud":
    """Returns the Cloud of a TriangleMesh or PointCloud of Open3D, with its normals and colours.

    Meshes and clouds of tensors (open3d.t) are taken, too. Raises a TypeError for anything else.
    """
    return _from(mesh, "open3d")


_cloud: Any = _core.Cloud
_result: Any = _core.FitResult
for _kind in (_cloud, _result):
    _kind.to_trimesh = to_trimesh
    _kind.to_open3d = to_open3d
_cloud.from_trimesh = staticmethod(from_trimesh)
_cloud.from_open3d = staticmethod(from_open3d)
