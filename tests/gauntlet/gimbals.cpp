// One to three axes in series, each shaft in two bearings: what every pointing mechanism has, and what a spatial model
// takes for redundant.
#include <fmt/format.h>

#include "families.hpp"

namespace boresight::gauntlet {

void draw_gimbal(Draw& draw, Scene& scene) {
  const int axes = draw.whole(1, 3);
  Vec3 axis = draw.direction(), center = Vec3::Zero();
  int inner = kGroundBody;
  for (int k = 1; k <= axes; ++k) {
    const int body = scene.add_body(fmt::format("frame{}", k));
    const double span = scene.size * draw.between(0.3, 1.0);
    SceneJoint motor{fmt::format("motor{}", k), "revolute", inner, body, center - 0.5 * span * axis, axis};
    motor.law = turning_law(draw, scene, scene.size);
    SceneJoint far{fmt::format("bearing{}", k),
                   draw.one_of<std::string>({"revolute", "cylindrical", "cylindrical", "spherical"}),
                   inner,
                   body,
                   center + 0.5 * span * axis,
                   axis};
    scene.add_joint(motor);
    if (draw.chance(0.8)) scene.add_joint(far);  // else the shaft is held at one end
    inner = body;
    Vec3 next = turned(across(axis), axis, draw.between(0.0, 6.28));
    if (draw.chance(0.3)) next = (next + draw.between(-0.4, 0.4) * axis).normalized();
    axis = next;
    if (draw.chance(0.5)) center += draw.inside_box(0.15 * scene.size);
  }
  scene.boresight_body = inner;
  scene.boresight = draw.chance(0.7) ? turned(axis, across(axis), 0.1) : draw.direction();
  scene.about = fmt::format("A gimbal of {} axes with bearing pairs", axes);
}

}  // namespace boresight::gauntlet
