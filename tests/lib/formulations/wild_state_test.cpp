// What an implicit method's iterations meet on their way: states that no motion has.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/multibody/multibody_system.hpp"
#include "published_examples.hpp"

namespace boresight {
namespace wild_state_test {

struct Followed {
  explicit Followed(const std::string& name)
      : mechanism(scenes::example(name)),
        ideal(ideal_motion(*mechanism, mechanism->parameters())),
        formulation(make_tree_formulation(*mechanism, mechanism->parameters(), &ideal, {})) {
    for (int c = 0; c < formulation->forces().clearances(); ++c)
      trackers.emplace_back(c, "", formulation->forces().joint(c), true);
    IdealState start;
    ideal.state(0.0, start);
    formulation->start(start, y);
    system = std::make_unique<MultibodySystem>(*formulation, trackers, mechanism->characteristic_length());
    system->start(0.0, y);
  }
  MatX jacobian(const VecX& state) {
    MatX J(y.size(), y.size());
    system->jacobian(0.0, state, J);
    return J;
  }

  std::shared_ptr<const Mechanism> mechanism;
  IdealMotion ideal;
  std::unique_ptr<Formulation> formulation;
  std::vector<ContactTracker> trackers;
  VecX y;
  std::unique_ptr<MultibodySystem> system;
};

// An exception would end the motion; numbers that are none have the step tried again, shorter.
TEST(MultibodySystem, HasNoDerivativesWhereItCannotBeFollowedAndTheSameOnesAfterwards) {
  for (const char* name : {"3-rrcpr", "spatial-slider-crank"}) {
    Followed followed(name), fresh(name);
    VecX wild = followed.y;
    wild[0] = std::numeric_limits<double>::infinity();
    MatX J;
    ASSERT_NO_THROW(J = followed.jacobian(wild)) << name;
    EXPECT_FALSE(J.allFinite()) << name;
    EXPECT_FALSE(followed.system->fault().empty()) << name;
    const MatX expected = fresh.jacobian(fresh.y);
    ASSERT_TRUE(expected.allFinite()) << name;
    EXPECT_TRUE(followed.jacobian(followed.y) == expected) << name;
  }
}

}  // namespace wild_state_test
}  // namespace boresight
