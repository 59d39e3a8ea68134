#include <algorithm>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/io/names_of.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/drawn_joint.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_course.hpp"

namespace boresight {
namespace {

bool is_number_in_quotes(const std::string& found) {
  double number = 0.0;
  return found.size() > 2 && found.front() == '"' && found.back() == '"' &&
         parse_number(std::string_view(found).substr(1, found.size() - 2), number);
}

using Kind = ErrorDescription::Kind;

struct KindKey {
  const char* key;
  Kind kind;
};
constexpr KindKey kKinds[] = {{"translation", Kind::translation},
                              {"rotation", Kind::rotation},
                              {"drive", Kind::drive},
                              {"expansion", Kind::expansion}};

Kind read_kind(const Cursor& cursor) {
  const KindKey* found = nullptr;
  for (const KindKey& k : kKinds) {
    if (!cursor.has(k.key)) continue;
    if (found)
      cursor.fail_found(k.key, std::string("both ") + found->key + " and " + k.key,
                        "one of the two: a table is one error");
    found = &k;
  }
  if (!found)
    cursor.fail_found("translation", "none of translation, rotation, drive and expansion", "exactly one of them");
  return found->kind;
}

// What belongs to other kinds of errors is refused by its name.
void refuse_foreign_keys(const Cursor& cursor, Kind kind) {
  const auto refuse = [&](const char* key, const char* expected) {
    if (cursor.has(key)) cursor.fail_found(key, "a key that has no meaning here", expected);
  };
  if (kind == Kind::drive) {
    refuse("joint", "drive alone, which names the joint");
    refuse("body", "no body: a drive turns or moves both of its bodies against each other");
  } else {
    refuse("law", "no law: only a drive has one");
  }
  if (kind == Kind::expansion) refuse("joint", "no joint: the whole part grows");
}

constexpr int kNoBody = kGround - 1;

// The joint of that name; of a universal one whose play has made it two bearings on a cross, the bearing in `body`, whose frame there is the
// universal joint's.
int joint_or_bearing(const Cursor& cursor, const std::string& key, const MechanismDescription& so_far,
                     const std::string& name, int body) {
  int first = -1, second = -1;
  for (std::size_t j = 0; j < so_far.joints.size(); ++j) {
    if (so_far.joints[j].name == name + ".first") first = static_cast<int>(j);
    if (so_far.joints[j].name == name + ".second") second = static_cast<int>(j);
  }
  if (first < 0 || second < 0) return joint_index(so_far, cursor, key, name);
  return so_far.joints[second].second == body ? second : first;
}

// A direction in words: towards another joint, or along the joint's own axis.
Vec3 direction_in_words(Cursor& cursor, const std::string& key, const MechanismDescription& so_far, int of_joint) {
  const JointDescription& joint = so_far.joints[of_joint];
  const std::string words = cursor.text(key), towards = "towards ";
  if (words == "axis") {
    if (joint.type == JointType::spherical || joint.type == JointType::fixed)
      cursor.fail_found(key, "\"axis\" on a " + std::string(to_string(joint.type)) + " joint, which has none",
                        "three numbers, or \"towards JOINT\"");
    return joint.axis;
  }
  if (!words.starts_with(towards))
    cursor.fail_found(key, in_quotes(words), "three numbers, \"towards JOINT\", or \"axis\"");
  const int other = joint_or_bearing(cursor, key, so_far, words.substr(towards.size()), joint.first);
  const Vec3 way = drawn_point(so_far, other) - drawn_point(so_far, of_joint);
  if (!(way.norm() > 1e-12 * (1.0 + joint.point.norm())))
    cursor.fail_found(key, in_quotes(words) + ", which is at the same point as " + in_quotes(joint.name),
                      "a joint elsewhere, or three numbers");
  return way.normalized();
}

CoordinateFunctionPtr read_law(Cursor& cursor) {
  const std::string text = cursor.text("law");
  try {
    return parse_coordinate_function(text);
  } catch (const ValueFault& fault) {
    cursor.fail_found("law", fault.found, fault.expected, fault.nearest);
  }
}

void check_name(const Cursor& cursor, const MechanismDescription& so_far, const std::string& name) {
  for (const ErrorDescription& other : so_far.errors) {
    if (other.name == name)
      cursor.fail_found("name",
                        in_quotes(name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
                        "a name of its own");
    if (name.starts_with(other.name + ".") || other.name.starts_with(name + "."))
      cursor.fail_found("name", in_quotes(name) + " beside " + in_quotes(other.name),
                        "names of which none begins with another and a dot, as paths must tell them apart");
  }
}

}  // namespace

ErrorDescription read_error(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(error_keys());
  ErrorDescription error;
  error.origin = cursor.origin();
  error.name = read_dotted_name(cursor, "name");
  check_name(cursor, so_far, error.name);
  cursor.name_error(error.name);
  cursor.rename("error." + error.name);
  cursor.stands_for_table("value");
  error.kind = read_kind(cursor);
  refuse_foreign_keys(cursor, error.kind);
  PhysicalRange range = kCoordinateRange;
  switch (error.kind) {
    case Kind::translation:
    case Kind::rotation: {
      const std::string key = error.kind == Kind::translation ? "translation" : "rotation";
      const std::string name = cursor.text("joint");
      error.body = body_index(so_far, cursor, "body", cursor.text("body"), true);
      error.joint = joint_or_bearing(cursor, "joint", so_far, name, error.body);
      const JointDescription& joint = so_far.joints[error.joint];
      if (error.body != joint.first && error.body != joint.second)
        cursor.fail("body", "one of the two bodies that " + in_quotes(name) + " connects");
      // A universal joint's own axis is that of its first bearing.
      const int named = joint_or_bearing(cursor, "joint", so_far, name, kNoBody);
      error.direction = cursor.is_text(key) ? direction_in_words(cursor, key, so_far, named) : cursor.direction(key);
      if (error.kind == Kind::rotation) range = kFrameTurnRange;
      break;
    }
    case Kind::drive: {
      error.joint = joint_index(so_far, cursor, "drive", cursor.text("drive"));
      const JointDescription& joint = so_far.joints[error.joint];
      if (!joint.driven)
        cursor.fail_found("drive", in_quotes(joint.name) + ", which is not driven", "the name of a driven joint");
      error.law = read_law(cursor);
      error.law_text = cursor.text("law");
      error.law_origin = cursor.origin("law");
      // Along a motion by poses the ideal motion looks at it (mechanism/error_course.hpp).
      if (const auto drive = so_far.motion.drives.find(error.joint); drive != so_far.motion.drives.end()) {
        const ErrorAlongDrive along(error.law, drive->second);
        require_finite(cursor, "law", cursor.text("law"), along, so_far.motion.duration);
        require_continuous(cursor, "law", cursor.text("law"), along, so_far.motion.duration);
      }
      if (joint.type != JointType::prismatic) range = kFrameTurnRange;
      if (is_scale(error)) range.unit = joint.type == JointType::prismatic ? kShareOrLength : kShareOrAngle;
      break;
    }
    case Kind::expansion:
      error.body = body_index(so_far, cursor, "body", cursor.text("body"), true);
      error.coefficient = cursor.quantity("expansion");
      range = kWarmingRange;
      break;
  }
  if (cursor.has("value")) {
    const bool number = error.kind == Kind::drive && cursor.is_number("value");
    if (const std::string found = cursor.found("value");
        error.kind == Kind::drive && !number && is_number_in_quotes(found))
      cursor.fail_found("value", found + " in quotes and without a unit",
                        "a number without quotes, or a text with its unit");
    error.value = number ? cursor.value("value", kRatio) : cursor.quantity("value", range);
  }
  cursor.finish();
  return error;
}

}  // namespace boresight
