// Points with names in Python.
#ifndef CERES_ED_PYTHON_LANDMARKS_H_
#define CERES_ED_PYTHON_LANDMARKS_H_

#include <ceres_ed/io/landmarks/landmark_file.h>

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// The class Landmarks: named points, and the file from which they were read.
struct Landmarks {
  std::vector<NamedLandmark> points;
  // In which space the positions are.
  AnatomicalSpace space = AnatomicalSpace::kUnknown;
  // Empty for points that came from arrays.
  std::string path;
  // The file, as it was read from `path`.
  LandmarkFile file;
};

// Returns landmarks from Landmarks, from {name: (x, y, z)}, or from the path of a file, whose
// columns of `side` are read. Raises a TypeError for anything else, a ValueError that names `what`
// for bad contents, and an OSError for a file that can't be read.
Landmarks ToNamedLandmarks(const pybind11::object& object,
                           const std::string& what,
                           LandmarkSide side);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_LANDMARKS_H_
