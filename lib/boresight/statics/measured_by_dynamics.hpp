// A rung without dynamics, together with the error of its indices that impacts, vibration, friction and the
// start bring: measured, by the same motion on the perturbation rung.
//
// What a journal at rest leaves out hangs on too much to be foreseen from the reactions alone: how often they
// turn, how long bounces last against the motion, what friction holds. So the rung with dynamics is asked:
// three motions, at its own step, at one 3 percent smaller and at half of it, for impacts make each of them a
// draw. With q an index of the static rung, m the mean of the three and s their range, the error stated is
//   (|q - m| + 1.5 s) / min(q, m)    and what the perturbation rung states for its own model besides, as closely as the caller looks,
// the largest over maximum, RMS and mean of the position error and of the orientation and boresight errors,
// as far as these weigh against each other on the mechanism's size.
//
// Measured once, at the mechanism's own parameters; for samples that depart from them by more than a factor of two
// in some number, or are not zero where these are, once for all that share the nearest powers of two, at these. So it does not matter in which
// order, or on which thread, samples come.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

// bounds: whether the rung's indices are meant as upper bounds; what exceeds them is then a warning.
std::unique_ptr<Rung> with_error_measured_by_dynamics(std::unique_ptr<Rung> rung,
                                                      std::shared_ptr<const Mechanism> mechanism, bool bounds);

}  // namespace boresight
