// Where a journal rests under a load on its offsets.
//
// Parallel axes, load r = (r_x, r_y, r_z):
//   xi_rad = (c_r + (|r_rad| / K)^(2/3)) r_rad / |r_rad|           Hertz, pressed against the bore
//   xi_ax  = sign(r_ax) (c_a + |r_ax| / K_c)                        once |r_ax| exceeds what friction holds, mu |r_rad|;
//                                                                   until then the journal stays where it was axially
// A journal that may tilt also carries a couple g on its slopes. It rests where its elastic energy less the work of the load,
//   V(e, sigma) = U_ends + U_rings - r . e - g . sigma,
// is least (tilted_journal.hpp has the contacts). V is convex, so there is one such place, or a set of places between which
// no force decides: the one nearest to where the journal was. The ends and the faces share the couple as their stiffness
// decides: under an axial load a cap stands evenly on its face until the couple lifts its edge.
// Friction holds the axial place as above, by the forces of both ends.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/play/journal/journal_in_sleeve.hpp"
#include "boresight/play/search_for_rest.hpp"

namespace boresight {
namespace {

using Vec2 = Vec2T<double>;
// Those that a journal frees: x y z of its centre, slopes x z.
using Offsets = Eigen::Matrix<double, 5, 1>;
using Stiffness = Eigen::Matrix<double, 5, 5>;

// Of a place: a few units in its last digit. Under small loads a stiff contact makes more of these than rest::kBalance.
constexpr double kRoundingOfPlace = 8.0 * std::numeric_limits<double>::epsilon();
// Steps that follow it, and the share of the largest stiffness that holds nothing.
constexpr int kLastSteps = 2;
constexpr double kSoft = 1e-12;

Vec2 rest_along(const Vec2& force, double clearance, const NormalLaw& law, double& reach) {
  const double size = force.norm();
  reach = clearance + law.depth_under(size);
  return size > 0.0 ? Vec2(reach / size * force) : Vec2(Vec2::Zero());
}

void rest_parallel(const JournalInSleeve& joint, const Vec3& load, const RestingPlay& before, RestingPlay& rest) {
  Vec3& e = rest.motion.e;
  const Vec2 radial(load.x(), load.z());
  const Vec2 at = rest_along(radial, joint.radial_clearance, joint.radial_law, rest.radial_reach[0]);
  rest.radial_reach[1] = rest.radial_reach[0];
  e << at.x(), 0.0, at.y();
  double axial_force = 0.0;
  if (joint.has_faces) {
    const double along = std::abs(load.y());
    rest.axial_reach = joint.axial_clearance + along / joint.face_stiffness;
    const bool slips = along > joint.friction.stiction * radial.norm();
    axial_force = slips ? along : 0.0;
    e.y() = slips ? std::copysign(rest.axial_reach, load.y())
                  : std::clamp(before.motion.e.y(), -joint.axial_clearance, joint.axial_clearance);
  }
  joint.penetrations(rest.motion, rest.contact);
  rest.contact[static_cast<int>(ContactPlace::radial)].normal_force = radial.norm();
  rest.contact[static_cast<int>(e.y() > 0.0 ? ContactPlace::axial_minus : ContactPlace::axial_plus)].normal_force =
      axial_force;
}

// A tilting journal under a load: its elastic energy less the load's work, V, with gradient and Hessian. V is
// convex: each end is pressed by how far it lies outside a disc, each ring by planes' depths over its points.
class PressedJournal {
 public:
  // hold: the axial place is given (friction or a slide keeps it).
  PressedJournal(const JournalInSleeve& joint, const Offsets& load, bool hold_axially)
      : joint_(joint), load_(load), hold_(hold_axially) {
    unit_ << 1.0, 1.0, 1.0, 1.0 / joint.half_length, 1.0 / joint.half_length;
    if (hold_) load_[1] = 0.0;
    size_ = load_.cwiseProduct(unit_).norm();
  }

  void set(const Offsets& offsets) {
    offsets_ = offsets;
    motion_.e = offsets.head<3>();
    motion_.slope = offsets.tail<2>();
    value_ = joint_.elastic_energy(motion_) - load_.dot(offsets);
    gradient_ = -load_;
    curvature_.setZero();
    const TiltedJournal& t = joint_.tilted;
    for (int side : {-1, 1}) {
      const double reach = side * t.half_length - (t.slides ? motion_.e.y() : 0.0);
      const Vec2 at(motion_.e.x() + reach * motion_.slope[0], motion_.e.z() + reach * motion_.slope[1]);
      const double distance = at.norm(), depth = distance - t.radial_clearance;
      double& F = end_force_[side < 0 ? 0 : 1];
      F = depth > 0.0 ? t.end_law.elastic_force(depth) : 0.0;
      if (depth > 0.0) {
        const Vec2 n = at / distance;
        Offsets along, across;
        along << n.x(), 0.0, n.y(), reach * n.x(), reach * n.y();
        across << -n.y(), 0.0, n.x(), -reach * n.y(), reach * n.x();
        gradient_ += F * along;
        curvature_ += F / distance * across * across.transpose();
      }
      if (!t.has_faces) continue;
      const double tilt = motion_.slope.norm(), swing = t.ring_radius * tilt;
      const RingForce<double> ring = ring_contact(t.face_stiffness, -side * motion_.e.y() - t.axial_clearance, swing);
      face_force_[side < 0 ? 0 : 1] = ring.force;
      gradient_[1] -= side * ring.force;
      if (tilt > 0.0) gradient_.tail<2>() += ring.force * ring.moment_arm * t.ring_radius / tilt * motion_.slope;
    }
    const ContactTangent tangent = joint_.tangent(motion_);
    for (int k = 0; k < tangent.count; ++k) {
      const Offsets n = tangent.column[k].n.head<5>();
      curvature_ += n * n.transpose();
    }
    // Slopes as displacements of the sleeve's ends.
    gradient_ = gradient_.cwiseProduct(unit_);
    curvature_ = unit_.asDiagonal() * curvature_ * unit_.asDiagonal();
    if (!hold_) return;
    gradient_[1] = 0.0;
    curvature_.row(1).setZero();
    curvature_.col(1).setZero();
  }

  // Where the ends alone carry the load, statics says what each of them carries, and each lies in the direction of its own share: exact
  // wherever no face carries a part. False where nothing presses an end, so that no force says where it lies.
  bool rest_on_ends(Offsets& at) const {
    const TiltedJournal& t = joint_.tilted;
    const double along = t.slides ? at[1] : 0.0, span = 2.0 * t.half_length;
    const Vec2 force(load_[0], load_[2]), couple(load_[3], load_[4]);
    Vec2 place[2];
    for (int side : {-1, 1}) {
      const Vec2 share = (side * couple + (t.half_length + side * along) * force) / span;
      const double size = share.norm();
      if (!(size > rest::kBalance * size_)) return false;
      place[side < 0 ? 0 : 1] = (t.radial_clearance + t.end_law.depth_under(size)) / size * share;
    }
    const Vec2 slope = (place[1] - place[0]) / span, middle = 0.5 * (place[0] + place[1]) + along * slope;
    at << middle.x(), at[1], middle.y(), slope;
    return true;
  }

  // What no force moves stays.
  Offsets rest_near(const Offsets& before) {
    Offsets on_ends = before;
    const bool ends = rest_on_ends(on_ends);
    if (ends) {
      set(on_ends);
      if (balanced()) return on_ends;
    }
    // Faces carry a part, or nothing presses an end. A journal that the load has turned away from rolls round its sleeve in ever shorter
    // steps where its contacts are stiff, and may not arrive.
    const Offsets rolled = rest_down_from(before);
    if (!ends || balanced()) return rolled;
    const double left = gradient_.norm();
    const Offsets across = rest_down_from(on_ends);
    if (gradient_.norm() < left) return across;
    set(rolled);
    return rolled;
  }

  // Levenberg's and Marquardt's way down from where a journal was.
  Offsets rest_down_from(Offsets at) {
    const double room = std::max(joint_.radial_clearance, joint_.tilted.end_law.depth_under(size_));
    double damping = size_ > 0.0 ? size_ / room : 1.0;
    set(at);
    for (int k = 0; k < rest::kIterations && !balanced(); ++k) {
      const double value = value_, residual = gradient_.norm();
      Stiffness damped = curvature_;
      damped.diagonal().array() += damping;
      const Offsets step = -damped.ldlt().solve(gradient_);
      const Offsets next = at + unit_.cwiseProduct(step);
      set(next);
      const double rounding = 1e-12 * (std::abs(value) + size_ * room);
      if (value_ < value - rounding || (value_ <= value + rounding && gradient_.norm() < residual)) {
        at = next;
        damping *= 0.1;
        if (step.norm() <= rest::kShortestStep * room) break;
        continue;
      }
      damping = std::max(10.0 * damping, 1e-6 * size_ / room);
      set(at);
      if (step.norm() <= rest::kShortestStep * room) break;
    }
    return balanced() ? polished(at) : at;
  }

  // Undamped steps near the rest, of which each doubles the digits: whether friction holds a journal hangs on them.
  Offsets polished(Offsets at) {
    for (int k = 0; k < kLastSteps; ++k) {
      const double residual = gradient_.norm();
      Stiffness damped = curvature_;
      damped.diagonal().array() += kSoft * curvature_.norm();
      const Offsets next = at - unit_.cwiseProduct(damped.ldlt().solve(gradient_));
      set(next);
      if (!(gradient_.norm() < residual)) {
        set(at);
        break;
      }
      at = next;
    }
    return at;
  }

  // To what digits of the place leave of the forces.
  bool balanced() const {
    const double place = unit_.cwiseInverse().cwiseProduct(offsets_).norm();
    return gradient_.norm() <= rest::kBalance * size_ + kRoundingOfPlace * place * curvature_.norm();
  }
  double end_force(int end) const { return end_force_[end]; }
  double face_force(int face) const { return face_force_[face]; }

 private:
  const JournalInSleeve& joint_;
  Offsets load_, unit_, offsets_ = Offsets::Zero();
  bool hold_;
  double size_ = 0.0;
  PlayMotion<double> motion_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double value_ = 0.0;
  Offsets gradient_;
  Stiffness curvature_;
  std::array<double, 2> end_force_ = {}, face_force_ = {};
};

void rest_tilted(const JournalInSleeve& joint, const Offsets& load, double slide, const RestingPlay& before,
                 RestingPlay& rest) {
  const TiltedJournal& t = joint.tilted;
  Offsets start;
  start << before.motion.e, before.motion.slope;
  if (t.slides) start[1] = slide;
  PressedJournal free(joint, load, !t.has_faces), held(joint, load, true);
  PressedJournal* by = &free;
  Offsets at;
  double axial_force = std::abs(load[1]);
  bool stays = false;
  if (t.has_faces && t.friction.stiction > 0.0) {
    // Along its axis it stays where it was, as long as the ends' friction carries what load and faces push.
    start[1] = std::clamp(start[1], -t.axial_clearance, t.axial_clearance);
    at = held.rest_near(start);
    stays = std::abs(load[1] + held.face_force(1) - held.face_force(0)) <=
            t.friction.stiction * (held.end_force(0) + held.end_force(1));
  }
  if (stays) {
    by = &held;
    axial_force = 0.0;
  } else {
    at = free.rest_near(start);
  }
  PlayMotion<double>& m = rest.motion;
  m.e = at.head<3>();
  m.slope = at.tail<2>();
  joint.penetrations(m, rest.contact);
  for (int end : {0, 1}) {
    ContactState<double>& contact = rest.contact[static_cast<int>(TiltedJournal::radial_place(end == 0 ? -1 : 1))];
    contact.normal_force = by->end_force(end);
    rest.radial_reach[end] = t.radial_clearance + std::max(0.0, contact.penetration);
  }
  if (!t.has_faces) return;
  for (int face : {0, 1})
    rest.contact[static_cast<int>(TiltedJournal::axial_place(face == 0 ? -1 : 1))].normal_force = by->face_force(face);
  rest.axial_reach = t.axial_clearance + axial_force / t.face_stiffness;
  if (!stays) rest.axial_reach = std::max(rest.axial_reach, std::abs(m.e.y()));
}

}  // namespace

RestingPlay JournalInSleeve::rest_under(const PlayOffsets& load, const JointCoordinates& joint,
                                        const RestingPlay& before) const {
  RestingPlay rest;
  if (tilts)
    rest_tilted(*this, load.head<5>(), joint.slide, before, rest);
  else
    rest_parallel(*this, load.head<3>(), before, rest);
  return rest;
}

}  // namespace boresight
