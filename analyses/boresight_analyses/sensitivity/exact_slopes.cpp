#include "boresight_analyses/sensitivity/exact_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/contact_path.hpp"
#include "boresight_analyses/sensitivity/predictable_slopes.hpp"

namespace boresight {
namespace {

bool all_begin_with(const RandomParameter& p, const char* room) {
  return std::all_of(p.paths.begin(), p.paths.end(),
                     [room](const std::string& path) { return path.starts_with(room); });
}

void compare(const IndexSlopes& slopes, LocalSensitivity& p) {
  const double difference = p.derivative.back(), size = std::max(std::abs(p.exact), std::abs(difference));
  p.exact_agrees = p.meaningful && std::abs(p.exact - difference) <= kSettledSlope * size;
  char text[200];
  std::snprintf(text, sizeof text,
                "the slope of the motion itself, through %d impacts (%d grazing), is %.3g; differences over "
                "an eighth of the sd "
                "give %.3g: it holds for smaller changes than the scatter makes",
                slopes.impacts, slopes.grazing, p.exact, difference);
  if (!p.exact_agrees) p.exact_note = text;
}

}  // namespace

void add_exact_slopes(const std::shared_ptr<const Mechanism>& shared, const RandomInputs& inputs,
                      const IndexChoice& index, const RunOptions& run, LocalResult& local) {
  const Mechanism& mechanism = *shared;
  std::vector<double> medians, values;
  std::vector<std::size_t> varied, of_errors;
  std::vector<std::vector<double>> errors;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const RandomParameter& p = inputs.parameters[i];
    LocalSensitivity& s = local.parameters[i];
    medians.push_back(s.median);
    if (p.distribution->is_discrete()) {
      s.exact_note = "the parameter is discrete";
    } else if (all_begin_with(p, "error.") && mechanism.clearances() > 0) {
      of_errors.push_back(i);
      errors.push_back(errors_of_unit(mechanism, p.places));
    } else if (!std::all_of(p.paths.begin(), p.paths.end(), is_contact_path)) {
      s.exact_note = "exact slopes are those by standing errors beside play, and by numbers of a clearance's contacts";
    } else if (!(s.median > 0.0)) {
      s.exact_note = "the median is not positive";
    } else {
      varied.push_back(i);
      values.push_back(s.median);
    }
  }
  if (varied.empty() && of_errors.empty()) return;
  try {
    const auto parameters_at = [&](const std::vector<double>& v) {
      std::vector<double> all = medians;
      for (std::size_t k = 0; k < varied.size(); ++k) all[varied[k]] = v[k];
      return inputs.parameters_with(mechanism, all);
    };
    const IndexSlopes slopes = predictable_slopes(shared, parameters_at, values, index, run.start_offset, errors);
    std::vector<std::size_t> all = varied;
    all.insert(all.end(), of_errors.begin(), of_errors.end());
    for (std::size_t k = 0; k < all.size(); ++k) {
      LocalSensitivity& s = local.parameters[all[k]];
      s.exact = slopes.by[k];
      if (std::isfinite(s.exact))
        compare(slopes, s);
      else
        s.exact_note = !slopes.why_not[k].empty() ? slopes.why_not[k] : "the derivatives of the motion overflow";
    }
  } catch (const ComputationError& failure) {
    for (const std::vector<std::size_t>& failed : {varied, of_errors})
      for (const std::size_t i : failed) local.parameters[i].exact_note = failure.what();
  }
}

}  // namespace boresight
