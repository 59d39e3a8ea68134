#include "boresight_analyses/study/study_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/study/geometric_sample_model.hpp"

namespace boresight {
namespace {

constexpr std::size_t kFewest = 6, kMost = 256;
constexpr double kShareForError = 0.1;

}  // namespace

StudyDiscretisation measure_study_discretisation(std::shared_ptr<const Mechanism> mechanism,
                                                 const std::vector<Parameters>& samples, const RungSetup& setup,
                                                 const StudyErrorOptions& options) {
  StudyDiscretisation found;
  if (setup.stepless()) {
    found.measured = true;
    found.why = "this rung takes no steps";
    return found;
  }
  if (GeometricSampleModel::serve(setup.rung, *mechanism)) {
    found.measured = true;
    found.why = "pure geometry, as no joint has play: poses take no steps";
    return found;
  }
  char text[200];
  try {
    SetupSamples own(mechanism, samples, setup, options.index, options.scene_varies);
    SetupSamples finer(mechanism, samples, setup.finer(), options.index, options.scene_varies);
    std::vector<std::size_t> pairs;
    double most = options.least_seconds;
    // As many again while that stays within the time.
    for (std::size_t wanted = kFewest; wanted <= kMost && pairs.size() < samples.size(); wanted *= 2) {
      const double per_pair = own.cpu_seconds() + finer.cpu_seconds();
      most = std::max(options.least_seconds, kShareForError * static_cast<double>(options.runs) * own.cpu_seconds());
      const std::size_t count = std::min(wanted, samples.size());
      const double foreseen = static_cast<double>(count - pairs.size()) * per_pair;
      if (!pairs.empty() && found.cpu_seconds + foreseen > most) break;
      std::vector<std::size_t> some;
      // Two go first, to see what the others would take: the scene that all share is in the first one's time.
      const std::size_t until = pairs.empty() ? std::min<std::size_t>(2, count) : count;
      for (std::size_t k = pairs.size(); k < until; ++k) some.push_back(k);
      if (!own.compute(some, options.jobs, options.advance) || !finer.compute(some, options.jobs, options.advance)) {
        found.why = "it was stopped";
        return found;
      }
      pairs.insert(pairs.end(), some.begin(), some.end());
      found.cpu_seconds = own.spent_seconds() + finer.spent_seconds();
      if (pairs.size() < count) wanted /= 2;
    }
    std::vector<double> x, y;
    for (std::size_t k : pairs)
      if (std::isfinite(own.value(k)) && std::isfinite(finer.value(k)))
        x.push_back(own.value(k)), y.push_back(finer.value(k));
    if (x.size() < 4) {
      if (!own.refusal().empty() || !finer.refusal().empty())
        found.why = "not measured: " + (own.refusal().empty() ? finer.refusal() : own.refusal());
      else {
        std::snprintf(text, sizeof text,
                      "not measured: it takes pairs of runs worth %.2g s of CPU, more than a tenth of this study",
                      static_cast<double>(kFewest) * (own.cpu_seconds() + finer.cpu_seconds()));
        found.why = text;
      }
      return found;
    }
    const ScatterDifference d = compare_scatter(x, y, {}, options.statistic, nothing_of(options.index, *mechanism));
    found.measured = true;
    found.relative = d.bound();
    std::snprintf(text, sizeof text, "measured: the %s of %zu samples against %s", options.statistic.title().c_str(),
                  x.size(),
                  setup.lanes || setup.finer().tolerance > 0.0 ? "a tenth of the tolerance" : "half the step");
    found.why = text;
  } catch (const ComputationError& failure) {
    found.why = std::string("not measured: ") + failure.what();
  }
  return found;
}

}  // namespace boresight
