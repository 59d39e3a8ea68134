// Reads a file of another program into a Drawing. All throw InputError: file, line, key, what was found, what was expected.
#pragma once

#include <string>

#include "exchange/drawing.hpp"

namespace boresight::app {

// By what stands in the file: <robot> is URDF, <sdf> SDF, <mujoco> MJCF.
Drawing read_drawing(const std::string& file);

// URDF: links in a tree, poses by the joints' origins (wiki.ros.org/urdf/XML).
Drawing read_urdf(const std::string& text, const std::string& filename);
// SDF 1.0 to 1.11: models of links and joints, loops among them, poses relative to frames (sdformat.org/spec).
Drawing read_sdf(const std::string& text, const std::string& filename);
// MJCF, as MuJoCo compiles it, files that it includes and defaults and all; needs MuJoCo's library when this program is built.
Drawing read_mjcf(const std::string& filename);

}  // namespace boresight::app
