#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/calibration/model_error.hpp"

namespace boresight {
namespace {

// An error so many times that of the data alone has to be explained.
constexpr double kMuchMore = 2.0;

std::string text(const char* format, double a) {
  char out[64];
  std::snprintf(out, sizeof out, format, a);
  return out;
}

std::string size_of(double value, const std::string& unit) {
  if (unit == "%") return relative_text(value);
  if (unit == "s") return text("%.2g ms", 1e3 * value);
  return text("%.2g", value);
}

std::string in_words(const SuspectFound& s) {
  return s.says + " (by " + size_of(s.mean * s.deviation, s.unit) + ", known to " +
         size_of(s.error * s.deviation, s.unit) + ")";
}

}  // namespace

std::vector<std::string> in_words(const CalibrationModelError& error, const CalibrationProblem& problem,
                                  const Inference& inference) {
  std::vector<std::string> words;
  const bool contradict = error.contradicted(), jumps = error.departs();
  if (contradict)
    words.push_back(std::string(jumps || problem.windows.front().from_rest ? "The runs" : "The windows") +
                    " contradict each other: what they say of the parameters differs by " +
                    text("%.2g", error.disagreement) +
                    " times what their noise allows. Errors are widened by as much.");
  if (error.ends > 0)
    words.push_back("This may not be the true valley of the loss: the search also ended in " +
                    std::to_string(error.ends) + (error.ends == 1 ? " other" : " others") +
                    ", and in the lowest of them the runs still do not agree. Errors span them all.");
  if (jumps)
    words.push_back(
        "Stretches of a run contradict each other: the motion departs from the model on the way. Late readings of a "
        "run "
        "count for less, and errors are widened.");
  const SuspectFound* best = nullptr;
  for (const SuspectFound& s : error.suspects)
    if (s.gain > kDecides && (best == nullptr || s.gain > best->gain)) best = &s;
  if (best != nullptr)
    words.push_back("What would explain the data better: " + in_words(*best) + ".");
  else if (contradict || jumps)
    words.push_back(
        "Nothing that is suspected explains it (axial gaps, masses, a lag of the sensor): the law of the contacts, "
        "or bodies that give way, may.");
  if (problem.fit_time_offset && problem.time_offset_prior > 0.0) {
    const ParameterEstimate& e = inference.parameters[static_cast<std::size_t>(problem.time_offset_column())];
    if (std::abs(e.value) > 4.0 * e.standard_error)
      words.push_back("The readings are " + text("%.2g ms", 1e3 * std::abs(e.value)) +
                      (e.value < 0.0 ? " late" : " early") +
                      ": a lag of the sensor, or an offset of its clock. It is allowed for.");
  }
  for (int p = 0; p < problem.parameter_count(); ++p) {
    const FittedParameter& parameter = problem.parameters[static_cast<std::size_t>(p)];
    const ParameterEstimate& e = inference.parameters[static_cast<std::size_t>(p)];
    const double off = e.value - parameter.start;
    if (!parameter.is_error() && parameter.has_prior && std::abs(off) > 4.0 * e.standard_error)
      words.push_back("The data ask for a " + e.name + " " + relative_text(std::abs(off) / parameter.start) +
                      (off > 0.0 ? " larger" : " smaller") + " than was told. It is allowed for.");
    if (!e.identifiable || !(e.standard_error > kMuchMore * e.data_error)) continue;
    const SuspectFound* most = nullptr;
    double named = 0.0;
    for (const SuspectFound& s : error.suspects) {
      named += s.adds[p] * s.adds[p];
      if (most == nullptr || s.adds[p] > most->adds[p]) most = &s;
    }
    const bool by_suspects = most != nullptr && named > 0.5 * e.coordinate_error * e.coordinate_error;
    const auto share = [&](double error_of) { return relative_text(error_of / std::abs(e.value)); };
    words.push_back(e.name + " is known to " + share(e.standard_error) +
                    "; were the model without fault, the data would know it to " + share(e.data_error) +
                    (by_suspects ? ". What counts most: " + most->says : std::string()) + ".");
  }
  return words;
}

}  // namespace boresight
