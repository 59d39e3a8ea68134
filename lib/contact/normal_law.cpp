#include "boresight/contact/normal_law.hpp"

#include <stdexcept>

#include "boresight/contact/flores.hpp"
#include "boresight/contact/hertz_elastic.hpp"

namespace boresight {

const std::vector<NormalLawEntry>& normal_laws() {
  static const std::vector<NormalLawEntry> laws = {
      {"flores", "Flores, Machado, Silva, Martins (2011)", flores_damping_factor, 0.0},
      {"hertz", "Hertz (1882), no dissipation", hertz_elastic_damping_factor, -1.0},
  };
  return laws;
}

const NormalLawEntry& normal_law(const std::string& name) {
  for (const NormalLawEntry& law : normal_laws())
    if (name == law.name) return law;
  throw std::invalid_argument("no contact law \"" + name + '"');
}

}  // namespace boresight
