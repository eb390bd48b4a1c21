#include "ceres_ed/geometry/pinhole_camera.h"

#include <cmath>
#include <sstream>

namespace ceres_ed {

bool PinholeCamera::IsValid(std::string* error) const {
  const auto refuse = [error](const char* name, double value, const char* expected) {
    std::ostringstream message;
    message << name << " is " << value << ", expected " << expected;
    *error = message.str();
    return false;
  };
  if (!std::isfinite(fx) || fx <= 0.0) return refuse("fx", fx, "a focal length > 0 pixels");
  if (!std::isfinite(fy) || fy <= 0.0) return refuse("fy", fy, "a focal length > 0 pixels");
  if (!std::isfinite(cx)) return refuse("cx", cx, "a finite number of pixels");
  if (!std::isfinite(cy)) return refuse("cy", cy, "a finite number of pixels");
  if (width <= 0) return refuse("width", width, "a width > 0 pixels");
  if (height <= 0) return refuse("height", height, "a height > 0 pixels");
  return true;
}

}  // namespace ceres_ed
