#include <algorithm>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/keys/physical_ranges.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// "ZYZ": three axes, no two neighbours alike.
std::array<int, 3> read_convention(Cursor& cursor) {
  const std::string word = cursor.choice("convention");
  return {word[0] - 'X', word[1] - 'X', word[2] - 'X'};
}

double read_unit(Cursor& cursor) {
  const std::string unit = cursor.text("unit");
  try {
    return scale_of_unit(unit, kLength);
  } catch (const ValueFault& fault) {
    cursor.fail_found("unit", fault.found, "a unit of length such as \"mm\"", fault.nearest);
  }
}

PoseMotionDescription read_pose(Cursor& motion, const MechanismDescription& so_far, double duration) {
  PoseMotionDescription pose;
  pose.origin = motion.origin("body");
  pose.body = body_index(so_far, motion, "body", motion.text("body"), false);

  // The position may refer to the angles, and each angle to those before it.
  NamedExpressions named;
  Cursor angles = motion.table("angles");
  angles.only(angles_keys());
  pose.sequence = read_convention(angles);
  const char* const angle_names[3] = {"psi", "theta", "phi"};
  for (int k = 0; k < 3; ++k) {
    pose.angle[k] = read_motion_law(angles, angle_names[k], duration, named);
    named.emplace_back(angle_names[k], angles.text(angle_names[k]));
  }
  angles.finish();

  Cursor position = motion.table("position");
  position.only(position_keys());
  const double scale = read_unit(position);
  const char* const axis_names[3] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) pose.position[k] = read_motion_law(position, axis_names[k], duration, named, scale);
  position.finish();
  return pose;
}

std::map<int, TimeFunctionPtr> read_drives(Cursor& motion, const MechanismDescription& so_far, double duration) {
  std::map<int, TimeFunctionPtr> laws;
  Cursor drives = motion.table("drives");
  drives.only(drives_keys());
  for (const std::string& name : drives.keys()) {
    const int joint = joint_index(so_far, drives, name, name);
    if (!so_far.joints[joint].driven) {
      drives.fail_found(name, "a law for joint " + in_quotes(name) + ", which is not driven",
                        "the name of a driven joint");
    }
    laws[joint] = read_motion_law(drives, name, duration);
  }
  for (std::size_t j = 0; j < so_far.joints.size(); ++j) {
    if (so_far.joints[j].driven && laws.count(static_cast<int>(j)) == 0) {
      throw InputError(drives.origin(), drives.path(so_far.joints[j].name), "nothing",
                       "a law for every driven joint, an expression of t");
    }
  }
  drives.finish();
  return laws;
}

}  // namespace

MotionDescription read_motion(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(motion_keys());
  MotionDescription motion;
  motion.origin = cursor.origin();
  motion.duration = cursor.quantity("duration");
  const bool pose = cursor.has("body") || cursor.has("angles") || cursor.has("position");
  const bool any_driven =
      std::any_of(so_far.joints.begin(), so_far.joints.end(), [](const auto& j) { return j.driven; });
  if (pose && cursor.has("drives")) cursor.fail_found("drives", "both a body's pose and drives", "one of the two");
  if (pose) {
    if (!any_driven) cursor.fail_found("body", "a pose, but no driven joint to follow it", "joints with driven = true");
    motion.pose = read_pose(cursor, so_far, motion.duration);
  } else if (cursor.has("drives")) {
    motion.drives = read_drives(cursor, so_far, motion.duration);
  } else if (any_driven) {
    throw InputError(cursor.origin(), cursor.path("drives"), "driven joints without a motion",
                     "a body's pose, or drives with a law for each driven joint");
  }
  cursor.finish();
  return motion;
}

namespace {

std::vector<InitialRateDescription> read_rates(Cursor& table, const MechanismDescription& so_far) {
  using Freedom = InitialRateDescription::Freedom;
  table.only(rates_keys());
  std::vector<InitialRateDescription> rates;

  const auto read_one = [&](Cursor& where, const std::string& key, const std::string& name,
                            const std::string& freedom) {
    InitialRateDescription rate;
    rate.origin = where.origin(key);
    rate.joint = joint_index(so_far, where, key, name);
    const JointDescription& joint = so_far.joints[rate.joint];
    const bool turns = joint.type == JointType::revolute || joint.type == JointType::cylindrical;
    const bool slides = joint.type == JointType::prismatic || joint.type == JointType::cylindrical;
    if (!turns && !slides) {
      where.fail_found(key, in_quotes(name) + ", a " + to_string(joint.type) + " joint",
                       "a revolute, prismatic or cylindrical joint");
    }
    if (joint.driven)
      where.fail_found(key, "a starting rate for joint " + in_quotes(name) + ", which is driven",
                       "a joint that is free");
    const std::string both = in_quotes(name + ".angle") + " or " + in_quotes(name + ".displacement");
    if (freedom.empty() && turns && slides)
      where.fail_found(key, in_quotes(name) + ", which both turns and slides", both);
    if (!(freedom.empty() || (freedom == "angle" && turns) || (freedom == "displacement" && slides))) {
      where.fail_found(key, in_quotes(freedom), turns && slides ? both : turns ? "\"angle\"" : "\"displacement\"");
    }
    rate.freedom = freedom == "displacement" || (freedom.empty() && slides) ? Freedom::displacement : Freedom::angle;
    rate.rate = where.quantity(key, rate.freedom == Freedom::angle ? kStartingAngularRateRange : kStartingSpeedRange);
    for (const InitialRateDescription& other : rates) {
      if (other.joint == rate.joint && other.freedom == rate.freedom) {
        where.fail_found(key, "a second rate of the same freedom", "one");
      }
    }
    rates.push_back(rate);
  };

  for (const std::string& key : table.keys()) {
    if (table.is_table(key)) {  // C.angle = "..." without quotation marks is a table in TOML
      Cursor inner = table.table(key);
      inner.only(freedom_rates_keys());
      for (const std::string& freedom : inner.keys()) read_one(inner, freedom, key, freedom);
      inner.finish();
      continue;
    }
    // "C.angle" is a freedom of C, "cross.first" a joint.
    const bool is_joint = std::any_of(so_far.joints.begin(), so_far.joints.end(),
                                      [&](const JointDescription& j) { return j.name == key; });
    const std::size_t dot = is_joint ? std::string::npos : key.rfind('.');
    read_one(table, key, key.substr(0, dot), dot == std::string::npos ? "" : key.substr(dot + 1));
  }
  table.finish();
  return rates;
}

}  // namespace

void read_initial(Cursor& cursor, MechanismDescription& mechanism) {
  cursor.only(initial_keys());
  const bool centred = cursor.choice("journals") == "centred";
  mechanism.journals = centred ? JournalStart::centred : JournalStart::rest;
  if (cursor.has("rates")) {
    Cursor rates = cursor.table("rates");
    mechanism.initial_rates = read_rates(rates, mechanism);
  }
  cursor.finish();
}

LineOfSightDescription read_pointing(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(pointing_keys());
  const auto body =
      std::find_if(so_far.bodies.begin(), so_far.bodies.end(), [](const auto& b) { return b.boresight.has_value(); });
  LineOfSightDescription sight;
  sight.origin = cursor.origin();
  sight.from = cursor.has("from") ? cursor.vector("from") : body->center_of_mass;
  const bool target = cursor.has("target"), distance = cursor.has("distance");
  if (target && distance) cursor.fail_found("distance", "both a target and a distance", "one of the two");
  if (!target && !distance) {
    throw InputError(cursor.origin(), cursor.path("target"), "nothing",
                     "a target, such as [\"0 m\", \"0 m\", \"5 m\"], or a distance along the boresight");
  }
  if (distance) {
    const double length = cursor.quantity("distance");
    sight.target = sight.from + length * *body->boresight;
  } else {
    sight.target = cursor.vector("target");
    // What rounding leaves of two equal points is no line.
    const double size = std::max(sight.from.norm(), sight.target.norm());
    cursor.require((sight.target - sight.from).norm() > 1e-9 * size, "target",
                   "a point away from the reference point (from)");
  }
  cursor.finish();
  return sight;
}

}  // namespace boresight
