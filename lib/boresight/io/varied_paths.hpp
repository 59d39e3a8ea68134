// The parameters that a study varies, each of them once.
//
// What a study gives a parameter stands in place of the mechanism's own value. A setting of that value (`--set`) would have no effect, and
// is refused: whoever gave it expects one. Every reader of paths that a study varies takes them here.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "boresight/mechanism/description.hpp"

namespace boresight {

// What the mechanism's own value of a parameter that is varied still is to the study: nothing, or where a search starts, where a zone lies.
enum class OwnValue { unread, read };

class VariedPaths {
 public:
  explicit VariedPaths(const MechanismDescription& mechanism) : mechanism_(mechanism) {}

  // Takes what these paths name, a * all that it stands for. origin, key: where they stand. once: what was expected in place of a second
  // time. Throws InputError.
  void take(const Origin& origin, const std::string& key, const std::vector<std::string>& paths,
            OwnValue own = OwnValue::unread, const std::string& once = "each parameter once");
  // single: a path of one number.
  bool contains(const std::string& single) const { return taken_.contains(single); }

 private:
  void refuse_settings_without_effect(const Origin& varied_at) const;

  const MechanismDescription& mechanism_;
  std::set<std::string> taken_, replaced_;  // single paths; replaced_: of those taken whose own value nobody reads
};

}  // namespace boresight
