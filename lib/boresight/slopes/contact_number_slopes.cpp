#include "boresight/slopes/contact_number_slopes.hpp"

namespace boresight {

ContactNumbers contact_numbers(const Mechanism& mechanism,
                               const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                               const std::vector<double>& values) {
  static constexpr double kStep = 1e-2;
  static constexpr std::array<double, 4> kWeight = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  ContactNumbers out{joint_plays(mechanism.description(), parameters_at(values)), {}, values};
  for (std::size_t p = 0; p < values.size(); ++p) {
    out.by.emplace_back(out.joints.size());
    for (auto& numbers : out.by.back()) numbers.fill(0.0);
    out.least_speed_by.emplace_back(out.joints.size(), 0.0);
    for (std::size_t k = 0; k < kWeight.size(); ++k)
      for (const double side : {1.0, -1.0}) {
        std::vector<double> moved = values;
        moved[p] = values[p] * std::exp(side * kStep * static_cast<double>(k + 1));
        std::vector<JointPlay> joints = joint_plays(mechanism.description(), parameters_at(moved));
        for (std::size_t c = 0; c < joints.size(); ++c) {
          const double weight = side * kWeight[k] / (kStep * values[p]);
          const std::vector<double*> number = joints[c].numbers();
          for (std::size_t i = 0; i < number.size(); ++i) out.by[p][c][i] += weight * *number[i];
          out.least_speed_by[p][c] += weight * joints[c].minimum_impact_speed;
        }
      }
  }
  return out;
}

}  // namespace boresight
