#include "boresight/statics/passing_rest.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "boresight/pointing/relative_text.hpp"

namespace boresight {
namespace {

const char* name_of(PointingQuantity quantity) {
  switch (quantity) {
    case PointingQuantity::position_error:
      return "position";
    case PointingQuantity::orientation_error:
      return "orientation";
    case PointingQuantity::boresight_error:
      return "boresight";
    case PointingQuantity::line_of_sight_error:
      return "line-of-sight";
  }
  return "";
}

// "F1", "F1 and F2", "F1, F2 and F3".
std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t k = 0; k < names.size(); ++k)
    list += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return list;
}

constexpr double kLeastTurn = 1e-9;  // less is rounding [rad]

bool is_across(const Vec2T<double>& before, const Vec2T<double>& after, double least) {
  const double way = (after - before).norm();
  return way > std::max({before.norm(), after.norm(), least});
}

}  // namespace

double rise_above(double maximum, double before, double after) {
  const double beside = std::max(before, after);
  if (!(maximum > (1.0 + kRiseOfPassage) * beside)) return 0.0;
  return beside > 0.0 ? maximum / beside - 1.0 : std::numeric_limits<double>::infinity();
}

bool changes_sides(const RestingPlay& before, const RestingPlay& after) {
  const PlayMotion<double>&from = before.motion, &to = after.motion;
  const Vec2T<double> across_before(from.e.x(), from.e.z()), across_after(to.e.x(), to.e.z());
  const double along = std::abs(to.e.y() - from.e.y());
  return is_across(across_before, across_after, 0.5 * before.radial_reach[0]) ||
         (before.axial_reach > 0.0 && along > before.axial_reach) || is_across(from.slope, to.slope, kLeastTurn) ||
         (from.roll * to.roll < 0.0 && std::abs(to.roll - from.roll) > kLeastTurn);
}

std::string passage_sentence(const Passage& passage) {
  std::vector<std::string> quantities;
  for (const PointingQuantity quantity : passage.quantities) quantities.emplace_back(name_of(quantity));
  const bool one = passage.joints.size() == 1;
  char time[40];
  std::snprintf(time, sizeof time, "%.4g s", passage.t);
  return "the largest " + listed(quantities) + (quantities.size() == 1 ? " error" : " errors") + ", at t = " + time +
         (quantities.size() == 1 ? ", is" : ", are") + " of a passage: the load of " + listed(passage.joints) +
         " changes its direction there, and " + (one ? "its rest goes" : "their rests go") +
         " from one side of the play to the other. Just before and just after errors are smaller, the maximum is " +
         relative_text(passage.rise, 2, "what is there") +
         " above them; a real one takes time to cross, and need not come by there: RMS and p99.73 hold better, and the "
         "multibody rung follows the crossing";
}

}  // namespace boresight
