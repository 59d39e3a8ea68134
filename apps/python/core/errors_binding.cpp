// C++ exceptions as those of boresight/_errors.py, with file, line, key, found and expected where they are of an input.
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight_analyses/runs/parallel_evaluation.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/study/pilot.hpp"
#include "python/core/bindings.hpp"
#include "results/output_directory.hpp"

namespace py = pybind11;

namespace boresight::python {
namespace {

void raise(const char* name, const std::string& message) {
  const py::object type = py::module_::import("boresight._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(message).ptr());
}

void raise_input(const std::string& message, const Origin& origin, const std::string& key, const std::string& found,
                 const std::string& expected, const std::string& nearest) {
  const py::object type = py::module_::import("boresight._errors").attr("InputError");
  const py::object error = type(message);
  error.attr("file") = origin.file;
  error.attr("line") = origin.line;
  error.attr("key") = key;
  error.attr("found") = found;
  error.attr("expected") = expected;
  error.attr("nearest") = nearest;
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& e) {
      raise_input(e.what(), e.origin, e.key, e.found, e.expected, e.nearest);
    } catch (const OptionRefused& e) {
      raise_input(e.what(), {}, e.option, e.found, e.expected, e.nearest);
    } catch (const ComputationError& e) {
      raise("ComputationError", e.what());
    } catch (const app::OutputDirectoryError& e) {
      raise("ResultsError", e.what());
    } catch (const app::WriteError& e) {
      raise("ResultsError", e.what());
    } catch (const StoreRefused& e) {
      raise("ResultsError", e.what());
    } catch (const StoreFailed& e) {
      raise("ResultsError", e.what());
    } catch (const Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    } catch (const PilotInterrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    } catch (const EvaluationInterrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
}

}  // namespace boresight::python
