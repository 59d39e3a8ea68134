// summary.json: what every verb's has in common, and the parts several verbs share. SI throughout.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"
#include "results/output_directory.hpp"

namespace boresight::app {

using Json = nlohmann::ordered_json;

// Runs from its making; what a whole command costs.
class Stopwatch {
 public:
  Stopwatch();
  double wall_seconds() const;
  double cpu_seconds() const;  // of all threads

 private:
  std::chrono::steady_clock::time_point wall_;
  double cpu_;
};

// verb, mechanism, version, rung and why, seed, cost, warnings, definitions, identity.
Json common_summary(const Command& command, const Mechanism& mechanism, const RungChoice& rung, const Stopwatch& watch,
                    const std::vector<std::string>& warnings, bool interrupted, const OutputDirectory& out);

Json statistics_json(const Statistics& statistics);
Json index_json(const PointingIndices& index);                  // per quantity: max, rms, mean, p99.73
Json definitions_json(bool has_line_of_sight);                  // a sentence per quantity and statistic
Json contact_json(const std::vector<ContactSummary>& contact);  // per joint
Json vector_json(const Vec3& vector);                           // [x, y, z]

// Where this program's last summary.json went; empty before the first.
const std::filesystem::path& last_summary();
void forget_summary();

void write_json(const OutputDirectory& out, const std::string& name, const Json& json);

// Says in a summary.json at once, where there is none yet, whose the folder is: before the first run is stored in it, or a
// kill would leave runs that nobody knows. warning: how to go on.
void announce_begun(const OutputDirectory& out, const std::string& verb, const std::string& warning);

}  // namespace boresight::app
