// Whether a grid or a box of parameters holds only what a mechanism's file may hold. What its reader asks of several numbers together
// (a cap larger than the bore, a static coefficient no less than the kinetic one) is linear in each of them, so that the box's
// corners speak for all of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/io/document.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

// One side of the box: a parameter, or several of one value, from its least to its largest.
struct BoxSide {
  std::vector<std::string> paths;
  std::string si_unit;
  std::string unit;  // in which it is written: "mm"; "" for a pure number
  double least = 0.0, largest = 0.0;
  Origin least_at = {}, largest_at = {};  // where these are written
};

// Throw what the mechanism's own reader throws where it does not take these settings.
using AcceptsSetting = std::function<void(const Setting&)>;
using AcceptsSettings = std::function<void(const std::vector<Setting>&)>;

// Throws InputError, with the corner named where no side is at fault alone. Without accepts_all each side is asked of alone,
// everything else as the file has it; so is each of more than eight in one section of the file.
void check_corners(const std::vector<BoxSide>& sides, const AcceptsSetting& accepts,
                   const AcceptsSettings& accepts_all);

}  // namespace boresight
