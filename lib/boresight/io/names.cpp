#include <algorithm>
#include <cmath>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/io/names_of.hpp"
#include "boresight/keys/letters.hpp"
#include "boresight/keys/physical_ranges.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/course_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// The first of 401 even times at which the function or a derivative is larger than anything real; -1 if there is none.
double first_time_too_large(const TimeFunction& function, double duration) {
  constexpr int kSamples = 400;
  for (int k = 0; k <= kSamples; ++k) {
    const double t = duration * k / kSamples;
    const TimeValue v = function.at(t);
    if (std::abs(v.value) > kLargestLaw || std::max(std::abs(v.rate), std::abs(v.acceleration)) > kLargestLawDerivative)
      return t;
  }
  return -1.0;
}

int place(const std::vector<std::string>& names, const std::string& name) {
  const auto it = std::find(names.begin(), names.end(), name);
  return it == names.end() ? -1 : static_cast<int>(it - names.begin());
}

}  // namespace

namespace {

constexpr std::size_t kMostLetters = 100;

std::string read_name_without(const char* forbidden, const char* expected, Cursor& cursor, const std::string& key) {
  const std::string name = cursor.text(key);
  bool good = !name.empty() && letters_in(name) <= kMostLetters && name.front() != ' ' && name.back() != ' ';
  for (const char c : name) {
    good = good && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f &&
           std::string_view(forbidden).find(c) == std::string_view::npos;
  }
  if (!good) cursor.fail_found(key, in_quotes(name), expected);
  return name;
}

}  // namespace

std::string read_name(Cursor& cursor, const std::string& key) {
  return read_name_without(".*=,{}\"'[]", "a name of up to 100 characters without . * = , { } [ ] and quotation marks",
                           cursor, key);
}

std::string read_dotted_name(Cursor& cursor, const std::string& key) {
  const std::string name = read_name_without(
      "*=,{}\"'[]", "a name of up to 100 characters without * = , { } [ ] and quotation marks", cursor, key);
  if (name.front() == '.' || name.back() == '.' || name.find("..") != std::string::npos)
    cursor.fail_found(key, in_quotes(name), "a name with something before, between and after its dots");
  return name;
}

int body_index(const MechanismDescription& mechanism, const Cursor& cursor, const std::string& key,
               const std::string& name, bool ground_allowed) {
  if (ground_allowed && name == "ground") return kGround;
  std::vector<std::string> names = names_of(mechanism.bodies);
  const int index = place(names, name);
  if (index >= 0) return index;
  if (ground_allowed) names.push_back("ground");
  cursor.fail_found(key, in_quotes(name), ground_allowed ? "the name of a body, or \"ground\"" : "the name of a body",
                    nearest_name(name, names));
}

int joint_index(const MechanismDescription& mechanism, const Cursor& cursor, const std::string& key,
                const std::string& name) {
  const std::vector<std::string> names = names_of(mechanism.joints);
  const int index = place(names, name);
  if (index >= 0) return index;
  cursor.fail_found(key, in_quotes(name), "the name of a joint", nearest_name(name, names));
}

int read_journal(Cursor& cursor, const MechanismDescription& mechanism, const JointDescription& joint) {
  const auto name = [&](int body) {
    return body == kGround ? std::string("ground") : mechanism.bodies[static_cast<std::size_t>(body)].name;
  };
  const std::string either =
      "one of the bodies of joint " + joint.name + ": " + name(joint.first) + " or " + name(joint.second);
  if (!cursor.has("journal")) cursor.fail("journal", either);
  const std::string given = cursor.text("journal");
  const int body = body_index(mechanism, cursor, "journal", given, true);
  if (body != joint.first && body != joint.second) cursor.fail_found("journal", in_quotes(given), either);
  return body;
}

std::pair<int, int> read_connects(Cursor& cursor, const MechanismDescription& mechanism) {
  const std::vector<std::string> names = cursor.texts("connects");
  const int first = body_index(mechanism, cursor, "connects", names[0], true);
  const int second = body_index(mechanism, cursor, "connects", names[1], true);
  if (first == second) cursor.fail_found("connects", in_quotes(names[0]) + " twice", "two different bodies");
  return {first, second};
}

TimeFunctionPtr compile_expression(const Cursor& cursor, const std::string& key, const std::string& text,
                                   double duration, const NamedExpressions& named, double scale) {
  TimeFunctionPtr function;
  try {
    function = parse_expression(text, named, scale);
  } catch (const ValueFault& fault) {
    cursor.fail_found(key, fault.found, fault.expected, fault.nearest);
  }
  require_finite(cursor, key, text, *function, duration);
  return function;
}

void require_finite(const Cursor& cursor, const std::string& key, const std::string& text, const TimeFunction& function,
                    double duration) {
  if (const std::optional<CourseFault> fault = not_finite(function, duration))
    cursor.fail_found(key, in_quotes(text) + fault->found, fault->expected);
  if (const double t = first_time_too_large(function, duration); t >= 0.0)
    cursor.fail_found(key, in_quotes(text) + ", which is beyond anything real" + at_time(t),
                      "an expression of at most 1e15, its first two derivatives of at most 1e18 (SI)");
}

void require_continuous(const Cursor& cursor, const std::string& key, const std::string& text,
                        const TimeFunction& function, double duration) {
  if (const std::optional<CourseFault> fault = not_continuous(function, duration))
    cursor.fail_found(key, in_quotes(text) + fault->found, fault->expected);
}

TimeFunctionPtr read_expression(Cursor& cursor, const std::string& key, double duration, const NamedExpressions& named,
                                double scale) {
  return compile_expression(cursor, key, cursor.text(key), duration, named, scale);
}

TimeFunctionPtr read_motion_law(Cursor& cursor, const std::string& key, double duration, const NamedExpressions& named,
                                double scale) {
  TimeFunctionPtr law = read_expression(cursor, key, duration, named, scale);
  require_continuous(cursor, key, cursor.text(key), *law, duration);
  return law;
}

}  // namespace boresight
