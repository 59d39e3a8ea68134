// Whether a fit is of the size of its joint. The tolerances of ISO 286 grow with the nominal size, so that a fit of another size
// than the mechanism file's journal_radius is another clearance.
//
// The nominal size lies between the diameters of journal and sleeve, 2 journal_radius and 2 (journal_radius + radial), or off them
// by no more than the fit's own deviations and the rounding of a radius that is written with three digits. Of a ball likewise; of a slider in a
// rectangular guide its width or height, of which the gap on each side is half the difference.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/description.hpp"
#include "boresight_analyses/random/iso_286.hpp"

namespace boresight {

struct JournalSize {
  std::string joint;
  double journal = 0.0, sleeve = 0.0;  // diameters; widths or heights of a slider and its guide [m]
  const char* gap = "radial";          // the number that a fit is of: radial, width_gap, height_gap
  std::string part = "journal";        // what is of that size: a journal, a ball, a slider
};

// Of the joints that clearance.JOINT.radial or clearance.*.radial (likewise width_gap, height_gap) is of; none for another path.
std::vector<JournalSize> journal_sizes(const MechanismDescription& mechanism, const std::string& path);

bool is_of_size(const Fit& fit, const JournalSize& size);
// For messages: what was found, of a fit that is not of this size, and what is expected.
std::string found_size(const Fit& fit, const JournalSize& size);
std::string expected_size(const JournalSize& size);

}  // namespace boresight
