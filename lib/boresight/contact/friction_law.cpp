#include "boresight/contact/friction_law.hpp"

#include <stdexcept>

namespace boresight {

const std::vector<FrictionLawEntry>& friction_laws() {
  static const std::vector<FrictionLawEntry> laws = {
      {"none", FrictionKind::none, "no friction", "0", false, false},
      {"modified-coulomb", FrictionKind::modified_coulomb, "Ambrosio (2002)",
       "mu min(1, max(0, (v - v_s) / (v_d - v_s)))", false, false},
      {"threlfall", FrictionKind::threlfall, "Threlfall (1978)", "mu (1 - exp(-3 min(v, v_d) / v_d))", false, false},
      {"bengisu-akay", FrictionKind::bengisu_akay, "Bengisu, Akay (1994)",
       "v < v_d: mu_s (1 - (v - v_d)^2 / v_d^2); above: mu + (mu_s - mu) exp(-(v - v_d) / v_st)", true, false},
      {"brown-mcphee", FrictionKind::brown_mcphee, "Brown, McPhee (2016)",
       "mu tanh(4 v / v_d) + (mu_s - mu) (v / v_d) / ((v / 2 v_d)^2 + 3/4)^2", true, false},
      {"lugre", FrictionKind::lugre, "Canudas de Wit, Olsson, Astrom, Lischinsky (1995)",
       "s0 z + s1 exp(-(v / v_d)^2) z' + s2 v, z' = v - s0 |v| z / (mu + (mu_s - mu) exp(-(v / v_st)^2))", true, true},
  };
  return laws;
}

const FrictionLawEntry& friction_law(const std::string& name) {
  for (const FrictionLawEntry& law : friction_laws())
    if (name == law.name) return law;
  throw std::invalid_argument("no friction law \"" + name + '"');
}

FrictionLaw make_friction_law(const std::string& law, const FrictionParameters& p) {
  const FrictionKind kind = friction_law(law).kind;
  FrictionLaw made;
  made.coefficient = kind == FrictionKind::none ? 0.0 : p.coefficient;
  made.static_speed = p.static_speed;
  made.dynamic_speed = p.dynamic_speed;
  // No friction is modified Coulomb with nothing to it: the fast path.
  made.kind = kind == FrictionKind::none ? FrictionKind::modified_coulomb : kind;
  made.stiction = friction_law(law).peak && p.static_coefficient > 0.0 ? p.static_coefficient : made.coefficient;
  made.stribeck_speed = p.stribeck_speed;
  return made;
}

}  // namespace boresight
