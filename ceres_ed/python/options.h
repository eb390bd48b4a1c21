// Options in Python: attributes of an object, and keywords of the functions that take it.
#ifndef CERES_ED_PYTHON_OPTIONS_H_
#define CERES_ED_PYTHON_OPTIONS_H_

#include <ceres_ed/util/nearest_word.h>
#include <ceres_ed/util/options.h>

#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

namespace py = pybind11;

// The class of an Options struct. It has an attribute for each row of its table that is not
// internal.
template <typename Options>
class OptionsClass {
 public:
  OptionsClass(py::module_& module, const char* name, const char* doc)
      : class_(module, name, doc), name_(name) {
    class_.def(py::init([name = name_](const py::kwargs& changes) {
                 Options options;
                 Apply(name, changes, &options);
                 return options;
               }),
               "Takes the options that differ from their defaults.");
    class_.def("__repr__", [name = name_](const py::object& self) {
      std::string text;
      for (const py::handle option : self.attr("names")) {
        text += (text.empty() ? "" : ", ") + std::string(py::str(option)) + "=" +
                std::string(py::repr(self.attr(option)));
      }
      return name + "(" + text + ")";
    });
    class_.def("__copy__", [](const Options& self) { return self; });
    class_.def(
        "copy", [](const Options& self) { return self; }, "Returns a copy.");
    py::list names;
    for (const Row& row : Options::Rows()) {
      if (row.option.group == OptionGroup::kInternal) continue;
      AddAttribute(row);
      names.append(row.option.name);
    }
    class_.attr("names") = py::tuple(names);
  }

  // Sets the options that `changes` names. Raises a TypeError that lists the known options for
  // another name.
  static void Apply(const std::string& caller, const py::kwargs& changes, Options* options) {
    if (changes.empty()) return;
    const py::object self = py::cast(options, py::return_value_policy::reference);
    const py::tuple names = self.attr("names");
    for (const auto& [name, value] : changes) {
      if (!names.contains(name)) {
        throw py::type_error(caller + "() knows no '" + std::string(py::str(name)) + "'" +
                             Suggestion(std::string(py::str(name))) + "; its options are " +
                             std::string(py::str(", ").attr("join")(names).cast<std::string>()));
      }
      py::setattr(self, name, value);
    }
  }

 private:
  using Row = typename OptionTable<Options>::OneRow;

  static std::string Suggestion(const std::string& misspelt) {
    std::vector<std::string> known;
    for (const Row& row : Options::Rows()) {
      if (row.option.group != OptionGroup::kInternal) known.push_back(row.option.name);
    }
    const std::string nearest = NearestWord(misspelt, known);
    return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
  }

  // Adds an attribute with the type of the member. Tables live as long as the module.
  void AddAttribute(const Row& row) {
    Options defaults;
    const OptionField field = row.field(&defaults);
    const Row* kept = &row;
    if (std::holds_alternative<NamedField>(field)) {
      class_.def_property(
          row.option.name.c_str(),
          [kept](Options& options) { return OptionText(kept->field(&options)); },
          [kept](Options& options, const std::string& name) { SetName(*kept, name, &options); },
          TextOf(row, py::cast(OptionText(field))).c_str());
      return;
    }
    std::visit(
        [&](auto member) {
          using Member = decltype(member);
          if constexpr (std::is_pointer_v<Member>) {
            using Value = std::remove_pointer_t<Member>;
            class_.def_property(
                row.option.name.c_str(),
                [kept](Options& options) { return *std::get<Member>(kept->field(&options)); },
                [kept](Options& options, Value value) {
                  *std::get<Member>(kept->field(&options)) = value;
                },
                TextOf(row, py::cast(*member)).c_str());
          }
        },
        field);
  }

  static void SetName(const Row& row, const std::string& name, Options* options) {
    const auto field = std::get<NamedField>(row.field(options));
    if (field.set(field.value, name)) return;
    throw py::value_error(row.option.name + " is '" + name + "', expected '" +
                          field.list("' or '") + "'");
  }

  // Returns the docstring: the sentence of the row, the values that are allowed, the unit and the
  // default.
  static std::string TextOf(const Row& row, const py::object& value) {
    Options defaults;
    const OptionField field = row.field(&defaults);
    std::string text = row.option.doc;
    if (const auto* named = std::get_if<NamedField>(&field)) {
      text += " One of '" + named->list("', '") + "'.";
    } else if (!std::holds_alternative<bool*>(field) &&
               !std::holds_alternative<std::string*>(field)) {
      text += " " + ExpectedText(row.option, field) +
              (row.option.unit.empty() ? "." : ", " + row.option.unit + ".");
    }
    return text + " Default: " + std::string(py::repr(value)) + ".";
  }

  py::class_<Options> class_;
  std::string name_;
};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_OPTIONS_H_
