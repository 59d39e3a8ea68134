// One motion: its indices, its contacts, and its histories (histories.hpp).
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <utility>

#include "boresight/keys/numbers_together.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/command.hpp"
#include "python/core/arrays.hpp"
#include "python/core/bindings.hpp"
#include "python/core/histories.hpp"
#include "python/core/task.hpp"
#include "results/motion_claims.hpp"

namespace py = pybind11;

namespace boresight::python {
namespace {

struct Run {
  std::shared_ptr<const Mechanism> mechanism;
  KeptResult result;
  std::size_t every = 1;  // of its samples one is told: the command follows motions so, and steps end at samples
};

py::dict index_of(const RunResult& result) {
  py::dict index;
  for (const QuantityName& quantity : quantity_names()) {
    if (quantity.kind == PointingQuantity::line_of_sight_error && !result.index.has_line_of_sight) continue;
    py::dict of;
    for (const StatisticName& statistic : statistic_names())
      of[statistic.name] = (result.index.*quantity.statistics).*statistic.value;
    of["time_of_max"] = (result.index.*quantity.statistics).time_of_max;
    index[quantity.name] = of;
  }
  return index;
}

py::dict contact_of(const RunResult& result) {
  py::dict contact;
  for (const ContactSummary& c : result.contact) {
    py::dict of;
    of["contact_fraction"] = c.contact_fraction;
    of["impacts"] = c.impacts;
    of["max_penetration"] = c.max_penetration;
    of["max_force"] = c.max_force;
    of["max_load"] = c.max_load;
    of["max_impact_speed"] = c.max_impact_speed;
    of["impact_speed_above_validity"] = c.impact_speed_above_validity;
    contact[py::str(c.joint)] = of;
  }
  return contact;
}

py::dict events_of(const Run& run) {
  const auto& events = run.result->events;
  const auto of = [&](auto field) {
    return column(run.result, events, events.empty() ? nullptr : &(events.front().*field));
  };
  py::list joint, contact;
  for (const ContactEvent& event : events) {
    joint.append(
        run.mechanism->description().joints[run.mechanism->description().clearances[event.clearance].joint].name);
    contact.append(to_string(event.place));
  }
  py::dict all;
  all["joint"] = joint;
  all["contact"] = contact;
  all["start"] = of(&ContactEvent::start);
  all["start_speed"] = of(&ContactEvent::start_speed);
  all["duration"] = of(&ContactEvent::duration);
  all["max_penetration"] = of(&ContactEvent::max_penetration);
  all["max_force"] = of(&ContactEvent::max_force);
  all["end_speed"] = of(&ContactEvent::end_speed);
  return all;
}

// Every so many samples, and the last one, as the command's files have them.
void thin(RunResult& result, std::size_t every) {
  const auto thinned = [every](auto& samples) {
    if (samples.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (i % every == 0 || i + 1 == samples.size()) samples[kept++] = samples[i];
    samples.resize(kept);
  };
  thinned(result.time);
  thinned(result.boresight.samples);
  for (BodyHistory& body : result.others) thinned(body.samples);
  for (auto& samples : result.clearances) thinned(samples);
}

Run run(const std::shared_ptr<Mechanism>& mechanism, const std::optional<NamedParameters>& parameters,
        const std::string& rung, RunOptions options, const std::vector<std::string>& poses,
        const py::object& progress) {
  if (parameters && parameters->mechanism != mechanism)
    throw InputError({}, "parameters", "those of another mechanism", "Mechanism.parameters() of this one");
  for (const std::string& name : poses) {
    const int body = mechanism->body_index(name);
    if (body < 0) throw InputError({}, "poses", "\"" + name + "\"", "a body of the mechanism");
    options.pose_bodies.push_back(body);
  }
  check_rung_name(rung);
  if (!(options.start >= 0.0)) throw InputError({}, "start", std::to_string(options.start), "a time of 0 s or more");
  check_start(options.start, *mechanism, {}, "start");
  std::size_t every =
      options.sample_spacing > 0.0 ? app::history_refinement(mechanism->duration(), options.sample_spacing) : 1;
  options.sample_spacing /= static_cast<double>(every);
  const Parameters& values = parameters ? parameters->values : mechanism->parameters();
  // Once all are set: one after the other they may not fit in between.
  if (const auto impossible = impossible_numbers(mechanism->description(), values))
    throw InputError({}, impossible->path, impossible->found, impossible->expected);
  Task task(progress);
  options.progress = [&task](const RunProgress& p) {
    task.tell(p.t, p.duration, "s of motion");
    return !task.stop();
  };
  auto result = std::make_shared<RunResult>();
  task.run([&] { *result = make_rung(rung == "auto" ? rung_names().back() : rung, mechanism)->run(values, options); });
  app::refuse_absurd(*mechanism, values, *result);
  app::add_range_warnings(*mechanism, values, *result);
  if (every > 1 && !result->time.empty() && (result->time.size() - 1) % every != 0) {
    thin(*result, every);
    every = 1;
  }
  return {mechanism, result, every};
}

}  // namespace

void bind_run(py::module_& module) {
  bind_histories(module);
  py::class_<Run>(module, "Run", "One motion: its indices, its contacts, its histories. Everything is in SI.")
      .def_property_readonly("rung", [](const Run& r) { return r.result->rung; })
      .def_property_readonly("integrator", [](const Run& r) { return r.result->integrator; })
      .def_property_readonly(
          "index", [](const Run& r) { return index_of(*r.result); },
          "{\"position_error\": {\"max\": .., \"rms\": .., \"mean\": .., \"p99.73\": ..} [m] and \"time_of_max\" [s], "
          "\"orientation_error\", \"boresight_error\", \"line_of_sight_error\": the same [rad]}")
      .def_property_readonly(
          "contact", [](const Run& r) { return contact_of(*r.result); },
          "Per joint: contact_fraction, impacts, max_penetration [m], max_force and max_load [N], max_impact_speed "
          "[m/s].")
      .def_property_readonly("events", &events_of, "One entry a contact, column by column, as in events.csv.")
      .def_property_readonly(
          "time",
          [](const Run& r) {
            const auto& time = r.result->time;
            return column(r.result, time, time.empty() ? nullptr : time.data(), 1, r.every);
          },
          "Of the samples, (n,) [s].")
      .def_property_readonly(
          "boresight",
          [](const Run& r) {
            return BodyHistoryView{r.result, &r.result->boresight, r.every};
          },
          "The body that points.")
      .def_property_readonly(
          "poses",
          [](const Run& r) {
            py::dict all;
            for (const BodyHistory& body : r.result->others)
              all[py::str(body.name)] = BodyHistoryView{r.result, &body, r.every};
            return all;
          },
          "The bodies that were asked for besides.")
      .def_property_readonly(
          "clearances",
          [](const Run& r) {
            py::dict all;
            for (std::size_t c = 0; c < r.result->clearances.size(); ++c) {
              const auto& m = r.mechanism->description();
              const std::string& joint = m.joints[m.clearances[c].joint].name;
              all[py::str(joint)] = ClearanceHistoryView{r.result, &r.result->clearances[c], joint, r.every};
            }
            return all;
          },
          "The play of each joint over time.")
      .def_property_readonly("warnings", [](const Run& r) { return r.result->warnings; })
      .def_property_readonly("cpu_seconds", [](const Run& r) { return r.result->cost.cpu_seconds; })
      .def("__repr__", [](const Run& r) {
        return "<Run of \"" + r.mechanism->name() + "\" on " + r.result->rung + ", " + r.result->integrator + ">";
      });

  module.def(
      "run",
      [](const std::shared_ptr<Mechanism>& mechanism, const std::optional<NamedParameters>& parameters,
         const std::string& rung, double step, double sample, const std::string& integrator, double tolerance,
         const std::string& formulation, const std::string& stabilisation, double start,
         const std::vector<std::string>& poses, bool events, const py::object& progress) {
        check_rung_name(rung);
        for (const auto& [option, given] : {std::pair{"step", step > 0.0},
                                            {"integrator", !integrator.empty()},
                                            {"tolerance", tolerance > 0.0},
                                            {"formulation", !formulation.empty()},
                                            {"stabilisation", !stabilisation.empty()}})
          if (const std::string why = rung == "auto" ? "" : why_unread(option, rung); given && !why.empty())
            throw InputError({}, option, "one", "none: " + why);
        RunOptions options;
        options.step = step;
        options.sample_spacing = sample;
        options.integrator = integrator;
        options.tolerance = tolerance;
        options.formulation = formulation;
        options.stabilisation = stabilisation;
        options.start = start;
        options.events = events;
        return run(mechanism, parameters, rung, options, poses, progress);
      },
      py::arg("mechanism"), py::arg("parameters") = py::none(), py::kw_only(), py::arg("rung") = "auto",
      py::arg("step") = 0.0, py::arg("sample") = 1e-3, py::arg("integrator") = "", py::arg("tolerance") = 0.0,
      py::arg("formulation") = "", py::arg("stabilisation") = "", py::arg("start") = 0.0,
      py::arg("poses") = std::vector<std::string>(), py::arg("events") = true, py::arg("progress") = py::none(),
      "Follows one motion.\n\n"
      "rung: envelope, quasistatic, perturbation or multibody; auto is multibody.\n"
      "step: of the integration [s]; 0: the rung's own. sample: spacing of the histories [s]; 0: none. Steps\n"
      "end at samples: with the same spacing (1 ms) an index has the bits that `boresight run` gives.\n"
      "start: indices leave out what comes before [s]. poses: further bodies whose motion is kept.\n"
      "progress(done, total, unit, estimate): called ten times a second; what it raises ends the run.\n"
      "Ctrl-C ends it with KeyboardInterrupt. Raises InputError, ComputationError.");
}

}  // namespace boresight::python
