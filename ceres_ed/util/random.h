// Random numbers for simulation and tests.
#ifndef CERES_ED_UTIL_RANDOM_H_
#define CERES_ED_UTIL_RANDOM_H_

#include <cstdint>
#include <random>

namespace ceres_ed {

// A generator of random numbers that are the same on every platform. (The distributions of the
// standard library are not.)
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // Returns a number in (0, 1).
  double Uniform();
  // Returns a normally distributed number of mean 0 and standard deviation 1 (Box and Muller's
  // formula).
  double Gaussian();

 private:
  std::mt19937_64 engine_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_RANDOM_H_
