// Which joints hold each other where they do not close. What a loop lacks is shared among all of its joints, by how each of them turns and
// where it stands: none of them is more to blame than another, wherever the error is.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// open: what each joint is left open by, in characteristic lengths or radians. "joint "A" does" or "joints "A", "B" and "C" do": all that have
// their share in it, the first of many by name.
std::string strained_joints(const Mechanism& mechanism, const std::vector<double>& open);

}  // namespace boresight
