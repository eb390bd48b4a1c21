// The colour of simulated tissue.
#ifndef CERES_ED_SIMULATION_TEXTURE_H_
#define CERES_ED_SIMULATION_TEXTURE_H_

#include <cstdint>

#include <Eigen/Core>

namespace ceres_ed {

// A colour for every point of space: mottles of 24 to 0.45 mm and dark, branching lines like
// vessels. Given the place of a tissue point at rest it moves and stretches with the tissue, and
// corner detectors find something at every distance.
class SyntheticTexture {
 public:
  explicit SyntheticTexture(std::uint64_t seed);

  // Returns red, green and blue in [0, 1]. `rest`: metres. `pixel` > 0: how many metres of tissue a
  // pixel covers; details that are too fine for it fade out, which keeps them from flickering.
  Eigen::Vector3d Color(const Eigen::Vector3d& rest, double pixel) const;

 private:
  double Noise(const Eigen::Vector3d& rest, double wavelength, std::uint32_t layer) const;
  double Lines(const Eigen::Vector3d& rest, double spacing, double pixel) const;

  std::uint32_t seed_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_TEXTURE_H_
