// What a rig's channels read of a motion that a rung has computed; and data made that way.
#pragma once

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/calibration/calibration_problem.hpp"

namespace boresight {

// The channel (index into channel_names()) of a sampled pose.
// place_B: of a displacement, where it is measured: MeasuredData::place_of().
double channel_reading(int channel, const PoseSample& sample, const Vec3& boresight_B,
                       const Vec3& place_B = Vec3::Zero());

// Readings at `times` (rising, from 0) of the multibody rung's motion, contacts located: times x channels.
// places_B: where each is measured; empty: at the body's origin. implicit: by steps that no damped contact keeps short. Throws ComputationError.
MatX multibody_readings(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters,
                        const std::vector<double>& times, const std::vector<int>& channels,
                        const std::vector<Vec3>& places_B = {}, bool implicit = false);

struct SyntheticRig {
  std::vector<int> channels = {0, 1, 2, 3, 4, 5};
  double spacing = 1e-3;     // of the samples [s]
  int samples = 0;           // so many instead, at equal times up to the motion's end; 0: spacing
  double noise = 0.01;       // of the channel's kind's largest rms (displacements, rotations), relative
  double deviation = 0.0;    // instead: the noise's standard deviation, of all channels [SI]; 0: noise
  double time_offset = 0.0;  // the rig's clock is this much early [s]
  VecX bias;                 // per channel; empty: none
  double outliers = 0.0;     // share of the readings that are gross errors of 20 to 50 deviations
  std::uint64_t seed = 1;
};
// When such a rig reads a motion of this duration.
std::vector<double> sample_times(const SyntheticRig& rig, double duration);
// Readings of `clean` (multibody_readings at the times of `data`) with what a rig adds. run: tells runs'
// noises apart.
MeasuredData with_rig_errors(const SyntheticRig& rig, const std::vector<double>& times, const MatX& clean, int run);

// As read_measured_data reads it, in um and urad.
std::string csv_of(const MeasuredData& data);

// The same, with a last line that says that it is synthetic, by which is_synthetic() knows it again as long as nobody changed it:
// measured data that are there under the same name are not overwritten by synthetic ones.
std::string synthetic_csv_of(const MeasuredData& data);
bool is_synthetic(const std::string& csv);

}  // namespace boresight
