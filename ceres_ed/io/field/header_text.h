// Numbers in the headers of fields.
#ifndef CERES_ED_IO_FIELD_HEADER_TEXT_H_
#define CERES_ED_IO_FIELD_HEADER_TEXT_H_

#include <ceres_ed/util/options.h>

#include <string>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the numbers with the fewest digits from which the same bits are read back, with
// `separator` between them.
inline std::string HeaderText(const Eigen::Vector3d& vector, const char* separator = " ") {
  return NumberText(vector.x()) + separator + NumberText(vector.y()) + separator +
         NumberText(vector.z());
}

}  // namespace ceres_ed

#endif  // CERES_ED_IO_FIELD_HEADER_TEXT_H_
