// Friction of a contact, by the law that the mechanism names: force over normal force as a function of the sliding speed.
//
// Modified Coulomb is the default and stays a few instructions; the others are asked for behind one test that every lane
// answers alike. LuGre has a state and is not a function of speed: it is carried beside (see JointPlay::lugre).
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "boresight/contact/bengisu_akay.hpp"
#include "boresight/contact/brown_mcphee.hpp"
#include "boresight/contact/modified_coulomb.hpp"
#include "boresight/contact/threlfall.hpp"
#include "boresight/mechanism/parameters.hpp"

namespace boresight {

enum class FrictionKind { none, modified_coulomb, threlfall, bengisu_akay, brown_mcphee, lugre };

template <typename T>
struct FrictionLawT {
  T coefficient = T(0.0);     // kinetic [-]
  T static_speed = T(1e-4);   // [m/s]
  T dynamic_speed = T(1e-3);  // [m/s]
  FrictionKind kind = FrictionKind::modified_coulomb;
  T stiction = T(0.0);         // static coefficient [-]
  T stribeck_speed = T(1e-2);  // [m/s]

  template <typename U>
  FrictionLawT<U> cast() const {
    return {U(coefficient), U(static_speed), U(dynamic_speed), kind, U(stiction), U(stribeck_speed)};
  }

  // Friction force over normal force over sliding speed [s/m]: multiply by F_n and the sliding velocity vector.
  // speed >= 0. M: the scalar of the motion.
  template <typename M>
  M force_per_velocity(const M& speed) const {
    if (kind != FrictionKind::modified_coulomb) [[unlikely]]
      return rare_force_per_velocity(speed);
    return ModifiedCoulombT<T>{coefficient, static_speed, dynamic_speed}.force_per_velocity(speed);
  }

 private:
  template <typename M>
  [[gnu::noinline]] M rare_force_per_velocity(const M& speed) const {
    if constexpr (HasPowers<T> && std::is_same_v<M, T>) {
      // At rest the force is zero and its direction none.
      const T divisor = select(speed > T(0.0), speed, T(1.0));
      switch (kind) {
        case FrictionKind::threlfall:
          return threlfall(speed, coefficient, dynamic_speed) / divisor;
        case FrictionKind::bengisu_akay:
          return bengisu_akay(speed, coefficient, stiction, dynamic_speed, stribeck_speed) / divisor;
        case FrictionKind::brown_mcphee:
          return brown_mcphee(speed, coefficient, stiction, dynamic_speed) / divisor;
        default:
          return T(0.0);
      }
    } else if constexpr (HasPowers<M>) {
      return cast<M>().force_per_velocity(speed);
    } else {
      throw std::logic_error("this scalar has no powers: only modified Coulomb friction");
    }
  }
};
using FrictionLaw = FrictionLawT<double>;

// A law by its name in mechanism files.
struct FrictionLawEntry {
  const char* name;
  FrictionKind kind;
  const char* source;
  const char* formula;
  bool peak;    // knows a static coefficient above the kinetic one
  bool sticks;  // holds a load at rest
};

const std::vector<FrictionLawEntry>& friction_laws();
// Throws std::invalid_argument for an unknown name.
const FrictionLawEntry& friction_law(const std::string& name);

FrictionLaw make_friction_law(const std::string& law, const FrictionParameters& parameters);

}  // namespace boresight
