#include "boresight/play/ball/ball_in_socket.hpp"

#include <cmath>

#include "boresight/play/elastic_part.hpp"

namespace boresight {

BallInSocket::BallInSocket(const ClearanceDescription& description, JointType, const ClearanceParameters& p) {
  clearance = p.radial;
  socket_radius = p.journal_radius + p.radial;
  law = make_normal_law(description.contact_law, description.dissipation_law, p);
  friction = make_friction_law(description.friction_law, p.friction);
}

double BallInSocket::elastic_energy(const PlayMotion<double>& motion) const {
  const double depth = motion.e.norm() - clearance;
  return depth > 0.0 ? law.elastic_energy(depth) : 0.0;
}

BallInSocket BallInSocket::elastic_only() const {
  BallInSocket elastic = *this;
  keep_elastic(elastic.law);
  keep_elastic(elastic.friction);
  return elastic;
}

ContactTangent BallInSocket::tangent(const PlayMotion<double>& motion) const {
  ContactTangent tangent;
  const double distance = motion.e.norm(), depth = distance - clearance;
  if (!(depth > 0.0)) return tangent;
  PlayOffsets n = PlayOffsets::Zero();
  n.head<3>() = std::sqrt(law.elastic_slope(depth)) / distance * motion.e;
  tangent.add(ContactPlace::radial, n);
  return tangent;
}

// e = (c + (F / K)^(2/3)) F / |F|: the load presses it straight against the socket.
RestingPlay BallInSocket::rest_under(const PlayOffsets& load, const JointCoordinates&, const RestingPlay&) const {
  RestingPlay rest;
  const Vec3 push = load.head<3>();
  const double force = push.norm(), reach = clearance + law.depth_under(force);
  rest.radial_reach = {reach, reach};
  if (force > 0.0) rest.motion.e = reach / force * push;
  penetrations(rest.motion, rest.contact);
  rest.contact[static_cast<int>(ContactPlace::radial)].normal_force = force;
  return rest;
}

std::vector<GapPart> BallInSocket::gap_parts(const RestingPlay& rest, const JointCoordinates&) const {
  GapPart part{Eigen::Matrix<double, kMostOffsets, 3>::Zero(), rest.radial_reach[0], 0.0, GapPart::Shape::ball};
  part.offset.topRows<3>().setIdentity();
  return {part};
}

PlayOffsets BallInSocket::widths(double other) const {
  const double width = clearance > 0.0 ? clearance : other;
  PlayOffsets widths = PlayOffsets::Ones();
  widths.head<3>().setConstant(width);
  return widths;
}

PlayOffsets BallInSocket::root_stiffness(double load) const {
  const double deepest = law.depth_under(2.0 * load);
  PlayOffsets root = PlayOffsets::Zero();
  if (deepest > 0.0) root.head<3>().setConstant(std::sqrt(law.elastic_slope(deepest)));
  return root;
}

}  // namespace boresight
