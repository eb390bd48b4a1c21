// The oracle where ITK is not installed.
#include <gtest/gtest.h>
#include <test/field/itk_oracle.h>

namespace ceres_ed {

bool HaveItk() { return false; }

std::vector<ItkPoint> MapByItk(const std::string& path, const std::vector<ItkPoint>& points) {
  ADD_FAILURE() << "no ITK for " << path;
  return points;
}

ItkGrid ReadGridByItk(const std::string& path) {
  ADD_FAILURE() << "no ITK for " << path;
  return {};
}

void WriteImageByItk(const std::string& path, const ItkGrid& /*grid*/) {
  ADD_FAILURE() << "no ITK for " << path;
}

ItkPoint ResampleBallByItk(const std::string& path,
                           const ItkGrid& /*grid*/,
                           const ItkPoint& center,
                           double /*radius*/) {
  ADD_FAILURE() << "no ITK for " << path;
  return center;
}

}  // namespace ceres_ed
