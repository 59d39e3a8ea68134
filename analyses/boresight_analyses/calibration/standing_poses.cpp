#include "boresight_analyses/calibration/standing_poses.hpp"

#include <algorithm>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_influence.hpp"
#include "boresight/mechanism/ideal_solver.hpp"
#include "boresight/pointing/indices.hpp"

namespace boresight {

StandingPoses::StandingPoses(std::shared_ptr<const Mechanism> mechanism, std::shared_ptr<const IdealMotion> commanded,
                             const std::vector<double>& times, MatX weight)
    : mechanism_(std::move(mechanism)), commanded_(std::move(commanded)) {
  std::vector<bool> wanted(static_cast<std::size_t>(weight.rows()));
  for (std::size_t e = 0; e < wanted.size(); ++e)
    wanted[e] = weight.cols() > 0 && weight.row(static_cast<Eigen::Index>(e)).cwiseAbs().maxCoeff() > 0.0;
  const bool any = std::find(wanted.begin(), wanted.end(), true) != wanted.end();
  ErrorInfluence influence(*mechanism_, *commanded_);
  MatX G;
  for (const double t : times) {
    if (any) {
      influence.at(t, wanted, G);
      slopes_.emplace_back(G.middleRows<6>(6 * mechanism_->boresight_body()) * weight);
    } else {
      slopes_.emplace_back(MatX::Zero(6, weight.cols()));
    }
  }
}

std::vector<Vec6> StandingPoses::displacements(const Parameters& sample, const std::vector<double>& times) const {
  const auto built = built_mechanism(*mechanism_, sample, commanded_);
  IdealSolver solver(*built);
  const int body = mechanism_->boresight_body();
  std::vector<Vec6> out;
  IdealState state;
  for (const double t : times) {
    commanded_->state(t, state);
    const BodyMotion commanded = state.bodies[static_cast<std::size_t>(body)];
    if (!solver.solve(t, state))
      throw ComputationError(
          "with these errors the joints of the built mechanism do not close at t = " + std::to_string(t) + " s");
    const BodyMotion& is = state.bodies[static_cast<std::size_t>(body)];
    const PoseError off = pose_error({is.p, Quat(is.R)}, {commanded.p, Quat(commanded.R)}, mechanism_->pointing());
    out.emplace_back();
    out.back() << off.displacement, off.rotation;
  }
  return out;
}

}  // namespace boresight
