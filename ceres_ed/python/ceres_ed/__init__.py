"""Embedded-deformation graphs on Ceres Solver.

Fits one surface to another, applies the deformation to any cloud, and tracks tissue that deforms
under a moving depth camera:

    import ceres_ed

    result = ceres_ed.fit(ceres_ed.load("source.ply"), ceres_ed.load("target.ply"))
    result.warp.save("warp.json")
    ceres_ed.save("fitted.ply", result)

A surface is an (N, 3) array of points, a pair (points, triangles), a Cloud, a FitResult, or a mesh
or cloud of trimesh or Open3D.
"""
from ._core import (
    Camera, Cloud, DistanceStatistics, Energy, EnergyInfo, EnergyParameter, Evaluation, Finding,
    FitOptions, FitProgress, FitResult, FrameReport, Graph, GraphOptions, MapSnapshot, ShapeChange, Tracker,
    TrackerOptions, Verdict, Warp, __version__, backend, evaluate, fit, list_energies, load, save)

__all__ = [
    "Camera", "Cloud", "DistanceStatistics", "Energy", "EnergyInfo", "EnergyParameter",
    "Evaluation", "Finding", "FitOptions", "FitProgress", "FitResult", "FrameReport", "Graph", "GraphOptions",
    "MapSnapshot", "ShapeChange", "Tracker", "TrackerOptions", "Verdict", "Warp", "__version__",
    "backend",
    "evaluate", "fit", "list_energies", "load", "save"]
