// The energies that a program knows, by name.
#ifndef CERES_ED_ENERGY_ENERGY_REGISTRY_H_
#define CERES_ED_ENERGY_ENERGY_REGISTRY_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/util/status.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {

// Values of all parameters of one energy: the given ones, checked, and defaults for the rest.
class ParameterValues {
 public:
  // `given` must name parameters of `info` and be in their ranges; the error lists the known ones.
  static StatusOr<ParameterValues> Create(const EnergyInfo& info,
                                          const std::map<std::string, double>& given);

  // The value of a parameter that the energy has declared. Any other name throws
  // std::invalid_argument, which EnergyRegistry::Create turns into its error.
  double Get(const std::string& name) const;
  bool GetFlag(const std::string& name) const { return Get(name) != 0.0; }

  // Whether anyone has asked for the value.
  bool WasRead(const std::string& name) const { return read_.count(name) != 0; }

 private:
  std::map<std::string, double> values_;
  mutable std::set<std::string> read_;
};

// An explicit object: no singleton, nothing registers itself.
class EnergyRegistry {
 public:
  using Factory = std::function<std::unique_ptr<EnergyTerm>(const ParameterValues&)>;

  // Error: the name is taken or not snake_case, a parameter is there twice or has a name that every
  // energy has (weight, loss, loss_width), or its default is out of its range.
  Status Register(EnergyInfo info, Factory factory);

  // What energies that are registered from now on get as their EnergyInfo::origin.
  void SetOrigin(std::string origin) { origin_ = std::move(origin); }

  // All energies in the order of their names.
  std::vector<const EnergyInfo*> List() const;

  // Null where there is none of this name.
  const EnergyInfo* Find(const std::string& name) const;

  // A term with its parameters set. Error: unknown energy or parameter, value out of range, a given
  // parameter that the factory did not ask for, a factory that throws or makes a term of another
  // kind than it says.
  StatusOr<std::unique_ptr<EnergyTerm>> Create(
      const std::string& name, const std::map<std::string, double>& parameters) const;

 private:
  struct Entry {
    EnergyInfo info;
    Factory factory;
  };
  std::map<std::string, Entry> entries_;
  std::string origin_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_REGISTRY_H_
