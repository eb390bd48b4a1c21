#include "ceres_ed/io/field/rigid_file.h"

#include <ceres_ed/io/atomic_file.h>
#include <ceres_ed/io/field/header_text.h>

namespace ceres_ed {
namespace {

Eigen::Matrix3d LinearPart(const Similarity& similarity) {
  return similarity.scale * similarity.rotation.toRotationMatrix();
}

}  // namespace

Status WriteMatrixFile(const std::string& path, const Similarity& b_from_a) {
  const Eigen::Matrix3d linear = LinearPart(b_from_a);
  std::string text;
  for (int r = 0; r < 3; ++r) {
    text += HeaderText(linear.row(r)) + " " + NumberText(b_from_a.translation[r]) + "\n";
  }
  return WriteFileAtomically(path, text + "0 0 0 1\n");
}

Status WriteItkTransformFile(const std::string& path,
                             const Similarity& transform,
                             const std::string& description) {
  const Eigen::Matrix3d linear = LinearPart(transform);
  std::string text = "#Insight Transform File V1.0\n# " + description +
                     "\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters:";
  for (int r = 0; r < 3; ++r) text += " " + HeaderText(linear.row(r));
  text += " " + HeaderText(transform.translation) + "\nFixedParameters: 0 0 0\n";
  return WriteFileAtomically(path, text);
}

}  // namespace ceres_ed
