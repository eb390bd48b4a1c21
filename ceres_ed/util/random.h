// Random numbers for simulation and tests.
#ifndef CERES_ED_UTIL_RANDOM_H_
#define CERES_ED_UTIL_RANDOM_H_

#include <cstdint>
#include <random>

namespace ceres_ed {

// Random numbers that are the same on every platform (the standard's distributions are not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // Returns a number in (0, 1).
  double Uniform();
  // Returns a number of mean 0 and deviation 1, by Box and Muller's formula.
  double Gaussian();

 private:
  std::mt19937_64 engine_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_RANDOM_H_
