#include "boresight/contact/normal_law.hpp"

#include <stdexcept>

#include "boresight/contact/carvalho_martins.hpp"
#include "boresight/contact/dubowsky_freudenstein.hpp"
#include "boresight/contact/exact_restitution.hpp"
#include "boresight/contact/flores.hpp"
#include "boresight/contact/gonthier.hpp"
#include "boresight/contact/herbert_mcwhannell.hpp"
#include "boresight/contact/hertz.hpp"
#include "boresight/contact/hertz_elastic.hpp"
#include "boresight/contact/hu_guo.hpp"
#include "boresight/contact/hunt_crossley.hpp"
#include "boresight/contact/johnson.hpp"
#include "boresight/contact/kelvin_voigt.hpp"
#include "boresight/contact/lankarani_nikravesh.hpp"
#include "boresight/contact/lee_wang.hpp"
#include "boresight/contact/liu.hpp"
#include "boresight/contact/pereira.hpp"
#include "boresight/contact/radzimovsky.hpp"
#include "boresight/contact/zhiying_qishao.hpp"

namespace boresight {

const std::vector<NormalLawEntry>& normal_laws() {
  using enum ContactGeometry;
  static const std::vector<NormalLawEntry> laws = {
      {"flores", "Flores, Machado, Silva, Martins (2011)", flores_damping_factor, 0.0, "h = 8 (1 - e) / (5 e)"},
      {"hertz", "Hertz (1882), no dissipation", hertz_elastic_damping_factor, -1.0, "h = 0"},
      {"hunt-crossley", "Hunt, Crossley (1975)", hunt_crossley_damping_factor, -1.0, "h = 3 (1 - e) / 2"},
      {"herbert-mcwhannell", "Herbert, McWhannell (1977)", herbert_mcwhannell_damping_factor, -1.0,
       "h = 6 (1 - e) / ((2 e - 1)^2 + 3)"},
      {"lee-wang", "Lee, Wang (1983)", lee_wang_damping_factor, -1.0, "h = 3 (1 - e) / 4"},
      {"lankarani-nikravesh", "Lankarani, Nikravesh (1990)", lankarani_nikravesh_damping_factor, -1.0,
       "h = 3 (1 - e^2) / 4"},
      {"gonthier", "Gonthier, McPhee, Lange, Piedboeuf (2004)", gonthier_damping_factor, 0.0, "h = (1 - e^2) / e"},
      {"zhiying-qishao", "Zhiying, Qishao (2006)", zhiying_qishao_damping_factor, -1.0,
       "h = 3 (1 - e^2) exp(2 (1 - e)) / 4"},
      {"hu-guo", "Hu, Guo (2015)", hu_guo_damping_factor, 0.0, "h = 3 (1 - e) / (2 e)"},
      {"carvalho-martins", "Carvalho, Martins (2019)", carvalho_martins_damping_factor, -1.0,
       "h = 3 (1 - e) (11 - e) / (2 (1 + 9 e))"},
      {"exact", "the family's own relation, derived here", exact_restitution_damping_factor, 0.0,
       "h (1 + e) = ln[(1 + h) / (1 - h e)]"},
      {"kelvin-voigt", "Goldsmith (1960)", nullptr, -1.0, "F = K d + D d'", linear, kelvin_voigt},
      {"johnson", "Johnson (1985)", exact_restitution_damping_factor, 0.0, "d = f / (pi E) (ln(4 pi E dR / f) - 1)",
       line, johnson},
      {"radzimovsky", "Radzimovsky (1953)", exact_restitution_damping_factor, 0.0,
       "d = f / (pi E) (2/3 + ln(4 Ri / b) + ln(4 Rj / b)), b = 1.60 sqrt(f Ri Rj / (dR E))", line, radzimovsky},
      {"dubowsky-freudenstein", "Dubowsky, Freudenstein (1971)", exact_restitution_damping_factor, 0.0,
       "d = f / (pi E) (ln(L^2 dR pi E / (f Ri Rj)) + 1)", line, dubowsky_freudenstein},
      {"liu", "Liu, Zhang, Yang (2007)", exact_restitution_damping_factor, 0.0,
       "F = (pi / 2) d E L sqrt(d / (2 (dR + d)))", line, liu},
      {"pereira", "Pereira, Ramalho, Ambrosio (2011)", lankarani_nikravesh_damping_factor, -1.0,
       "F = (0.965 dR + 0.0965) L E / dR d^n (N, mm), h = 3 (1 - e^2) / 4", line, pereira},
  };
  return laws;
}

const NormalLawEntry& normal_law(const std::string& name) {
  for (const NormalLawEntry& law : normal_laws())
    if (name == law.name) return law;
  throw std::invalid_argument("no contact law \"" + name + '"');
}

NormalLaw make_normal_law(const std::string& law, const std::string& dissipation, const ClearanceParameters& p) {
  const NormalLawEntry& entry = normal_law(law);
  NormalLaw made;
  if (entry.elastic != nullptr)
    made = entry.elastic(p);
  else
    made.stiffness = radial_hertz_stiffness(p);
  const auto factor = dissipation.empty() ? entry.damping_factor : normal_law(dissipation).damping_factor;
  if (factor != nullptr) made.damping_factor = factor(p.contact.restitution);
  return made;
}

}  // namespace boresight
