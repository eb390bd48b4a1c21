// The declarations that the header of an Options struct needs for its rows (options.h).
#ifndef CERES_ED_UTIL_OPTIONS_FWD_H_
#define CERES_ED_UTIL_OPTIONS_FWD_H_

namespace ceres_ed {

template <typename Options>
class OptionTable;

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_OPTIONS_FWD_H_
