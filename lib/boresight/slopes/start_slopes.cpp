#include "boresight/slopes/start_slopes.hpp"

#include <algorithm>

#include "boresight/scene/resting_start.hpp"

namespace boresight {
namespace {

// Of a parameter: truncation is some 1e-12 of the slope, the balance's own rounding (1e-11 of the load) some 1e-9.
constexpr double kShare = 1e-3;

}  // namespace

StartSlopes start_slopes(const Mechanism& mechanism, const SceneTables& tables,
                         const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                         const std::vector<double>& values, bool derivatives, const std::vector<TablesBeside>& beside) {
  const Eigen::Index n = tables.layout.n;
  const auto start = [&](const std::vector<double>& at, const SceneTables& by) {
    std::string unused;
    return start_coordinates(mechanism, by.layout, by.start, joint_plays(mechanism.description(), parameters_at(at)),
                             unused);
  };
  StartSlopes out{VecX::Zero(2 * n), {}};
  out.state = start(values, tables);
  if (!derivatives) return out;
  out.by = MatX::Zero(2 * n, static_cast<Eigen::Index>(values.size()));
  if (mechanism.description().journals == JournalStart::centred) return out;
  for (const TablesBeside& one : beside)
    out.by.col(one.parameter) = (start(values, *one.more) - start(values, *one.less)) / one.apart;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const auto of = [p](const TablesBeside& one) { return one.parameter == static_cast<int>(p); };
    if (std::any_of(beside.begin(), beside.end(), of)) continue;
    const auto moved = [&](double steps) {
      std::vector<double> at = values;
      at[p] *= 1.0 + steps * kShare;
      return start(at, tables);
    };
    out.by.col(static_cast<Eigen::Index>(p)) =
        (8.0 * (moved(1.0) - moved(-1.0)) - (moved(2.0) - moved(-2.0))) / (12.0 * kShare * values[p]);
  }
  return out;
}

}  // namespace boresight
