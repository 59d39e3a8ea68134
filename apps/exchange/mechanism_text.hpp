// An imported mechanism as the text of a mechanism file, with comments on what was assumed and what was left out.
#pragma once

#include <string>

#include "exchange/assembly.hpp"

namespace boresight::app {

// source: "gimbal.urdf (URDF)".
std::string mechanism_text(const Assembly& assembly, const std::string& source, const std::string& duration);

// "line 3, 8 and 12: shapes": remarks of one text in one line each, in the order of the file.
std::vector<std::string> grouped(const std::vector<Remark>& remarks);

}  // namespace boresight::app
