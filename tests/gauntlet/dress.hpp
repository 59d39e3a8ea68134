// What every kind of mechanism gets: masses and inertias of its bodies, play in a subset of its joints with any law of
// contact and friction, springs, loads, gravity, and a place in space.
#pragma once

#include "draw.hpp"
#include "scene.hpp"

namespace boresight::gauntlet {

void finish_bodies(Draw& draw, Scene& scene);
void add_plays(Draw& draw, Scene& scene);
void add_forces(Draw& draw, Scene& scene);
void place_in_space(Draw& draw, Scene& scene);

}  // namespace boresight::gauntlet
