// The colour of simulated tissue.
#ifndef CERES_ED_SIMULATION_TEXTURE_H_
#define CERES_ED_SIMULATION_TEXTURE_H_

#include <cstdint>

#include <Eigen/Core>

namespace ceres_ed {

// A colour for every point of space: mottles with wavelengths of 24 to 0.45 mm, and dark, branching
// lines like vessels. Because it is evaluated at the rest position of a tissue point, the texture
// moves and stretches with the tissue. Corner detectors find features in it at every distance.
class SyntheticTexture {
 public:
  explicit SyntheticTexture(std::uint64_t seed);

  // Returns red, green and blue in [0, 1]. `rest` is in metres. `pixel` > 0 is the size of a pixel
  // on the tissue in metres; details that are too fine for it fade out, which avoids flicker.
  Eigen::Vector3d Color(const Eigen::Vector3d& rest, double pixel) const;

 private:
  double Noise(const Eigen::Vector3d& rest, double wavelength, std::uint32_t layer) const;
  double Lines(const Eigen::Vector3d& rest, double spacing, double pixel) const;

  std::uint32_t seed_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_TEXTURE_H_
