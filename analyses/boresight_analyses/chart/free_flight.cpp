#include "boresight_analyses/chart/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/integrator_choice.hpp"

namespace boresight {

static void fields(Numbers& n, FlightPoint& p) { n(p.error, p.cpu_seconds, p.spent_seconds, p.refusal); }

namespace {

constexpr std::uint64_t kFlight = 1u << 20;  // keys of what is kept: the chart's own are smaller
constexpr double kBeforeContact = 0.9;       // share of the time to the first contact
constexpr int kRepeats = 3;
constexpr int kCoarsest = 4, kFinest = 512;  // steps in the flight

double first_contact(const Rung& multibody, const Mechanism& mechanism, const Parameters& parameters, double own_step) {
  RunOptions options;
  options.step = own_step;
  options.sample_spacing = 0.0;
  const RunResult result = multibody.run(parameters, options);
  double first = mechanism.duration();
  for (const ContactEvent& e : result.events) first = std::min(first, e.start);
  return first;
}

// The position error of the boresight body at the end.
Vec3 displacement_at_end(const RunResult& result) { return result.boresight.samples.back().error.displacement; }

}  // namespace

FreeFlight fly(const Mechanism& mechanism, const Parameters& parameters, double own_step, double most_seconds,
               const std::function<bool()>& advance, KeptResults* kept) {
  const double start = thread_cpu_seconds();
  double earlier = 0.0;  // of CPU, by another start
  FreeFlight flight;
  const auto ask = [&] {
    if (!advance()) throw MeasurementInterrupted{};
  };
  const auto whole = std::make_shared<const Mechanism>(mechanism);
  ask();
  flight.first_contact = first_contact(*make_rung("multibody", whole), mechanism, parameters, own_step);
  flight.end = kBeforeContact * flight.first_contact;
  double clearance = 0.0;
  for (const ClearanceParameters& c : parameters.clearance) clearance = std::max(clearance, widest_gap(c));
  if (!(flight.end > 0.0) || clearance == 0.0) {
    flight.why_not = clearance == 0.0 ? "no joint has clearance" : "the motion begins in contact";
    return flight;
  }
  MechanismDescription description = mechanism.description();
  description.motion.duration = flight.end;
  const auto shortened = std::make_shared<const Mechanism>(std::move(description));
  const auto run = [&](const Rung& rung, const RungSetup& setup) {
    RunOptions options = setup.options();
    options.model_look = ModelLook::none;
    options.sample_spacing =
        flight.end / 16.0;  // samples may lie a thousandth of this early: less than the finest step
    return rung.run(parameters, options);
  };

  const auto multibody = make_rung("multibody", shortened);
  RungSetup finest{.rung = "multibody", .formulation = "tree", .stabilisation = "projection", .integrator = "rk4"};
  finest.step = flight.end / (4.0 * kFinest);
  const Vec3 reference = displacement_at_end(run(*multibody, finest));
  finest.step *= 2.0;
  flight.rounding = (displacement_at_end(run(*multibody, finest)) - reference).norm() / clearance;

  for (const SetupFamily& family : chart_setups(own_step)) {
    RungSetup setup = family.setups.front();
    if (setup.stepless()) continue;  // they know no trajectory
    if (earlier + thread_cpu_seconds() - start > most_seconds) {
      flight.left_out.push_back(family.name);
      continue;
    }
    const auto rung = make_rung(setup.rung, shortened);
    std::vector<RungSetup> setups;
    if (setup.integrator == "rk4")
      for (int steps = kCoarsest; steps <= kFinest; steps *= 2) {
        setup.step = flight.end / steps;
        setups.push_back(setup);
      }
    else
      setups = family.setups;
    for (const RungSetup& w : setups) {
      const std::uint64_t key = kFlight + flight.points.size();
      FlightPoint point{.setup = w,
                        .family = family.name,
                        .error = 0.0,
                        .cpu_seconds = std::numeric_limits<double>::infinity(),
                        .refusal = ""};
      const double begun = thread_cpu_seconds();
      if (const std::optional<FlightPoint> found = kept_result<FlightPoint>(kept, key)) {
        point.error = found->error;
        point.cpu_seconds = found->cpu_seconds;
        point.refusal = found->refusal;
        earlier += found->spent_seconds;
      } else
        try {
          for (int k = 0; k < kRepeats; ++k) {
            ask();
            const RunResult result = run(*rung, w);
            point.error = (displacement_at_end(result) - reference).norm() / clearance;
            point.cpu_seconds = std::min(point.cpu_seconds, result.cost.cpu_seconds);
          }
        } catch (const ComputationError& failure) {
          point.refusal = failure.what();
        } catch (const std::invalid_argument& failure) {
          point.refusal = failure.what();
        }
      point.spent_seconds = thread_cpu_seconds() - begun;
      if (kept != nullptr) kept->keep(key, Numbers::of(point));
      flight.points.push_back(std::move(point));
      if (!flight.points.back().refusal.empty()) break;
    }
  }
  return flight;
}

}  // namespace boresight
