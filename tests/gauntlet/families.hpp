// The kinds of mechanism that the generator draws. Each adds bodies, joints and drives to a scene whose size and duration
// are set; what all kinds share (masses, play, springs, loads, gravity, place in space) comes afterwards: dress.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw.hpp"
#include "scene.hpp"

namespace boresight::gauntlet {

struct Family {
  std::string name;
  double weight;  // of how many scenes
  void (*draw)(Draw&, Scene&);
  std::uint64_t first_seed = 0;  // that may draw it: what earlier seeds draw never changes
};

// All kinds, in an order that never changes: a seed's scene depends on it. New ones go to the end, with a first seed of their own.
const std::vector<Family>& families();

// The law of a drive about a joint whose part reaches this far: smooth, with accelerations of a tenth to a few g.
std::string turning_law(Draw& draw, const Scene& scene, double reach);
std::string sliding_law(Draw& draw, const Scene& scene, double reach);

void draw_gimbal(Draw& draw, Scene& scene);        // gimbals.cpp
void draw_planar_loop(Draw& draw, Scene& scene);   // planar.cpp
void draw_spatial_loop(Draw& draw, Scene& scene);  // spatial.cpp
void draw_platform(Draw& draw, Scene& scene);      // platforms.cpp
void draw_redundant(Draw& draw, Scene& scene);     // redundant.cpp
void draw_arm(Draw& draw, Scene& scene);           // chains.cpp
void draw_pendulum(Draw& draw, Scene& scene);
void draw_sprung_slide(Draw& draw, Scene& scene);
void draw_free_chain(Draw& draw, Scene& scene);
void draw_stage(Draw& draw, Scene& scene);  // stages.cpp

}  // namespace boresight::gauntlet
