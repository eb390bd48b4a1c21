#include "ceres_ed/report/view/point_moments.h"

#include <algorithm>
#include <cmath>

namespace ceres_ed {

int PointMoments::MomentAt(double at) const {
  return static_cast<int>(std::lround(std::clamp(at, 0.0, 1.0) * (count - 1)));
}

double PointMoments::AtOf(int moment) const {
  return count > 1 ? static_cast<double>(moment) / (count - 1) : 1.0;
}

}  // namespace ceres_ed
