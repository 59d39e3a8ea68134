// The default mechanism, and a sweep plan read from text.
#pragma once

#include <memory>
#include <string>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/sweep/sweep_plan.hpp"

namespace boresight {

inline const std::string kDefaultMechanism = BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml";

// A motion of 60 ms: long enough for some impacts.
inline std::shared_ptr<const Mechanism> short_mechanism() {
  return std::make_shared<const Mechanism>(read_mechanism(kDefaultMechanism, {{"motion.duration", "60 ms"}}));
}

inline SweepPlan plan_of(const std::string& sweep, const Mechanism& mechanism) {
  Document document = Document::from_text("[sweep]\n" + sweep, "study.toml");
  Cursor root(document);
  const AcceptsSettings accepts = [](const std::vector<Setting>& settings) {
    const Mechanism tried(read_mechanism(kDefaultMechanism, settings));
  };
  return read_sweep_plan(
      root, mechanism.description(), [&](const Setting& setting) { accepts({setting}); }, accepts);
}

}  // namespace boresight
