#include "report_parts/step_error_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boresight/pointing/relative_text.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

double relative_step_error(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of) {
  const double value = std::abs(of.of(index)), stated = of.of(measured.stated);
  return value > 0.0 ? stated / value : 0.0;
}

namespace {

// Of an index: what is computed in another order differs by as much.
constexpr double kOfRounding = 1e-9;

// An index of an ideal motion, or its error, that is smaller than this share of the mechanism's size, or this angle, is what rounding and the
// tolerances of an integrator leave: no clearance and no error of a drawing is as small.
constexpr double kNothing = 1e-9;
// Where there is neither play nor error, indices are what the integration itself leaves of the ideal motion: up to this share that is followed.
constexpr double kFollowed = 1e-5;
bool is_nothing(double value, const IndexChoice& of, double size, double share = kNothing) {
  // A line of sight errs by a displacement over its target's distance: of a thousand kilometres.
  const double unit = of.kind() == PointingQuantity::position_error        ? size
                      : of.kind() == PointingQuantity::line_of_sight_error ? 1e-6
                                                                           : 1.0;
  return std::abs(value) <= share * unit;
}

// Neighbouring steps lie as far from each other as from finer ones.
bool scatters(const MeasuredError& measured, const IndexChoice& of) {
  for (const QuantityName& quantity : quantity_names())
    for (const StatisticName& statistic : statistic_names())
      if (of.quantity == quantity.name && of.statistic == statistic.name)
        return measured.scatters(quantity.statistics, statistic.value);
  return false;
}

// Of a model's error that is larger than the lesser of what it finds and what there is, which one of the two it is nobody knows.
constexpr double kManyTimes = 2.0;
// "4.6", "180", "10000 or more": how far apart the two may be, model the error over the lesser one.
std::string factor_text(double model) {
  constexpr double kNoMore = 1e4;  // told apart
  const double factor = 1.0 + model;
  return !(factor < kNoMore) ? fmt::format("{:.0f} or more", kNoMore)
         : factor < 100.0    ? fmt::format("{:.2g}", factor)
                             : fmt::format("{:.0f}", factor);
}

std::string of_what_is_found(double relative) {
  return relative < kSaidAsMultiple ? readable_share(relative) + " of what is found"
                                    : relative_text(relative, 3, "what is found");
}

}  // namespace

std::string steps_mislead(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of,
                          double size, bool deviates) {
  if (!measured.measured || measured.runs == 0) return "";
  const double relative = relative_step_error(measured, index, of), nothing = deviates ? kNothing : kFollowed;
  if (!(relative > 1.0) ||
      (is_nothing(of.of(index), of, size, nothing) && is_nothing(of.of(measured.stated), of, size, nothing)))
    return "";
  if (scatters(measured, of))
    return fmt::format(
        "{}: neighbouring {} lie as far from each other as {}: this motion is not followed; take "
        "a smaller --step, or ask for a mean over many motions",
        of.title(), measured.by_instants ? "instants" : "steps", of_what_is_found(relative));
  return fmt::format("{}: what {} leave out is {}: {}", of.title(), measured.by_instants ? "the instants" : "the steps",
                     of_what_is_found(relative),
                     measured.by_instants
                         ? "where journals rest is not followed from one instant to the next; take another rung"
                         : "this motion is not followed; take a smaller --step");
}

std::string step_error_sentence(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of,
                                double size) {
  // Nothing is known of why where the command was interrupted before it came to it.
  if (!measured.measured)
    return "what the steps do to the indices was not measured" +
           (measured.why_not.empty() ? std::string() : ": " + measured.why_not);
  if (measured.runs == 0) return measured.basis;
  const double relative = relative_step_error(measured, index, of);
  return fmt::format("{}: within {} of what {} give{}; {}, {} of CPU", of.title(),
                     relative < kOfRounding || (relative > 1.0 && is_nothing(of.of(measured.stated), of, size))
                         ? "rounding"
                         : readable_error(relative),
                     measured.by_instants ? "closer instants" : "smaller steps",
                     relative > 1e-3 && scatters(measured, of)
                         ? ", as far as neighbouring steps lie from each other: one motion of many"
                         : "",
                     measured.basis, readable(measured.cpu_seconds, "s"));
}

std::string stated_error_text(const MeasuredError& measured, const RunResult& result, const IndexChoice& of,
                              double size) {
  if (!measured.measured || is_nothing(of.of(result.index), of, size)) return "";
  const double model = result.error.basis.empty() ? 0.0 : result.error.model_of(of.kind());
  const double relative = relative_step_error(measured, result.index, of) + model;
  if (relative < kOfRounding) return "";
  if (model >= kManyTimes) return "within a factor of " + factor_text(relative);
  constexpr double kLeastShown = 1e-4;  // three digits are printed, and a bound may be wider
  return "± " + relative_text(std::max(relative, kLeastShown), 2, "it");
}

std::string force_error_text(const MeasuredError& measured, const RunResult& result, std::size_t clearance) {
  // With less a reader of three digits is not misled.
  constexpr double kLeastSaid = 5e-3;
  if (!measured.measured || clearance >= measured.contact_force.size()) return "";
  const double force = result.contact[clearance].max_force;
  const double relative = force > 0.0 ? measured.contact_force[clearance] / force : 0.0;
  return relative < kLeastSaid ? "" : "± " + relative_text(relative, 2, "it");
}

ModelErrorSaid model_error_said(const RunResult& result, const IndexChoice& of, double size) {
  // A tenth of what is asked for is more than any reader would take for granted.
  constexpr double kMuch = 0.1;
  const double share = result.error.model_of(of.kind());
  // Where nothing is found only a share of what another rung finds can be many times that.
  const bool nothing = is_nothing(of.of(result.index), of, size);
  if (result.error.basis.empty() || !(share > kOfRounding) || (nothing && share < kManyTimes)) return {};
  const std::string rung = "the " + result.rung + " rung", left_out = "what " + rung + " leaves out is ";
  const std::string about = nothing              ? left_out + "far more than it finds"
                            : share < 1.0        ? left_out + "about " + readable_share(share) + " of it"
                            : share < kManyTimes ? left_out + "anything up to the whole of it"
                                                 : rung + " may be off by a factor of " + factor_text(share);
  ModelErrorSaid said{of.title() + ": " + about + ", by its own estimate", ""};
  if (share > kMuch) said.warning = said.sentence + "; --rung multibody leaves nothing of that out";
  return said;
}

Json step_error_json(const MeasuredError& measured) {
  if (!measured.measured) return {{"measured", false}, {"why", measured.why_not}};
  Json json = {{"measured", true},
               {"basis", measured.basis},
               {"runs", measured.runs},
               {"cpu_seconds", measured.cpu_seconds},
               {"stated", index_json(measured.stated)},
               {"contact_force", measured.contact_force},
               {"platform_acceleration", vector_json(measured.acceleration)}};
  for (const QuantityName& quantity : quantity_names())
    for (const StatisticName& statistic : statistic_names())
      json["scatters"][quantity.name][statistic.name] = measured.scatters(quantity.statistics, statistic.value);
  return json;
}

}  // namespace boresight::app
