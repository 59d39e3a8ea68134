// Normal contact: an elastic force with dissipation, F = F_e(d) (1 + h ddot / ddot0) + D ddot, never below zero.
//
// d penetration [m], ddot its rate, ddot0 > 0 the approach speed at the start of this contact (a discrete state, latched by
// an event; see contact_memory.hpp), h the law's damping factor, a function of the restitution alone. All laws of the
// Hunt-Crossley family share Hertz's F_e = K d^(3/2) and differ in h only; laws for cylinders bring another F_e
// (elastic_curve.hpp); D is Kelvin-Voigt's dashpot. F is clamped at zero: no suction.
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "boresight/contact/elastic_curve.hpp"
#include "boresight/mechanism/parameters.hpp"

namespace boresight {

// T: a sample's numbers may be lanes or jets. The curve is one for all lanes: of the mechanism, not of the sample.
template <typename T>
struct NormalLawT {
  T stiffness{};       // K [N/m^1.5], or [N/m]: by the curve
  T damping_factor{};  // h [-]
  ElasticCurve curve = ElasticCurve::point;
  T length{};    // l of the curve [m]
  T exponent{};  // n of the curve [-]
  T dashpot{};   // D [N s/m]

  // Zero where penetration <= 0. M: the scalar of the motion, T itself or one that carries derivatives besides.
  template <typename M>
  M force(const M& penetration, const M& rate, const T& impact_speed) const {
    using std::sqrt;
    // The root is taken of a positive number in every lane: at d = 0 its derivative would be infinite.
    const M depth = select(penetration > T(0.0), penetration, M(1.0));
    if (curve != ElasticCurve::point) [[unlikely]]
      return force_of_other_laws(penetration, depth, rate, impact_speed);
    const M elastic = stiffness * depth * sqrt(depth);
    const M whole = elastic * (T(1.0) + damping_factor * rate / impact_speed);
    return select(penetration > T(0.0), positive_part(whole), M(0.0));
  }

  // Without dissipation, for d > 0: force [N], its slope [N/m], its energy [J].
  T elastic_force(const T& d) const { return curve_force(curve, stiffness, length, exponent, d); }
  T elastic_slope(const T& d) const { return curve_slope(curve, stiffness, length, exponent, d); }
  T elastic_energy(const T& d) const { return curve_energy(curve, stiffness, length, exponent, d); }
  // Under a steady load [m].
  double depth_under(double load) const requires std::is_same_v<T, double> {
    return curve_depth(curve, stiffness, length, exponent, load);
  }

  template <typename U>
  NormalLawT<U> cast() const {
    return {U(stiffness), U(damping_factor), curve, U(length), U(exponent), U(dashpot)};
  }
  // The same law of half as long a contact.
  NormalLawT half() const {
    NormalLawT law = *this;
    law.stiffness = T(0.5) * stiffness;
    law.dashpot = T(0.5) * dashpot;
    return law;
  }

 private:
  // Out of the way of the family's few instructions.
  template <typename M>
  [[gnu::noinline]] M force_of_other_laws(const M& penetration, const M& depth, const M& rate,
                                          const T& impact_speed) const {
    if constexpr (HasPowers<T> && std::is_same_v<M, T>) {
      const T whole = elastic_force(depth) * (T(1.0) + damping_factor * rate / impact_speed) + dashpot * rate;
      return select(penetration > T(0.0), positive_part(whole), T(0.0));
    } else if constexpr (HasPowers<M>) {
      return cast<M>().force(penetration, rate, M(impact_speed));
    } else {
      throw std::logic_error("this scalar has no powers: only laws of Hertz's geometry");
    }
  }
};
using NormalLaw = NormalLawT<double>;

enum class ContactGeometry { point, line, linear };  // Hertz's spheres; parallel cylinders; a spring

// A law by its name in mechanism files.
struct NormalLawEntry {
  const char* name;
  const char* source;
  double (*damping_factor)(double restitution);  // null: the law knows no restitution
  double lowest_restitution;  // exclusive: the factor grows without bound towards it; -1: takes zero too
  const char* formula;        // of h, or of the force
  ContactGeometry geometry = ContactGeometry::point;
  NormalLaw (*elastic)(const ClearanceParameters&) = nullptr;  // of other than Hertz's geometry; h left at zero
};

const std::vector<NormalLawEntry>& normal_laws();
// Throws std::invalid_argument for an unknown name.
const NormalLawEntry& normal_law(const std::string& name);

// The law of a radial contact. dissipation: name of the law whose h a cylinder law takes, "" for its own.
NormalLaw make_normal_law(const std::string& law, const std::string& dissipation,
                          const ClearanceParameters& parameters);

}  // namespace boresight
