// What standing errors displace the boresight body by at the instants of a run: exactly, by closing the joints of the mechanism as it is
// built; and how that follows the errors.
//
// The slopes are the columns of influence of the drawn mechanism (error_influence.hpp): off by the relative size of the errors, a
// thousandth of themselves for a milliradian. A fit that is exact in value converges with them to where they say (a simplified Newton
// method: Deuflhard 2011, Newton Methods for Nonlinear Problems, 2.1.2), and its standard errors are off by as little.
#pragma once

#include <memory>
#include <vector>

#include "boresight/mechanism/built_mechanism.hpp"

namespace boresight {

class StandingPoses {
 public:
  // times: of the run's readings. weight: of each fitted parameter, by how much each error of the mechanism follows it (errors x fitted).
  // Throws ComputationError as ErrorInfluence::at does.
  StandingPoses(std::shared_ptr<const Mechanism> mechanism, std::shared_ptr<const IdealMotion> commanded,
                const std::vector<double>& times, MatX weight);

  // Of a sample's boresight body at some instants: displacement of its centre of mass and rotation vector from the commanded pose, world
  // axes [m, rad]. Throws ComputationError where the built mechanism's joints do not close.
  std::vector<Vec6> displacements(const Parameters& sample, const std::vector<double>& times) const;
  // Of it at a reading: 6 x fitted, by the fitted parameters.
  const MatX& slopes(int reading) const { return slopes_[static_cast<std::size_t>(reading)]; }

 private:
  std::shared_ptr<const Mechanism> mechanism_;
  std::shared_ptr<const IdealMotion> commanded_;
  std::vector<MatX> slopes_;
};

}  // namespace boresight
