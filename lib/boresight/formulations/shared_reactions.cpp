#include "boresight/formulations/shared_reactions.hpp"

#include "boresight/math/dense_solves.hpp"

namespace boresight {

std::vector<PlayOffsets> shared_reactions(const OffsetLayout& layout, const Parameters& parameters, const MatX& B,
                                          const VecX& r, const VecX& near) {
  VecX length = VecX::Zero(layout.size());
  for (int c = 0; c < layout.clearances(); ++c)
    for (int k = 0; k < layout.joint(c).count(); ++k)
      if (layout.joint(c).released(k))
        length[layout.joint(c).first + k] = k < 3 ? 1.0 : tilt_lever(parameters.clearance[c]);
  const MatX in_lengths = length.asDiagonal() * B;
  VecX f = VecX::Zero(layout.size());
  if (near.size() > 0) f = (length.array() > 0.0).select(near, 0.0);
  f -= length.cwiseProduct(solve_least(MatX(in_lengths.transpose()), VecX(r + B.transpose() * f)));
  std::vector<PlayOffsets> loads(static_cast<std::size_t>(layout.clearances()), PlayOffsets::Zero());
  for (int c = 0; c < layout.clearances(); ++c)
    loads[static_cast<std::size_t>(c)].head(layout.joint(c).count()) =
        f.segment(layout.joint(c).first, layout.joint(c).count());
  return loads;
}

}  // namespace boresight
