#include "boresight_analyses/runs/evaluation_store.hpp"

#include <cmath>

namespace boresight {
namespace {

std::vector<std::string> columns(std::vector<std::string> variables) {
  for (const char* name : {"sample", "free_flight_share", "impacts_per_second", "peak_acceleration"})
    variables.emplace_back(name);
  return variables;
}

}  // namespace

EvaluationStore::EvaluationStore(const std::filesystem::path& file, const std::map<std::string, std::string>& facts,
                                 const std::vector<std::string>& variables, const std::string& rung, double step)
    : store_(file, facts, columns(variables)), variables_(variables.size()) {
  store_.use_rung(rung, step);
  store_.read(~std::uint64_t{0} >> 1, [&](const SampleRecord& record) {
    next_ = record.number + 1;
    const std::vector<double> design(record.inputs.begin(),
                                     record.inputs.begin() + static_cast<std::ptrdiff_t>(variables_));
    std::vector<Outcome>& outcomes = known_[design];
    const auto place = static_cast<std::size_t>(record.inputs[variables_]);
    if (outcomes.size() <= place) outcomes.resize(place + 1);
    outcomes[place] = record.outcome;
    outcomes[place].motion = {record.inputs[variables_ + 1], record.inputs[variables_ + 2],
                              record.inputs[variables_ + 3]};
  });
}

const std::vector<Outcome>* EvaluationStore::find(std::span<const double> design, std::size_t samples) const {
  const auto found = known_.find({design.begin(), design.end()});
  if (found == known_.end() || found->second.size() != samples) return nullptr;
  for (const Outcome& outcome : found->second)
    if (outcome.status == Outcome::Status::not_reached) return nullptr;
  return &found->second;
}

void EvaluationStore::add(std::span<const double> design, const std::vector<Outcome>& outcomes) {
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const MotionMeasures& m = outcomes[k].motion;
    SampleRecord record{.number = next_++, .inputs = {design.begin(), design.end()}, .outcome = outcomes[k]};
    for (const double value : {static_cast<double>(k), m.free_flight_share, m.impacts_per_second, m.peak_acceleration})
      record.inputs.push_back(value);
    store_.add(record);
  }
  store_.commit();
  known_[{design.begin(), design.end()}] = outcomes;
}

}  // namespace boresight
