#include "generator.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dress.hpp"
#include "families.hpp"

namespace boresight::gauntlet {

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"gimbal", 3.0, draw_gimbal},
      {"planar loop", 2.0, draw_planar_loop},
      {"spatial loop", 2.0, draw_spatial_loop},
      {"platform", 2.0, draw_platform},
      {"redundant", 2.0, draw_redundant},
      {"arm", 1.5, draw_arm},
      {"pendulum", 1.0, draw_pendulum},
      {"sprung slide", 0.5, draw_sprung_slide},
      {"free chain", 0.8, draw_free_chain},
      {"stage", 1.5, draw_stage, 100'001},
  };
  return all;
}

namespace {

// a sin, a (1 - cos), a polynomial or a constant rate; `amplitude` and acceleration bounded.
std::string law(Draw& draw, const Scene& scene, double largest, double largest_acceleration) {
  const double w = 6.2831853 / scene.duration * draw.between(0.4, 2.0);
  const double a = draw.sign() * std::min(largest, largest_acceleration / (w * w));
  switch (draw.whole(0, 3)) {
    case 0:
      return fmt::format("{:.8g}*sin({:.8g}*t)", a, w);
    case 1:
      return fmt::format("{:.8g}*(1-cos({:.8g}*t))", 0.5 * a, w);
    case 2:
      return fmt::format("{:.8g}*t^2", 0.5 * a * w * w / 4.0);
    default:
      return fmt::format("{:.8g}*t", a * w);
  }
}

}  // namespace

std::string turning_law(Draw& draw, const Scene& scene, double reach) {
  return law(draw, scene, 0.35, 9.8 * draw.log_between(0.1, 5.0) / reach);
}

std::string sliding_law(Draw& draw, const Scene& scene, double reach) {
  return law(draw, scene, 0.12 * reach, 9.8 * draw.log_between(0.1, 5.0));
}

Scene generate(std::uint64_t seed) {
  Draw draw(seed);
  Scene scene;
  scene.size = draw.chance(0.6) ? draw.log_between(0.1, 1.0) : draw.log_between(0.01, 10.0);
  scene.duration = std::clamp(0.12 * std::sqrt(scene.size / 0.3) * draw.between(0.6, 1.6), 0.02, 0.3);
  double total = 0.0;
  for (const Family& f : families())
    if (seed >= f.first_seed) total += f.weight;
  double at = draw.between(0.0, total);
  const Family* family = &families().front();
  for (const Family& f : families()) {
    if (seed < f.first_seed) continue;
    family = &f;
    if ((at -= f.weight) < 0.0) break;
  }
  scene.family = family->name;
  scene.name = fmt::format("gauntlet {} {}", seed, family->name);
  family->draw(draw, scene);
  scene.about += fmt::format(" (seed {}).", seed);
  finish_bodies(draw, scene);
  add_plays(draw, scene);
  add_forces(draw, scene);
  place_in_space(draw, scene);
  scene.journals_centred = draw.chance(0.25);
  if (draw.chance(0.3)) scene.sight = scene.size * draw.log_between(3.0, 1e4);
  return scene;
}

}  // namespace boresight::gauntlet
