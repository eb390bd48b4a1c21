// The energies of a program, by name.
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

// The values of all parameters of one energy: the given ones, which are checked, and the defaults
// of the others.
class ParameterValues {
 public:
  // Returns the values. The result is an error if `given` has a name that is not a parameter of
  // `info` (the error lists the known ones) or a value that is out of range.
  static StatusOr<ParameterValues> Create(const EnergyInfo& info,
                                          const std::map<std::string, double>& given);

  // Returns the value of a parameter that the energy has declared. Any other name throws
  // std::invalid_argument, which EnergyRegistry::Create() turns into its error.
  double Get(const std::string& name) const;
  // Does the same for a flag: returns whether the value is not 0.
  bool GetFlag(const std::string& name) const { return Get(name) != 0.0; }

  // Returns whether the value was read.
  bool WasRead(const std::string& name) const { return read_.count(name) != 0; }

 private:
  std::map<std::string, double> values_;
  mutable std::set<std::string> read_;
};

// A set of energies by name. It is an explicit object: there is no singleton, and nothing registers
// itself.
class EnergyRegistry {
 public:
  // Creates a term from the values of its parameters.
  using Factory = std::function<std::unique_ptr<EnergyTerm>(const ParameterValues&)>;

  // Adds an energy. Returns an error if its name is taken or is not snake_case, if a parameter
  // occurs twice or has a name that every energy has (weight, loss, loss_width), or if a default is
  // out of range.
  Status Register(EnergyInfo info, Factory factory);

  // Sets the EnergyInfo::origin of all energies that are registered from now on.
  void SetOrigin(std::string origin) { origin_ = std::move(origin); }

  // Returns the descriptions of all energies, sorted by name.
  std::vector<const EnergyInfo*> List() const;

  // Returns the description of an energy, or null if there is none of this name.
  const EnergyInfo* Find(const std::string& name) const;

  // Returns a term with the given parameters. Returns an error for an unknown energy or parameter,
  // for a value out of range, for a given parameter that the factory did not read, and for a
  // factory that throws, returns null, or makes a term of another kind than its description says.
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

// Returns a new registry with the energies of catalogue/.
EnergyRegistry BuiltinEnergies();

// Adds these energies to `registry`. Fails a CHECK if one of their names is taken, so call it
// before energies of your own are registered.
void RegisterBuiltinEnergies(EnergyRegistry* registry);

}  // namespace ceres_ed

#endif  // CERES_ED_ENERGY_ENERGY_REGISTRY_H_
