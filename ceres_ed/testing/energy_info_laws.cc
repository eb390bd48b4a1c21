#include "ceres_ed/testing/energy_info_laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace ceres_ed {
namespace {

class InfoLawChecker {
 public:
  InfoLawChecker(const EnergyRegistry& registry,
                 const EnergyInfo& info,
                 const std::map<std::string, double>& given)
      : registry_(registry), info_(info), given_(given) {}

  std::vector<std::string> Run() {
    CheckInfo();
    CheckParameters();
    return violations_;
  }

 private:
  template <typename... Parts>
  void Report(const Parts&... parts) {
    std::ostringstream sentence;
    (sentence << ... << parts);
    violations_.push_back(sentence.str());
  }

  void CheckInfo() {
    if (info_.summary.empty()) Report("it has no summary");
    if (info_.equation.empty()) Report("it has no equation");
    if (info_.unit.empty()) Report("its residual has no unit; use '-' where there is none");
    std::set<std::string> names{"weight", "loss", "loss_width"};
    for (const EnergyParameter& p : info_.parameters) {
      if (!names.insert(p.name).second) {
        Report("parameter '", p.name, "' is there twice, or is one that every energy has");
      }
      const bool snake_case =
          !p.name.empty() &&
          p.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
      if (!snake_case) Report("parameter '", p.name, "' is not snake_case");
      if (p.unit.empty()) Report("parameter '", p.name, "' has no unit; use '-' for none");
      if (p.doc.empty()) Report("parameter '", p.name, "' has no doc");
      if (!(p.minimum < p.maximum)) Report("parameter '", p.name, "' has an empty range");
    }
  }

  void CheckParameters() {
    for (const EnergyParameter& p : info_.parameters) {
      for (const double value : {p.minimum, p.maximum, p.default_value}) {
        CheckAccepted(p.name, value);
      }
      const double beyond = std::max(1.0, 0.1 * std::abs(p.maximum));
      CheckRefused(p.name, p.maximum + beyond);
      CheckRefused(p.name, p.minimum - std::max(1.0, 0.1 * std::abs(p.minimum)));
      CheckRefused(p.name, std::numeric_limits<double>::quiet_NaN());
      if (p.type != ParameterType::kReal) CheckRefused(p.name, p.minimum + 0.5);
    }
    CheckRefused("no_such_parameter", 1.0);
  }

  std::map<std::string, double> With(const std::string& parameter, double value) const {
    std::map<std::string, double> given = given_;
    given[parameter] = value;
    return given;
  }

  void CheckAccepted(const std::string& parameter, double value) {
    const std::map<std::string, double> given = With(parameter, value);
    const StatusOr<ParameterValues> values = ParameterValues::Create(info_, given);
    if (!values.ok()) {
      Report("a value of its range is refused: ", values.status().message());
    } else if (values->Get(parameter) != value) {
      Report("parameter ", parameter, "=", value, " arrives as ", values->Get(parameter));
    } else if (const auto energy = registry_.Create(info_.name, given); !energy.ok()) {
      Report("it cannot be created: ", energy.status().message());
    }
  }

  void CheckRefused(const std::string& parameter, double value) {
    if (registry_.Create(info_.name, With(parameter, value)).ok()) {
      Report("parameter ", parameter, "=", value, " is not refused");
    }
  }

  const EnergyRegistry& registry_;
  const EnergyInfo& info_;
  const std::map<std::string, double>& given_;
  std::vector<std::string> violations_;
};

}  // namespace

std::vector<std::string> CheckEnergyInfoLaws(const EnergyRegistry& registry,
                                             const EnergyInfo& info,
                                             const std::map<std::string, double>& given) {
  return InfoLawChecker(registry, info, given).Run();
}

}  // namespace ceres_ed
