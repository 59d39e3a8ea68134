// A mechanism that was imported from text in a test.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "exchange/mechanism_text.hpp"
#include "exchange/readers.hpp"

namespace boresight::app {

// By way of the file that the import writes.
inline MechanismDescription imported(Drawing drawing, const ImportChoices& choices = {}) {
  const Assembly assembly = assembled(std::move(drawing), choices);
  const MechanismDescription read =
      read_mechanism_text(mechanism_text(assembly, "test", choices.duration), "test.toml");
  Mechanism{read};
  return read;
}

inline int index_of(const std::vector<BodyDescription>& bodies, const std::string& name) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == name) return static_cast<int>(i);
  ADD_FAILURE() << "no body " << name;
  return 0;
}

inline const JointDescription& joint_called(const MechanismDescription& m, const std::string& name) {
  for (const JointDescription& joint : m.joints)
    if (joint.name == name) return joint;
  ADD_FAILURE() << "no joint " << name;
  return m.joints.front();
}

// Moments about the world's axes at home.
inline Mat3 inertia_in_world(const BodyDescription& body) { return body.axes * body.inertia * body.axes.transpose(); }

inline void expect_near(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance,
                        const std::string& what = "") {
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance) << what << "\n" << a << "\nbeside\n" << b;
}

}  // namespace boresight::app
