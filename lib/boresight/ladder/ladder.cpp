#include "boresight/ladder/ladder.hpp"

#include <stdexcept>

#include "boresight/multibody/multibody.hpp"
#include "boresight/perturbation/perturbation.hpp"
#include "boresight/statics/envelope.hpp"
#include "boresight/statics/quasistatic.hpp"

namespace boresight {
namespace {

// Cheapest first; a new rung is one line here.
struct Entry {
  const char* name;
  std::unique_ptr<Rung> (*make)(std::shared_ptr<const Mechanism>);
};
constexpr Entry kRungs[] = {{"envelope", make_envelope},
                            {"quasistatic", make_quasistatic},
                            {"perturbation", make_perturbation},
                            {"multibody", make_multibody}};

}  // namespace

std::vector<std::string> rung_names() {
  std::vector<std::string> names;
  for (const Entry& e : kRungs) names.push_back(e.name);
  return names;
}

std::unique_ptr<Rung> make_rung(const std::string& name, std::shared_ptr<const Mechanism> mechanism) {
  for (const Entry& e : kRungs)
    if (name == e.name) return e.make(std::move(mechanism));
  throw std::invalid_argument("no rung \"" + name + '"');
}

}  // namespace boresight
