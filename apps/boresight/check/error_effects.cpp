#include "check/error_effects.hpp"

#include <algorithm>
#include <optional>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_influence.hpp"

namespace boresight::app {
namespace {

// Instants that are looked at, both ends among them.
constexpr int kInstantsOfEffects = 101;
// Of what a turn by one radian or a move by one length of the mechanism would do: rounding of the joints' closure.
constexpr double kRoundingOfEffects = 1e-9;

// Columns of the wanted errors at t; why they cannot be had, if they cannot.
std::optional<std::string> columns_at(ErrorInfluence& influence, double t, const std::vector<bool>& wanted, MatX& G) {
  try {
    influence.at(t, wanted, G);
    return std::nullopt;
  } catch (const ComputationError& refusal) {
    return refusal.what();
  }
}

}  // namespace

std::vector<ErrorEffect> error_effects(const Mechanism& mechanism, const IdealMotion& commanded) {
  const MechanismDescription& description = mechanism.description();
  std::vector<ErrorEffect> effects;
  for (const ErrorDescription& error : description.errors) {
    ErrorEffect& effect = effects.emplace_back();
    effect.name = error.name;
    effect.unit = said_unit_of(error, description.joints);
    effect.value = error.value;
  }
  if (effects.empty()) return effects;
  ErrorInfluence influence(mechanism, commanded);
  std::vector<bool> wanted(effects.size(), true);
  MatX G;
  // All together at first; those that strain the mechanism one by one, where any does.
  if (columns_at(influence, 0.0, wanted, G))
    for (std::size_t e = 0; e < effects.size(); ++e) {
      std::vector<bool> one(effects.size(), false);
      one[e] = true;
      effects[e].strain = columns_at(influence, 0.0, one, G).value_or("");
      wanted[e] = effects[e].strain.empty();
    }
  if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return effects;
  const int body = mechanism.boresight_body();
  const double length = mechanism.characteristic_length();
  for (int i = 0; i < kInstantsOfEffects; ++i) {
    const double t = mechanism.duration() * i / (kInstantsOfEffects - 1);
    if (columns_at(influence, t, wanted, G)) {
      // One may strain that did not at the start, as a drive's error may that is zero there. All of them: a singular pose, which check names
      // by itself.
      std::vector<std::string> strain(effects.size());
      bool some = false;
      for (std::size_t e = 0; e < effects.size(); ++e) {
        if (!wanted[e]) continue;
        std::vector<bool> one(effects.size(), false);
        one[e] = true;
        strain[e] = columns_at(influence, t, one, G).value_or("");
        some = some || strain[e].empty();
      }
      if (!some) continue;
      for (std::size_t e = 0; e < effects.size(); ++e)
        if (!strain[e].empty()) {
          effects[e].strain = strain[e];
          wanted[e] = false;
        }
      if (columns_at(influence, t, wanted, G)) continue;
    }
    const Vec3 axis = commanded.body(t, body).R * mechanism.pointing().boresight_B;
    for (std::size_t e = 0; e < effects.size(); ++e) {
      const Vec6 column = G.block<6, 1>(6 * body, static_cast<Eigen::Index>(e));
      effects[e].position = std::max(effects[e].position, column.head<3>().norm());
      effects[e].boresight = std::max(effects[e].boresight, column.tail<3>().cross(axis).norm());
      if (influence.shifts())
        effects[e].uses_play =
            effects[e].uses_play ||
            influence.shift().col(static_cast<Eigen::Index>(e)).cwiseAbs().maxCoeff() > kRoundingOfEffects * length;
    }
  }
  for (std::size_t e = 0; e < effects.size(); ++e) {
    ErrorEffect& effect = effects[e];
    // What one unit is beside the mechanism: a length moves it by itself, an angle and a share turn it, warming grows it.
    const double one = effect.unit == "m" ? 1.0 / length : effect.unit == "K" ? description.errors[e].coefficient : 1.0;
    if (effect.position < kRoundingOfEffects * one * length) effect.position = 0.0;
    if (effect.boresight < kRoundingOfEffects * one) effect.boresight = 0.0;
  }
  return effects;
}

}  // namespace boresight::app
