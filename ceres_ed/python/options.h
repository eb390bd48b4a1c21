// Options as Python has them: attributes of an object, and keywords of the functions that take it.
#ifndef CERES_ED_PYTHON_OPTIONS_H_
#define CERES_ED_PYTHON_OPTIONS_H_

#include <cstddef>
#include <string>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

namespace py = pybind11;

// A value of an enum and its name: the one that the programs' flags have for it.
template <typename T>
struct Choice {
  const char* name;
  T value;
};

// The class of an Options struct. Each option is declared once, with a function that returns a
// reference to its field: name, default and text of everything else follow from that.
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
               "Defaults, but for the options that are named.");
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
        "copy", [](const Options& self) { return self; }, "An equal object of its own.");
  }

  // Ends the declaration.
  ~OptionsClass() { class_.attr("names") = py::tuple(names_); }
  OptionsClass(const OptionsClass&) = delete;
  OptionsClass& operator=(const OptionsClass&) = delete;

  // A number or a flag.
  template <typename Field>
  OptionsClass& Add(const char* name, Field field, const char* doc) {
    using Value = std::decay_t<decltype(field(std::declval<Options&>()))>;
    return AddProperty(
        name,
        [field](Options& options) { return field(options); },
        [field](Options& options, Value value) { field(options) = value; },
        doc);
  }

  // One of a few names. `choices` must be static.
  template <typename Field, typename T, std::size_t kSize>
  OptionsClass& Add(const char* name,
                    Field field,
                    const Choice<T> (&choices)[kSize],
                    const char* doc) {
    const Choice<T>* begin = choices;
    return AddProperty(
        name,
        [field, begin](Options& options) -> std::string {
          for (std::size_t i = 0; i < kSize; ++i) {
            if (begin[i].value == field(options)) return begin[i].name;
          }
          throw py::value_error("an option has no name");
        },
        [field, begin, name](Options& options, const std::string& value) {
          std::string known;
          for (std::size_t i = 0; i < kSize; ++i) {
            if (value == begin[i].name) {
              field(options) = begin[i].value;
              return;
            }
            known += (i > 0 ? " or '" : "'") + std::string(begin[i].name) + "'";
          }
          throw py::value_error(std::string(name) + " is '" + value + "', expected " + known);
        },
        doc);
  }

  // Sets the options that `changes` names; TypeError, with the known ones, on another name.
  static void Apply(const std::string& caller, const py::kwargs& changes, Options* options) {
    if (changes.empty()) return;
    const py::object self = py::cast(options, py::return_value_policy::reference);
    const py::tuple names = self.attr("names");
    for (const auto& [name, value] : changes) {
      if (!names.contains(name)) {
        throw py::type_error(caller + "() knows no '" + std::string(py::str(name)) +
                             "'; its options are " +
                             std::string(py::str(", ").attr("join")(names).cast<std::string>()));
      }
      py::setattr(self, name, value);
    }
  }

 private:
  template <typename Get, typename Set>
  OptionsClass& AddProperty(const char* name, Get get, Set set, const char* doc) {
    Options defaults;
    const std::string text =
        std::string(doc) + " Default: " + std::string(py::repr(py::cast(get(defaults)))) + ".";
    class_.def_property(name, get, set, text.c_str());
    names_.append(name);
    return *this;
  }

  py::class_<Options> class_;
  std::string name_;
  py::list names_;
};

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_OPTIONS_H_
