#include "boresight/formulations/shared_reactions.hpp"

#include <utility>

namespace boresight {

SharedReactions::SharedReactions(const OffsetLayout& layout, const Parameters& parameters, MatX B)
    : layout_(layout), B_(std::move(B)), length_(VecX::Zero(layout.size())) {
  for (int c = 0; c < layout.clearances(); ++c)
    for (int k = 0; k < layout.joint(c).count(); ++k)
      if (layout.joint(c).released(k))
        length_[layout.joint(c).first + k] = k < 3 ? 1.0 : tilt_lever(parameters.clearance[c]);
  const MatX in_lengths = length_.asDiagonal() * B_;
  if (in_lengths.size() > 0)
    least_.compute(in_lengths.transpose());  // Eigen's decomposition reads beyond a matrix that is empty
}

std::vector<PlayOffsets> SharedReactions::of(const VecX& r, const VecX& near) const {
  VecX f = VecX::Zero(layout_.size());
  if (near.size() > 0) f = (length_.array() > 0.0).select(near, 0.0);
  if (B_.size() > 0) f -= length_.cwiseProduct(least_.solve(VecX(r + B_.transpose() * f)));
  std::vector<PlayOffsets> loads(static_cast<std::size_t>(layout_.clearances()), PlayOffsets::Zero());
  for (int c = 0; c < layout_.clearances(); ++c)
    loads[static_cast<std::size_t>(c)].head(layout_.joint(c).count()) =
        f.segment(layout_.joint(c).first, layout_.joint(c).count());
  return loads;
}

}  // namespace boresight
