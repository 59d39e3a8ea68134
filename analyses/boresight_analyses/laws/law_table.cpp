#include "boresight_analyses/laws/law_table.hpp"

#include <cmath>
#include <limits>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/kelvin_voigt.hpp"
#include "boresight/contact/lugre.hpp"

namespace boresight {
namespace {

constexpr double kGood = 0.02;

NormalLaw law_for(const NormalLawEntry& entry, ClearanceParameters p, double e, double mass, bool own_dashpot) {
  p.contact.restitution = e;
  if (entry.geometry == ContactGeometry::linear && !own_dashpot)
    p.contact.linear_damping = kelvin_voigt_dashpot(p.contact.stiffness_scale * p.contact.linear_stiffness, mass, e);
  return make_normal_law(entry.name, "", p);
}

}  // namespace

std::vector<NormalLawRow> normal_law_table(ClearanceParameters p, double mass, double speed) {
  const bool own_spring = p.contact.linear_stiffness > 0.0;
  const double K = radial_hertz_stiffness(p), hertz_depth = std::pow(1.25 * mass * speed * speed / K, 0.4);
  // K holds the scale, and so does the law.
  if (!own_spring) p.contact.linear_stiffness = K * std::sqrt(hertz_depth) / p.contact.stiffness_scale;
  std::vector<NormalLawRow> rows;
  for (const NormalLawEntry& entry : normal_laws()) {
    if (entry.geometry == ContactGeometry::line && !(p.sleeve_length > 0.0)) continue;
    NormalLawRow row;
    row.entry = &entry;
    bool good = true;
    for (auto e = asked_restitutions().rbegin(); e != asked_restitutions().rend(); ++e) {
      // A spring and dashpot return no less than exp(-2) however strong the dashpot.
      const bool possible = entry.geometry != ContactGeometry::linear || *e > std::exp(-2.0);
      const double returned = possible ? impact(law_for(entry, p, *e, mass, false), mass, speed).restitution
                                       : std::numeric_limits<double>::quiet_NaN();
      row.returned.insert(row.returned.begin(), returned);
      good = good && std::abs(returned - *e) <= kGood;
      if (good) row.good_from = *e;
    }
    if (!(std::abs(row.returned.back() - asked_restitutions().back()) <= kGood)) row.good_from = 2.0;
    const NormalLaw own = law_for(entry, p, p.contact.restitution, mass, own_spring);
    row.one = impact(own, mass, speed, 4000, &row.path);
    for (int k = 0; k <= 200; ++k) {
      const double d = 2.0 * hertz_depth * k / 200.0;
      row.penetration.push_back(d);
      row.force.push_back(d > 0.0 ? own.elastic_force(d) : 0.0);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<FrictionLawRow> friction_law_table(const FrictionParameters& p) {
  std::vector<FrictionLawRow> rows;
  for (const FrictionLawEntry& entry : friction_laws()) {
    FrictionLawRow row;
    row.entry = &entry;
    const FrictionLaw law = make_friction_law(entry.name, p);
    for (int k = 0; k <= 300; ++k) {
      const double v = 1e-5 * std::pow(10.0, 5.0 * k / 300.0);
      row.speed.push_back(v);
      if (entry.kind == FrictionKind::lugre) {
        const LuGreT<double> bristles = {law.coefficient,     law.stiction,      law.stribeck_speed, law.dynamic_speed,
                                         p.bristle_stiffness, p.bristle_damping, p.viscosity};
        const Eigen::Vector2d sliding(v, 0.0), z = sliding / bristles.slip_rate(sliding);
        row.force.push_back(-bristles.traction(sliding, z, std::numeric_limits<double>::infinity()).force[0]);
      } else {
        row.force.push_back(v * law.force_per_velocity(v));
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace boresight
