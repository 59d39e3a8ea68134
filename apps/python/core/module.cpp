// The compiled half of the Python package `boresight`.
#include "python/core/bindings.hpp"
#include "python/core/task.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace boresight::python;
  module.doc() = "The compiled half of boresight.";
  module.attr("__version__") = BORESIGHT_VERSION;
  watch_tasks();
  bind_errors(module);
  bind_mechanism(module);
  bind_run(module);
  bind_function(module);
  bind_verbs(module);
}
