#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/keys/physical_ranges.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// Directions may be given rounded to four digits or so; what is further off perpendicular than this is a mistake.
constexpr double kLargestSkew = 1e-3;

// axes = { x = [...], z = [...] }: two or three of the body's axes in world components. The first of x, y, z that is given is
// kept as it is, the next made exactly perpendicular to it, the last is their product.
Mat3 read_axes(Cursor& body) {
  if (!body.has("axes")) return body.turn();
  Cursor cursor = body.table("axes");
  cursor.only(body_axes_keys());
  const char* const names[3] = {"x", "y", "z"};
  std::vector<int> given;
  Mat3 axes = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!cursor.has(names[k])) continue;
    axes.col(k) = cursor.direction(names[k]);
    for (const int other : given) {
      if (std::abs(axes.col(k).dot(axes.col(other))) > kLargestSkew) {
        cursor.fail_found(names[k], std::string("a direction that is not perpendicular to ") + names[other],
                          "perpendicular axes");
      }
    }
    given.push_back(k);
  }
  if (given.size() < 2) body.fail("axes", "at least two of x, y, z");
  const int a = given[0], b = given[1], c = 3 - a - b;
  axes.col(b) = (axes.col(b) - axes.col(a).dot(axes.col(b)) * axes.col(a)).normalized();
  const double hand = (b - a + 3) % 3 == 1 ? 1.0 : -1.0;  // x y, y z, z x are in order; x z is not
  const Vec3 product = hand * axes.col(a).cross(axes.col(b));
  if (given.size() == 3 && product.dot(axes.col(c)) < 0.0)
    body.fail_found("axes", "left-handed axes", "right-handed axes");
  axes.col(c) = product;
  cursor.finish();
  return axes;
}

// Three principal moments, or six numbers xx yy zz xy xz yz (the off-diagonal elements of the matrix itself, with their sign).
Mat3 read_inertia(Cursor& body) {
  const auto values = body.quantities("inertia");
  Mat3 inertia = Mat3::Zero();
  for (int k = 0; k < 3; ++k) inertia(k, k) = values[k];
  if (values.size() == 6) {
    inertia(0, 1) = inertia(1, 0) = values[3];
    inertia(0, 2) = inertia(2, 0) = values[4];
    inertia(1, 2) = inertia(2, 1) = values[5];
  }
  const double size = inertia.cwiseAbs().maxCoeff();
  if (!(size > 1e-200)) body.fail_found("inertia", "no inertia", "positive principal moments");
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(inertia / size, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(principal[0] > 1e-12)) {
    body.fail_found("inertia", "a principal moment that is not positive", "positive principal moments");
  }
  if (principal[0] + principal[1] < principal[2] * (1.0 - 1e-9)) {
    body.fail_found("inertia", "a principal moment larger than the sum of the other two",
                    "moments that a real body can have");
  }
  return inertia;
}

// Mass and inertia may each be what a real body has, and not belong to one body.
void check_gyration(Cursor& cursor, const BodyDescription& body) {
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(body.inertia, Eigen::EigenvaluesOnly).eigenvalues();
  for (const double moment : {principal[0], principal[2]}) {
    const double radius = std::sqrt(std::max(0.0, moment) / body.mass);
    if (holds(kSizeRange, radius) && radius > 0.0) continue;
    char text[80];
    std::snprintf(text, sizeof text, "a radius of gyration of %.3g m with a mass of %.3g kg", radius, body.mass);
    cursor.fail_found("inertia", text,
                      std::string("radii of gyration from ") + kSizeRange.least + " to " + kSizeRange.most);
  }
}

}  // namespace

void read_mass_and_axes(Cursor& cursor, BodyDescription& body) {
  body.mass = cursor.quantity("mass");
  body.center_of_mass = cursor.vector("center_of_mass");
  body.axes = read_axes(cursor);
  body.inertia = read_inertia(cursor);
  check_gyration(cursor, body);
}

BodyDescription read_body(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(body_keys());
  BodyDescription body;
  body.origin = cursor.origin();
  body.name = read_name(cursor, "name");
  cursor.require(body.name != "ground", "name", "another name: \"ground\" is the ground");
  for (const BodyDescription& other : so_far.bodies) {
    if (other.name == body.name) {
      cursor.fail_found(
          "name", in_quotes(body.name) + " a second time (first in line " + std::to_string(other.origin.line) + ")",
          "a name of its own");
    }
  }
  cursor.rename("body." + body.name);
  read_mass_and_axes(cursor, body);
  if (cursor.has("boresight")) {
    body.boresight = cursor.direction("boresight");
    for (const BodyDescription& other : so_far.bodies) {
      if (other.boresight) {
        cursor.fail_found("boresight", "a second boresight (" + other.name + " has one)", "one body with a boresight");
      }
    }
  }
  cursor.finish();
  return body;
}

PayloadDescription read_payload(Cursor& cursor, const MechanismDescription& so_far) {
  cursor.only(payload_keys());
  PayloadDescription payload;
  payload.origin = cursor.origin();
  payload.body = body_index(so_far, cursor, "body", cursor.text("body"), false);
  payload.mass = cursor.quantity("mass");
  payload.center_of_mass = cursor.vector("center_of_mass");
  const auto radii = cursor.quantities("gyration");
  for (int k = 0; k < 3; ++k) {
    payload.gyration[k] = radii[k];
    if (!(radii[k] >= 0.0)) cursor.fail_found("gyration", "a radius that is negative", "radii of zero or more");
  }
  const Vec3 moments = payload.gyration.cwiseAbs2();
  const double largest = moments.maxCoeff();
  if (moments.sum() - largest < largest * (1.0 - 1e-4)) {  // 1e-4: radii are given rounded
    cursor.fail_found("gyration", "a squared radius larger than the sum of the other two",
                      "radii that a real body can have");
  }
  cursor.finish();
  return payload;
}

}  // namespace boresight
