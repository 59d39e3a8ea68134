#include "boresight/io/assumed_values.hpp"

namespace boresight {

std::vector<std::string> in_words(const std::vector<AssumedValue>& assumed) {
  struct Lack {
    std::string joints, values;
  };
  std::vector<Lack> of_joint, lacks;
  for (const AssumedValue& a : assumed) {
    if (of_joint.empty() || of_joint.back().joints != a.joint) of_joint.push_back({a.joint, ""});
    std::string& values = of_joint.back().values;
    values += (values.empty() ? "" : ", ") + a.key + " = " + a.value;
    if (a.key == "contact.young") values += " (aluminium)";
    if (a.key == "friction.coefficient") values += " (none)";
  }
  for (const Lack& lack : of_joint) {
    bool known = false;
    for (Lack& other : lacks)
      if (other.values == lack.values) {
        other.joints += ", " + lack.joints;
        known = true;
      }
    if (!known) lacks.push_back(lack);
  }
  std::vector<std::string> sentences;
  for (const Lack& lack : lacks) sentences.push_back(lack.joints + ": not given, so assumed: " + lack.values);
  return sentences;
}

}  // namespace boresight
