// Mechanisms from files and texts, and the numbers of a run by their paths.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstdio>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/keys/parameter_unit.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/function/function_input.hpp"
#include "python/core/bindings.hpp"

namespace py = pybind11;

namespace boresight::python {
namespace {

using Shared = std::shared_ptr<const Mechanism>;

std::shared_ptr<Mechanism> from_file(const std::string& file, const py::dict& settings) {
  const std::vector<Setting> set = settings_of(settings);
  const py::gil_scoped_release release;
  return std::make_shared<Mechanism>(read_mechanism(file, set));
}

std::shared_ptr<Mechanism> from_text(const std::string& text, const std::string& name, const py::dict& settings) {
  const std::vector<Setting> set = settings_of(settings);
  const py::gil_scoped_release release;
  return std::make_shared<Mechanism>(read_mechanism_text(text, name, set));
}

template <typename List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& element : list) names.push_back(element.name);
  return names;
}

std::vector<std::string> clearance_names(const Mechanism& m) {
  std::vector<std::string> names;
  for (const auto& clearance : m.description().clearances)
    names.push_back(m.description().joints[clearance.joint].name);
  return names;
}

}  // namespace

std::vector<Setting> settings_of(const py::dict& settings) {
  std::vector<Setting> set;
  for (const auto& [path, value] : settings) {
    std::string text;
    if (py::isinstance<py::bool_>(value))
      text = value.cast<bool>() ? "true" : "false";
    else
      text = py::isinstance<py::str>(value) ? value.cast<std::string>() : py::repr(value).cast<std::string>();
    set.push_back({path.cast<std::string>(), text});
  }
  return set;
}

double value_for(const Mechanism& mechanism, const std::string& path, const py::handle& value) {
  const FunctionInput input = inputs_named(mechanism, {path}).front();
  try {
    double number = 0.0;
    if (!py::isinstance<py::str>(value))
      number = value.cast<double>();
    else if (const auto text = value.cast<std::string>(); input.si_unit != "1")
      number = parse_quantity(text, unit_of_parameters(mechanism.description(), {path}, input.si_unit));
    else if (!parse_number(text, number))
      throw ValueFault("\"" + text + "\"", "a number");
    check_value(input, number);
    return number;
  } catch (const ValueFault& fault) {
    throw InputError({}, path, fault.found, fault.expected, fault.nearest);
  }
}

void bind_mechanism(py::module_& module) {
  py::class_<Mechanism, std::shared_ptr<Mechanism>>(
      module, "Mechanism",
      "A mechanism: bodies, joints, drives and play, read, checked, and never changed after.\n\n"
      "    m = Mechanism(\"antenna/mechanism.toml\", {\"clearance.elevation.radial\": \"0.06 mm\"})\n")
      .def(py::init(&from_file), py::arg("file"), py::arg("settings") = py::dict(),
           "Reads a mechanism file. settings: values that replace those of the file, by their paths, as --set does.\n"
           "Raises InputError with file, line, key, what was found and what was expected.")
      .def_static("from_text", &from_text, py::arg("text"), py::arg("name") = "mechanism.toml",
                  py::arg("settings") = py::dict(),
                  "The same from a text in the file's format (TOML). name: what errors call it.")
      .def_property_readonly("name", [](const Mechanism& m) { return m.name(); })
      .def_property_readonly(
          "file", [](const Mechanism& m) { return m.description().origin.file; },
          "What it was read from, as it was named.")
      .def_property_readonly(
          "content_hash", [](const Mechanism& m) { return m.description().content_hash; },
          "Of file and settings, as in summary.json.")
      .def_property_readonly("duration", &Mechanism::duration, "Of its motion [s].")
      .def_property_readonly("bodies", [](const Mechanism& m) { return names_of(m.description().bodies); })
      .def_property_readonly("joints", [](const Mechanism& m) { return names_of(m.description().joints); })
      .def_property_readonly("clearances", &clearance_names, "The joints that have play.")
      .def_property_readonly(
          "errors", [](const Mechanism& m) { return names_of(m.description().errors); },
          "Its standing errors; the path of each is error.NAME.")
      .def_property_readonly(
          "paths", [](const Mechanism& m) { return parameter_paths(m.description()); },
          "Every number that may be varied, by its path: \"clearance.F1.radial\", ...")
      .def(
          "unit",
          [](const Mechanism& m, const std::string& path) {
            const ParameterPath place(m.description(), path);
            return names_scales(m.description(), path) ? std::string("1") : place.unit();
          },
          py::arg("path"), "The SI unit of the number at this path; \"1\" of a pure number.")
      .def(
          "parameters",
          [](const std::shared_ptr<Mechanism>& m) {
            return NamedParameters{m, m->parameters()};
          },
          "Its numbers as the file gives them, to change and to run with.")
      .def("__repr__", [](const Mechanism& m) {
        return "<Mechanism \"" + m.name() + "\": " + std::to_string(m.bodies()) + " bodies, " +
               std::to_string(m.joints()) + " joints, " + std::to_string(m.clearances()) + " with play>";
      });

  py::class_<NamedParameters>(
      module, "Parameters",
      "Numbers of a mechanism by their paths, in SI. Setting takes a number of SI, or a text with its unit:\n\n"
      "    p = m.parameters()\n"
      "    p[\"clearance.F1.radial\"] = 1e-4      # or \"0.1 mm\"\n"
      "    p[\"clearance.*.radial\"] = \"0.1 mm\"   # of all joints\n")
      .def(
          "__getitem__",
          [](const NamedParameters& p, const std::string& path) {
            return ParameterPath(p.mechanism->description(), path).get(p.values);
          },
          py::arg("path"))
      .def(
          "__setitem__",
          [](NamedParameters& p, const std::string& path, const py::object& value) {
            ParameterPath(p.mechanism->description(), path).set(p.values, value_for(*p.mechanism, path, value));
          },
          py::arg("path"), py::arg("value"))
      .def("copy", [](const NamedParameters& p) { return p; })
      .def(
          "as_dict",
          [](const NamedParameters& p) {
            py::dict all;
            for (const std::string& path : parameter_paths(p.mechanism->description()))
              all[py::str(path)] = ParameterPath(p.mechanism->description(), path).get(p.values);
            return all;
          },
          "All of them: {path: value in SI}.")
      .def("__repr__", [](const NamedParameters& p) { return "<Parameters of \"" + p.mechanism->name() + "\">"; });
}

}  // namespace boresight::python
