#include "ceres_ed/util/random.h"

#include <cmath>

namespace ceres_ed {
namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

double Random::Uniform() {
  // The upper 53 bits, moved by half a step so that the result is never 0.
  return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1.0p-53;
}

double Random::Gaussian() {
  // Two statements are needed, since the compiler may choose the order of two calls within one
  // expression.
  const double first = Uniform();
  const double second = Uniform();
  return std::sqrt(-2.0 * std::log(first)) * std::cos(2.0 * kPi * second);
}

}  // namespace ceres_ed
