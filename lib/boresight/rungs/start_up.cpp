#include "boresight/rungs/start_up.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "boresight/play/play_words.hpp"

namespace boresight {
namespace {

constexpr double kNothing = 1e-12;  // [m] or [rad]: an index that is rounding has no maximum worth a word

}  // namespace

void note_start_up(const Mechanism& mechanism, RunResult& result) {
  result.settled_from = 0.0;
  for (const ContactSummary& joint : result.contact)
    result.settled_from = std::max(result.settled_from, joint.settled_from);
  if (!(result.settled_from > result.start)) return;
  const std::pair<const char*, const Statistics*> indices[] = {
      {"position error", &result.index.position_error},
      {"orientation error", &result.index.orientation_error},
      {"boresight error", &result.index.boresight_error},
      {"line-of-sight error", &result.index.line_of_sight_error}};
  std::string names;
  double latest = 0.0;
  for (const auto& [name, statistics] : indices)
    if (statistics->max > kNothing && statistics->time_of_max < result.settled_from) {
      names += (names.empty() ? "" : ", ") + std::string(name);
      latest = std::max(latest, statistics->time_of_max);
    }
  if (names.empty()) return;
  char when[40], settled[60];
  std::snprintf(when, sizeof when, " falls into the start (%s %.3g s)",
                names.find(',') == std::string::npos ? "at" : "by", latest);
  std::snprintf(settled, sizeof settled, " have settled at %.3g s; ", result.settled_from);
  result.warnings.push_back("the maximum of the " + names + when + ", before the " +
                            parts_in_play(mechanism.description()).inserts + settled +
                            "--start, or [index] start in a study, leaves it out");
}

}  // namespace boresight
