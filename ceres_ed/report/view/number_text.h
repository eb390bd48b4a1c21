// Numbers as people read them.
#ifndef CERES_ED_REPORT_VIEW_NUMBER_TEXT_H_
#define CERES_ED_REPORT_VIEW_NUMBER_TEXT_H_

#include <string>
#include <vector>

namespace ceres_ed {

// Returns `value` with `digits` significant digits and without an exponent where a magnitude allows
// it: "0.0123", "1.5e-07", "12300". A number that is not finite is "-".
std::string ShortNumber(double value, int digits = 3);

// Returns a number at the tick of an axis, with as few digits as it needs: "0.02", "5e-05".
std::string TickText(double value);

// Returns between 2 and about `count` round numbers at equal distances that lie in [low, high];
// only `low` if the range is empty. Both must be finite.
std::vector<double> RoundTicks(double low, double high, int count);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_NUMBER_TEXT_H_
