// What the module is made of, one function a file.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "boresight/io/document.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight::python {

void bind_errors(pybind11::module_& module);
void bind_mechanism(pybind11::module_& module);
void bind_histories(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_function(pybind11::module_& module);
void bind_verbs(pybind11::module_& module);

// {"clearance.F1.radial": "0.2 mm"}, in the order given. Values that are no text are written with all their digits.
std::vector<Setting> settings_of(const pybind11::dict& settings);

// A number of SI, or a text with its unit, for the number at this path; what its mechanism does not take is an InputError.
double value_for(const Mechanism& mechanism, const std::string& path, const pybind11::handle& value);

// The numbers of one run, with the mechanism whose paths name them.
struct NamedParameters {
  std::shared_ptr<const Mechanism> mechanism;
  Parameters values;
};

}  // namespace boresight::python
