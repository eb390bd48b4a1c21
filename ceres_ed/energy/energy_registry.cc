#include "ceres_ed/energy/energy_registry.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace ceres_ed {
namespace {

const EnergyParameter* FindParameter(const EnergyInfo& info, const std::string& name) {
  for (const EnergyParameter& parameter : info.parameters) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

std::string JoinParameterNames(const EnergyInfo& info) {
  std::string names;
  for (const EnergyParameter& parameter : info.parameters) {
    names += (names.empty() ? "" : ", ") + parameter.name;
  }
  return names.empty() ? "none" : names;
}

Status CheckValue(const EnergyInfo& info, const EnergyParameter& parameter, double value) {
  const bool whole = parameter.type == ParameterType::kReal || value == std::floor(value);
  if (std::isfinite(value) && value >= parameter.minimum && value <= parameter.maximum && whole) {
    return Status::Ok();
  }
  std::ostringstream message;
  message << "energy '" << info.name << "': parameter " << parameter.name << "=" << value
          << ", expected "
          << (parameter.type == ParameterType::kReal ? "a number" : "a whole number") << " in ["
          << parameter.minimum << ", " << parameter.maximum << "]";
  return Status::Error(message.str());
}

bool IsSnakeCase(const std::string& name) {
  return !name.empty() && name[0] >= 'a' && name[0] <= 'z' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

}  // namespace

StatusOr<ParameterValues> ParameterValues::Create(const EnergyInfo& info,
                                                  const std::map<std::string, double>& given) {
  ParameterValues values;
  for (const EnergyParameter& parameter : info.parameters) {
    values.values_[parameter.name] = parameter.default_value;
  }
  for (const auto& [name, value] : given) {
    const EnergyParameter* parameter = FindParameter(info, name);
    if (parameter == nullptr) {
      return Status::Error("energy '" + info.name + "' has no parameter '" + name +
                           "'; it knows: " + JoinParameterNames(info) +
                           "; every energy knows: weight, loss, loss_width");
    }
    if (Status status = CheckValue(info, *parameter, value); !status.ok()) return status;
    values.values_[name] = value;
  }
  return values;
}

double ParameterValues::Get(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) {
    throw std::invalid_argument("asks for parameter '" + name + "', which it has not declared");
  }
  read_.insert(name);
  return found->second;
}

Status EnergyRegistry::Register(EnergyInfo info, Factory factory) {
  CHECK(factory) << "energy '" << info.name << "' has no factory";
  if (!IsSnakeCase(info.name)) {
    return Status::Error("energy name '" + info.name + "': expected snake_case (a-z, 0-9, _)");
  }
  if (Find(info.name) != nullptr) {
    return Status::Error("energy '" + info.name + "' is registered already");
  }
  std::set<std::string> names{"weight", "loss", "loss_width"};
  for (const EnergyParameter& parameter : info.parameters) {
    if (!names.insert(parameter.name).second) {
      return Status::Error("energy '" + info.name + "': parameter '" + parameter.name +
                           "' is there twice, or is one that every energy has");
    }
    Status status = CheckValue(info, parameter, parameter.default_value);
    if (!status.ok()) return status;
  }
  if (info.origin.empty()) info.origin = origin_;
  const std::string name = info.name;
  entries_[name] = Entry{std::move(info), std::move(factory)};
  return Status::Ok();
}

std::vector<const EnergyInfo*> EnergyRegistry::List() const {
  std::vector<const EnergyInfo*> infos;
  for (const auto& [name, entry] : entries_) infos.push_back(&entry.info);
  return infos;
}

const EnergyInfo* EnergyRegistry::Find(const std::string& name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? nullptr : &found->second.info;
}

StatusOr<std::unique_ptr<EnergyTerm>> EnergyRegistry::Create(
    const std::string& name, const std::map<std::string, double>& parameters) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) {
    std::string known;
    for (const auto& [known_name, entry] : entries_) {
      known += (known.empty() ? "" : ", ") + known_name;
    }
    return Status::Error("no energy '" + name + "'; known: " + known);
  }
  const EnergyInfo& info = found->second.info;
  const StatusOr<ParameterValues> values = ParameterValues::Create(info, parameters);
  if (!values.ok()) return values.status();
  const std::string energy = DescribeEnergy(name, info.origin);
  std::unique_ptr<EnergyTerm> term;
  try {
    term = found->second.factory(*values);
    if (term == nullptr) return Status::Error(energy + ": its factory made nothing");
    if (term->kind() != info.kind) {
      return Status::Error(energy + ": its term is not of the kind that it is registered as");
    }
  } catch (const std::exception& error) {
    return Status::Error(energy + ": " + error.what());
  } catch (...) {
    return Status::Error(energy + ": its factory threw something that is no std::exception");
  }
  for (const auto& [parameter, value] : parameters) {
    if (values->WasRead(parameter)) continue;
    std::string used;
    for (const EnergyParameter& known : info.parameters) {
      if (values->WasRead(known.name)) used += (used.empty() ? "" : ", ") + known.name;
    }
    return Status::Error(energy + ": parameter '" + parameter +
                         "' has no use; it uses: " + (used.empty() ? "none" : used));
  }
  return term;
}

}  // namespace ceres_ed
