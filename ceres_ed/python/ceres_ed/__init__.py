"""Embedded-deformation graphs on Ceres Solver.

Fits one surface to another, applies the deformation to any cloud, and tracks tissue that deforms
under a moving depth camera:

    import ceres_ed

    result = ceres_ed.fit(ceres_ed.load("source.ply"), ceres_ed.load("target.ply"))
    result.warp.save("warp.json")
    ceres_ed.save("fitted.ply", result)

A surface is an (N, 3) array of points, a pair (points, triangles), a Cloud, a FitResult, a mesh or
cloud of trimesh or Open3D, or the path of a file.
"""
from . import _meshes, _notebook
from ._cohort import Cohort, fit_cohort
from ._core import (
    Camera, Cloud, DistanceStatistics, Energy, EnergyInfo, EnergyParameter, Evaluation, Field,
    FieldOptions, Finding, FitOptions, FitProgress, FitResult, Frame, FrameIterator, FrameReport,
    FrameSequence, Graph, GraphOptions, Landmarks, MapSnapshot, PointEnergy, SequenceOptions, ShapeChange, ShapeModel,
    SurfaceFitter, Tracker, TrackerOptions, Verdict, Warp, __version__, align_shapes, backend, compare_groups,
    evaluate, evaluate_sequence, fit_shape_model, list_energies, load, measure_shape_model,
    report, save)
from ._signatures import fit, open_sequence

__all__ = [
    "Camera", "Cloud", "Cohort", "DistanceStatistics", "Energy", "EnergyInfo", "EnergyParameter",
    "Evaluation", "Field", "FieldOptions", "Finding", "FitOptions", "FitProgress", "FitResult",
    "Frame", "FrameIterator", "FrameReport", "FrameSequence", "Graph", "GraphOptions", "Landmarks",
    "MapSnapshot", "PointEnergy", "SequenceOptions",
    "ShapeChange", "ShapeModel", "SurfaceFitter", "Tracker", "TrackerOptions", "Verdict", "Warp", "__version__",
    "align_shapes", "backend", "compare_groups", "evaluate", "evaluate_sequence", "fit", "fit_cohort",
    "fit_shape_model", "list_energies", "load", "measure_shape_model", "open_sequence", "report",
    "save"]
