// A mechanism: bodies, joints, drives, clearances, checked and ready to be computed with. Immutable, shared by all threads.
//
// A joint is two frames that coincide at home, one fixed in each of its bodies: origin at the joint's point, y along its
// axis, z the world's z made perpendicular to the axis (the world's x where the axis is within 25 degrees of z), x = y cross z.
// In a joint with clearance the frame of the body that carries the sleeve is "the sleeve frame".
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "boresight/math/types.hpp"
#include "boresight/mechanism/description.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight/pointing/pointing.hpp"

namespace boresight {

// One of a joint's two frames, fixed in a body (or in the world where the body is the ground).
struct JointFrame {
  int body = kGround;
  Vec3 p = Vec3::Zero();      // origin from the body's centre of mass, body axes [m]
  Mat3 R = Mat3::Identity();  // R_BJ: columns are the joint's x, y (its axis), z in body axes
};

struct JointGeometry {
  JointFrame first, second;
  Vec3 second_axis = Vec3::UnitX();  // universal only: in the axes of the second body
};

// Mass, first moment and inertia of one body with what it carries, about the body's own centre of mass, body axes.
struct MassProperties {
  double mass = 0.0;            // [kg]
  Vec3 c = Vec3::Zero();        // from the body's own centre of mass to the combined one, body axes [m]
  Mat3 inertia = Mat3::Zero();  // about the combined centre of mass, body axes [kg m^2]
};

struct OffsetChoice;

class Mechanism {
 public:
  // Throws InputError, with the origin of the thing at fault, where the description contradicts itself.
  explicit Mechanism(MechanismDescription description);
  // The drawn mechanism with other joint frames, and with its drives on these laws: built_mechanism.hpp.
  Mechanism(const Mechanism& drawn, std::vector<JointGeometry> geometry, std::map<int, TimeFunctionPtr> drives,
            std::shared_ptr<const OffsetChoice> choice);

  const MechanismDescription& description() const { return description_; }
  const std::string& name() const { return description_.name; }
  double duration() const { return description_.motion.duration; }

  // The numbers as the file gives them; copy, change, and hand to a rung.
  const Parameters& parameters() const { return parameters_; }
  // The same drawing with other numbers, such as one sample's.
  Mechanism with(Parameters parameters) const {
    Mechanism other = *this;
    other.parameters_ = std::move(parameters);
    return other;
  }

  int bodies() const { return static_cast<int>(description_.bodies.size()); }
  int joints() const { return static_cast<int>(description_.joints.size()); }
  int clearances() const { return static_cast<int>(description_.clearances.size()); }
  const JointGeometry& geometry(int joint) const { return geometry_[joint]; }
  // Whether this is a drawn mechanism with errors: its frames need not coincide at home.
  bool built() const { return built_; }
  // Of a built mechanism: which offsets of the drawn one are coordinates; null where all are (offset_choice.hpp). The others follow where
  // errors leave redundant joints with play to go.
  const OffsetChoice* offset_choice() const { return offset_choice_.get(); }

  int boresight_body() const { return boresight_body_; }
  const Vec3& boresight_B() const { return pointing_.boresight_B; }  // pointing axis in that body's axes
  const Pointing& pointing() const { return pointing_; }             // that axis, and the line of sight if there is one
  int body_index(const std::string& name) const;                     // -1 if there is none

  // Index of the clearance on this joint, or -1.
  int clearance_of(int joint) const { return clearance_of_[joint]; }

  // Per body. A varied body mass keeps the inertia of the file; the payload's inertia is mass times gyration squared.
  std::vector<MassProperties> mass_properties(const Parameters& parameters) const;

  // Longest distance between two joints' points, the length that turns angles into displacements in norms [m].
  double characteristic_length() const { return characteristic_length_; }

 private:
  MechanismDescription description_;
  Parameters parameters_;
  std::vector<JointGeometry> geometry_;
  std::vector<int> clearance_of_;
  int boresight_body_ = 0;
  bool built_ = false;
  std::shared_ptr<const OffsetChoice> offset_choice_;
  Pointing pointing_;
  double characteristic_length_ = 1.0;
};

}  // namespace boresight
