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

// A path and a value of settings as --set takes them. Numbers of numpy are written as those of Python are.
Setting setting_of(const py::handle& path, const py::handle& value) {
  if (!py::isinstance<py::str>(path))
    throw InputError({}, "settings", py::repr(path).cast<std::string>(),
                     "a path as a text, such as \"motion.duration\"");
  const std::string name = path.cast<std::string>();
  if (value.is_none()) throw InputError({}, name, "None", "a number, a text with its unit, or what else --set takes");
  if (py::isinstance<py::bool_>(value)) return {name, value.cast<bool>() ? "true" : "false"};
  if (py::isinstance<py::str>(value)) return {name, value.cast<std::string>()};
  if (PyFloat_Check(value.ptr())) return {name, py::repr(py::float_(value.cast<double>())).cast<std::string>()};
  return {name, py::repr(value).cast<std::string>()};
}

double number_of(const py::handle& value, const std::string& si_unit) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    throw ValueFault(py::repr(value).cast<std::string>(),
                     si_unit == "1" ? "a number" : "a number of " + si_unit + ", or a text with its unit");
  }
}

// A float; of a path whose numbers differ a tuple of each, which may be set again.
py::object named_value(const NamedParameters& p, const std::string& path) {
  const std::vector<double> values = ParameterPath(p.mechanism->description(), path).values(p.values);
  if (values.size() == 1) return py::float_(values.front());
  return py::tuple(py::cast(values));
}

bool is_list(const py::object& value) {
  return py::isinstance<py::tuple>(value) || py::isinstance<py::list>(value) ||
         (py::isinstance<py::array>(value) && value.cast<py::array>().ndim() > 0);
}

void set_named_value(NamedParameters& p, const std::string& path, const py::object& value) {
  const ParameterPath place(p.mechanism->description(), path);
  std::vector<double> values;
  // What is there already may be what its law does not read, and no value that it would take.
  if (const py::object now = named_value(p, path); value.get_type().is(now.get_type()) && value.equal(now)) return;
  if (!is_list(value))
    values.push_back(value_for(*p.mechanism, path, value));
  else
    for (const py::handle& one : value) values.push_back(value_for(*p.mechanism, path, one));
  if (!place.set(p.values, values))
    throw InputError({}, path, std::to_string(values.size()) + " values",
                     place.count() == 1 ? "one" : "one, or " + std::to_string(place.count()));
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
  for (const auto& [path, value] : settings) set.push_back(setting_of(path, value));
  return set;
}

double value_for(const Mechanism& mechanism, const std::string& path, const py::handle& value) {
  const FunctionInput input = inputs_named(mechanism, {path}).front();
  try {
    double number = 0.0;
    if (!py::isinstance<py::str>(value))
      number = number_of(value, input.told_unit());
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
      "    p[\"clearance.*.radial\"] = \"0.1 mm\"   # of all joints\n\n"
      "A path of several numbers that differ, such as the moduli of two materials, has a tuple of them, and takes one "
      "value\n"
      "for all or as many as there are.\n")
      .def("__getitem__", &named_value, py::arg("path"))
      .def("__setitem__", &set_named_value, py::arg("path"), py::arg("value"))
      .def("copy", [](const NamedParameters& p) { return p; })
      .def(
          "as_dict",
          [](const NamedParameters& p) {
            py::dict all;
            for (const std::string& path : parameter_paths(p.mechanism->description()))
              all[py::str(path)] = named_value(p, path);
            return all;
          },
          "All of them: {path: value in SI}.")
      .def("__repr__", [](const NamedParameters& p) { return "<Parameters of \"" + p.mechanism->name() + "\">"; });
}

}  // namespace boresight::python
