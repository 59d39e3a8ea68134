// The index as a function of numbers: points, batches, slopes.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <thread>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/function_question.hpp"
#include "python/core/arrays.hpp"
#include "python/core/bindings.hpp"
#include "python/core/task.hpp"
#include "terminal/embedding.hpp"

namespace py = pybind11;

namespace boresight::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

struct Function {
  std::shared_ptr<const IndexFunction> of;
  std::string name, why;  // of the mechanism; of the rung
};

struct Batch {
  std::shared_ptr<const std::vector<Outcome>> outcomes;
  double cpu_seconds_in_all = 0.0;  // of the library, without what Python adds
};

int threads(int jobs) {
  if (jobs < 0 || jobs > 4096)
    throw InputError({}, "jobs", std::to_string(jobs), "0, for as many as there are cores, to 4096 threads");
  return jobs > 0 ? jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

std::vector<double> point_of(const Numbers& x) {
  if (x.ndim() > 1)
    throw InputError({}, "x", std::to_string(x.ndim()) + " dimensions", "one point, (d,); batch() takes (n, d)");
  return {x.data(), x.data() + x.size()};
}

RunOptions options_of(double step, const std::string& integrator, double tolerance, const std::string& formulation,
                      const std::string& stabilisation) {
  RunOptions run;
  run.step = step;
  run.integrator = integrator;
  run.tolerance = tolerance;
  run.formulation = formulation;
  run.stabilisation = stabilisation;
  return run;
}

Function of_mechanism(const std::shared_ptr<Mechanism>& mechanism, const std::vector<std::string>& inputs,
                      const std::string& index, const std::string& rung, const RunOptions& run) {
  check_rung_name(rung);
  if (inputs.empty()) throw InputError({}, "inputs", "none", "the path of at least one number that varies");
  const IndexChoice choice = app::index_named("index", index);
  check_line_of_sight(choice, *mechanism, {}, "index");
  const std::string name = rung == "auto" ? "multibody" : rung;
  app::check_run_options(run, name, *mechanism);
  return {std::make_shared<const IndexFunction>(mechanism, inputs_named(*mechanism, inputs),
                                                FunctionModel{.index = choice, .rung = name, .run = run}),
          mechanism->name(), rung == "auto" ? "it leaves out least" : "as asked"};
}

Function of_file(const std::string& file, const std::vector<std::string>& inputs, const std::string& index,
                 const std::string& rung, std::optional<double> accuracy, const py::dict& settings, int jobs,
                 const py::object& progress) {
  app::FunctionQuestion question;
  question.inputs = inputs;
  question.index = index;
  question.command.file = file;
  question.command.rung = rung;
  question.command.accuracy = accuracy;
  question.command.settings = settings_of(settings);
  question.command.jobs = threads(jobs);
  question.command.quiet = true;
  app::AskedFunction asked;
  Task task(progress);
  const app::Embedding host{.interrupted = [&] { return task.stop().load(); },
                            .progress = [&](double done, double total, const std::string& unit,
                                            const std::string& estimate) { task.tell(done, total, unit, estimate); },
                            .failed = [](const std::string&) {}};
  task.run([&] {
    const std::scoped_lock lock(one_at_a_time());
    const app::Embedded in(host);
    asked = app::read_function(question);
  });
  return {asked.function, asked.name, asked.rung.why};
}

double value_at(const Function& f, const Numbers& x) {
  const std::vector<double> point = point_of(x);
  Outcome outcome;
  Task task(py::none{});
  task.run([&] { outcome = f.of->at(point, task.stop()); });
  if (outcome.status == Outcome::Status::failed) throw ComputationError(outcome.message);
  return outcome.value;
}

py::array gradient_at(const Function& f, const Numbers& x) {
  const std::vector<double> point = point_of(x);
  std::vector<double> by;
  Task task(py::none{});
  task.run([&] { by = f.of->slopes_at(point).by; });
  const auto n = static_cast<py::ssize_t>(by.size());
  return owned(std::move(by), {n});
}

Batch batch_at(const Function& f, const Numbers& x, int jobs, const py::object& progress) {
  if (x.ndim() != 2)
    throw InputError({}, "x", std::to_string(x.ndim()) + " dimensions", "an array (n, d), a point a row");
  std::vector<std::vector<double>> points;
  for (py::ssize_t k = 0; k < x.shape(0); ++k) points.emplace_back(x.data(k, 0), x.data(k, 0) + x.shape(1));
  auto outcomes = std::make_shared<std::vector<Outcome>>();
  double seconds = 0.0;
  Task task(progress);
  task.run([&] {
    const std::clock_t start = std::clock();
    std::size_t landed = 0;
    *outcomes = f.of->at_all(points, {.jobs = threads(jobs),
                                      .interrupted = [&] { return task.stop().load(); },
                                      .landed =
                                          [&](std::size_t, const Outcome&) {
                                            task.tell(static_cast<double>(++landed), static_cast<double>(points.size()),
                                                      "points");
                                          }});
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  });
  return {outcomes, seconds};
}

py::array of_outcomes(const Batch& b, double Outcome::*field) {
  return column(b.outcomes, *b.outcomes, b.outcomes->empty() ? nullptr : &(b.outcomes->front().*field));
}

void bind_batch(py::module_& module) {
  py::class_<Batch>(module, "Batch",
                    "What a function gave at many points. Arrays cannot be written to; none is a copy.")
      .def_property_readonly(
          "values", [](const Batch& b) { return of_outcomes(b, &Outcome::value); },
          "The index at each point, (n,) [SI]; NaN where the motion could not be followed.")
      .def_property_readonly(
          "cpu_seconds", [](const Batch& b) { return of_outcomes(b, &Outcome::cpu_seconds); }, "(n,)")
      .def_readonly("cpu_seconds_in_all", &Batch::cpu_seconds_in_all,
                    "Of the process while the library computed, preparation included [s].")
      .def_property_readonly(
          "model_error", [](const Batch& b) { return of_outcomes(b, &Outcome::model_error); },
          "What the rung thinks it leaves out, relative, (n,).")
      .def_property_readonly(
          "messages",
          [](const Batch& b) {
            py::dict all;
            for (std::size_t k = 0; k < b.outcomes->size(); ++k)
              if (!(*b.outcomes)[k].message.empty()) all[py::int_(k)] = (*b.outcomes)[k].message;
            return all;
          },
          "{place: why it failed, or what was done that it did not}.")
      .def("__len__", [](const Batch& b) { return b.outcomes->size(); });
}

}  // namespace

void bind_function(py::module_& module) {
  bind_batch(module);
  py::class_<Function>(
      module, "Function",
      "The index of a mechanism's motion as a function of d of its numbers, all in SI.\n\n"
      "    f = Function(m, [\"clearance.F1.radial\", \"payload.mass\"], index=\"boresight_error.rms\", "
      "rung=\"perturbation\")\n"
      "    f([1e-4, 20.0])                # a number [rad]\n"
      "    f.batch(samples).values        # samples (n, 2), values (n,)\n"
      "    f.gradient([1e-4, 20.0])       # exact, (2,)\n\n"
      "scipy.optimize takes f itself, and f.gradient as jac; boresight.openturns(f) is an OpenTURNS Function.")
      .def(py::init([](const std::shared_ptr<Mechanism>& mechanism, const std::vector<std::string>& inputs,
                       const std::string& index, const std::string& rung, double step, const std::string& integrator,
                       double tolerance, const std::string& formulation, const std::string& stabilisation) {
             return of_mechanism(mechanism, inputs, index, rung,
                                 options_of(step, integrator, tolerance, formulation, stabilisation));
           }),
           py::arg("mechanism"), py::arg("inputs"), py::kw_only(), py::arg("index") = "position_error.max",
           py::arg("rung") = "auto", py::arg("step") = 0.0, py::arg("integrator") = "", py::arg("tolerance") = 0.0,
           py::arg("formulation") = "", py::arg("stabilisation") = "",
           "inputs: the paths of the numbers that vary. On the perturbation rung several points share a SIMD register\n"
           "where the index and the contact laws have that, unless a step or an integrator is named.")
      .def_static("from_file", &of_file, py::arg("file"), py::arg("inputs") = std::vector<std::string>(), py::kw_only(),
                  py::arg("index") = "", py::arg("rung") = "auto", py::arg("accuracy") = py::none(),
                  py::arg("settings") = py::dict(), py::arg("jobs") = 0, py::arg("progress") = py::none(),
                  "Of a study: its inputs are what [[random]] scatters, and its values those of `boresight montecarlo` "
                  "for the\n"
                  "same samples, to the last bit. Of a mechanism file, with inputs named. accuracy: relative, chooses "
                  "the rung.")
      .def_property_readonly(
          "inputs",
          [](const Function& f) {
            std::vector<std::string> names;
            for (const FunctionInput& input : f.of->inputs()) names.push_back(input.name());
            return names;
          },
          "The paths of what varies; the first of those that take one value.")
      .def_property_readonly(
          "units",
          [](const Function& f) {
            std::vector<std::string> units;
            for (const FunctionInput& input : f.of->inputs()) units.push_back(input.told_unit());
            return units;
          },
          "Of the inputs.")
      .def_property_readonly(
          "nominal",
          [](const Function& f) {
            std::vector<double> point = f.of->nominal();
            const auto n = static_cast<py::ssize_t>(point.size());
            return owned(std::move(point), {n});
          },
          "The point of the file, or the medians of the study, (d,). Raises InputError where an input sets numbers\n"
          "alike that differ in the file: no point is that of the file then.")
      .def_property_readonly(
          "sizes",
          [](const Function& f) {
            std::vector<double> sizes;
            for (const FunctionInput& input : f.of->inputs()) {
              double& largest = sizes.emplace_back(0.0);
              for (const double value : input.nominal) largest = std::max(largest, std::abs(value));
            }
            const auto n = static_cast<py::ssize_t>(sizes.size());
            return owned(std::move(sizes), {n});
          },
          "How large each input is in the file, or its median in the study, (d,): the largest of numbers that it sets\n"
          "alike. A scale for steps.")
      .def_property_readonly("index", [](const Function& f) { return f.of->model().index.text(); })
      .def_property_readonly(
          "unit", [](const Function& f) { return f.of->model().index.si_unit(); }, "Of the index.")
      .def_property_readonly("rung", [](const Function& f) { return f.of->model().rung; })
      .def_readonly("why_rung", &Function::why)
      .def_property_readonly(
          "why_no_gradient", [](const Function& f) { return f.of->why_no_slopes(); },
          "Why it has none anywhere; \"\": points may have one.")
      .def("__call__", &value_at, py::arg("x"),
           "The index at one point (d,) [SI]. Raises InputError, ComputationError.")
      .def("gradient", &gradient_at, py::arg("x"),
           "Exact slopes at one point, (d,) [SI], through the impacts of the perturbation rung's motion. Raises "
           "ComputationError\n"
           "where there are none, and says why: impacts part neighbouring motions before the end, or another rung was "
           "asked for.")
      .def("batch", &batch_at, py::arg("x"), py::kw_only(), py::arg("jobs") = 0, py::arg("progress") = py::none(),
           "The index at n points, an array (n, d). jobs: threads; 0: as many as there are cores.\n"
           "progress(done, total, unit, estimate): called ten times a second; what it raises ends the batch.")
      .def("__repr__", [](const Function& f) {
        return "<Function " + f.of->model().index.text() + " [" + f.of->model().index.si_unit() + "] of " +
               std::to_string(f.of->inputs().size()) + " numbers of \"" + f.name + "\", " + f.of->model().rung + ">";
      });
}

}  // namespace boresight::python
