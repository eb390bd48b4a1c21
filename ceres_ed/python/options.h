// Options in Python: attributes of an object, and keywords of the functions that take it.
#ifndef CERES_ED_PYTHON_OPTIONS_H_
#define CERES_ED_PYTHON_OPTIONS_H_

#include <ceres_ed/util/nearest_word.h>
#include <ceres_ed/util/options.h>

#include <set>
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
  // Rows that `left_out` names are no attributes.
  OptionsClass(py::module_& module,
               const char* name,
               const char* doc,
               const std::set<std::string>& left_out = {})
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
    class_.def(py::pickle(&StateOf, [name = name_](const py::dict& state) {
      Options options;
      Apply(name, py::kwargs(py::reinterpret_borrow<py::kwargs>(state)), &options);
      return options;
    }));
    class_.def(
        "copy", [](const Options& self) { return self; }, "Returns a copy.");
    py::list names;
    py::dict words;
    for (const Row& row : Options::Rows()) {
      if (row.option.group == OptionGroup::kInternal) continue;
      if (left_out.count(row.option.name) > 0) continue;
      AddAttribute(row);
      names.append(row.option.name);
      for (const SpecialValue& special : row.option.specials)
        words[py::str(row.option.name)] = WordOf(special);
    }
    class_.attr("names") = py::tuple(names);
    class_.attr("words") = words;
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
                             Suggestion(std::string(py::str(name)), names) + "; its options are " +
                             std::string(py::str(", ").attr("join")(names).cast<std::string>()));
      }
      py::setattr(self, name, value);
    }
  }

 private:
  using Row = typename OptionTable<Options>::OneRow;

  // Returns all options by name.
  static py::dict StateOf(const py::object& self) {
    py::dict state;
    for (const py::handle name : self.attr("names")) state[name] = self.attr(name);
    return state;
  }

  // The word for a special value, without what is said about it.
  static std::string WordOf(const SpecialValue& special) {
    return special.word.substr(0, special.word.find(':'));
  }

  // Returns the value of an option. A number may also be given by the word for a special value and,
  // as on the command line, by the number that stands for it (0 threads are all of the machine).
  template <typename Value>
  static Value ToValue(const Row& row, const py::object& object) {
    if constexpr (std::is_same_v<Value, bool>) {
      // Anything is true or false in Python, also 'no'.
      if (py::isinstance<py::str>(object)) ThrowWrongType(row, object);
    }
    for (const SpecialValue& special : row.option.specials) {
      const bool is_word =
          py::isinstance<py::str>(object) && object.cast<std::string>() == WordOf(special);
      if constexpr (std::is_arithmetic_v<Value>) {
        if (is_word) return static_cast<Value>(special.value);
      }
    }
    try {
      auto value = object.cast<Value>();
      if constexpr (std::is_arithmetic_v<Value>) {
        for (const SpecialValue& special : row.option.specials) {
          if (static_cast<double>(value) != special.on_flag) continue;
          return static_cast<Value>(special.value);
        }
      }
      return value;
    } catch (const py::cast_error&) {
      ThrowWrongType(row, object);
    }
  }

  [[noreturn]] static void ThrowWrongType(const Row& row, const py::object& object) {
    Options defaults;
    const OptionField field = row.field(&defaults);
    std::string expected = ExpectedOnFlag(row.option, field);
    if (std::holds_alternative<bool*>(field)) expected = "True or False";
    if (std::holds_alternative<std::string*>(field)) expected = "a str";
    throw py::type_error(row.option.name + " is " + std::string(py::repr(object)) + ", expected " +
                         expected);
  }

  static std::string Suggestion(const std::string& misspelt, const py::tuple& names) {
    std::vector<std::string> known;
    for (const py::handle name : names) known.push_back(name.cast<std::string>());
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
          [kept](Options& options, const py::object& name) {
            if (!py::isinstance<py::str>(name)) ThrowWrongType(*kept, name);
            SetName(*kept, name.cast<std::string>(), &options);
          },
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
                [kept](Options& options, const py::object& value) {
                  *std::get<Member>(kept->field(&options)) = ToValue<Value>(*kept, value);
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
      text += " " + ExpectedOnFlag(row.option, field) +
              (row.option.unit.empty() ? "." : ", " + row.option.unit + ".");
    }
    return text + " Default: " + std::string(py::repr(value)) + ".";
  }

  py::class_<Options> class_;
  std::string name_;
};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_OPTIONS_H_
