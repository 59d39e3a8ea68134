#include "boresight/mechanism/spanning_tree.hpp"

#include <algorithm>
#include <tuple>

namespace boresight {
namespace {

using Turns = TreeJoint::Turns;

struct Shape {
  std::array<bool, 3> slides = {false, false, false};
  Turns turns = Turns::none;
  bool driven = false;  // by the tree itself
  bool opened = false;
  bool leaves_rows = false;  // free to tilt, and driven or keyed: these rows then close loops of their own

  int speeds() const {
    constexpr std::array<int, 4> kTurning = {0, 1, 2, 3};
    return slides[0] + slides[1] + slides[2] + kTurning[static_cast<int>(turns)] - (driven ? 1 : 0);
  }
};

constexpr std::array<bool, 3> kAlong = {false, true, false};
constexpr std::array<bool, 3> kAcross = {true, false, true};
constexpr std::array<bool, 3> kAnywhere = {true, true, true};

Shape shape_of(const Mechanism& mechanism, int joint, bool with_clearance) {
  const JointDescription& d = mechanism.description().joints[joint];
  const int clearance = mechanism.clearance_of(joint);
  Shape s;
  if (with_clearance && clearance >= 0) {
    const bool tilts = !keeps_axis(d.type) || mechanism.description().clearances[clearance].axes == JournalAxes::free;
    s.slides = kAnywhere;
    const bool keyed = d.type == JointType::prismatic && !rolls(mechanism.description().clearances[clearance], d.type);
    s.turns = tilts ? Turns::ball : keyed ? Turns::none : Turns::about_axis;
    s.driven = d.driven && !tilts;
    s.opened = true;
    s.leaves_rows = tilts && (d.driven || keyed);
    return s;
  }
  s.driven = d.driven;
  switch (d.type) {
    case JointType::revolute:
      s.turns = Turns::about_axis;
      break;
    case JointType::prismatic:
      s.slides = kAlong;
      break;
    case JointType::cylindrical:
      s.slides = kAlong, s.turns = Turns::about_axis;
      break;
    case JointType::planar:
      s.slides = kAcross, s.turns = Turns::about_axis;
      break;
    case JointType::universal:
      s.turns = Turns::about_two_axes;
      break;
    case JointType::spherical:
      s.turns = Turns::ball;
      break;
    case JointType::fixed:
      break;
  }
  return s;
}

TreeJoint tree_joint(const Mechanism& mechanism, int joint, bool from_first, const Shape& shape) {
  const JointDescription& d = mechanism.description().joints[joint];
  const JointGeometry& g = mechanism.geometry(joint);
  TreeJoint t;
  t.joint = joint;
  t.from = from_first ? g.first : g.second;
  t.to = from_first ? g.second : g.first;
  t.parent = t.from.body;
  t.body = t.to.body;
  t.slides = shape.slides;
  t.turns = shape.turns;
  t.driven = shape.driven;
  t.drive_sign = from_first ? 1.0 : -1.0;
  t.speeds = shape.speeds();
  if (d.type == JointType::universal) {
    // The axis fixed in `first` is y; the other one is fixed in `second`.
    const Vec3 other = g.second.R.transpose() * g.second_axis;
    (from_first ? t.second_axis : t.first_axis) = other;
  }
  return t;
}

TreeJoint floating(int body) {
  TreeJoint t;
  t.body = t.to.body = body;
  t.slides = kAnywhere;
  t.turns = Turns::ball;
  t.speeds = 6;
  return t;
}

}  // namespace

SpanningTree::SpanningTree(const Mechanism& mechanism, bool with_clearance) {
  choose(mechanism, with_clearance);
  order_by_branch();
  number();
}

// Prim's algorithm: the tree grows from the ground, each time by the most wanted joint that leads to a new body.
void SpanningTree::choose(const Mechanism& mechanism, bool with_clearance) {
  const std::vector<JointDescription>& joints = mechanism.description().joints;
  std::vector<Shape> shape;
  for (int j = 0; j < mechanism.joints(); ++j) shape.push_back(shape_of(mechanism, j, with_clearance));
  std::vector<int> distance(mechanism.bodies() + 1, -1);  // from the ground, in joints; the ground is the last entry
  const auto at = [&](int body) -> int& { return distance[body == kGround ? mechanism.bodies() : body]; };
  at(kGround) = 0;
  std::vector<bool> in_tree(joints.size(), false);

  for (int reached = 0; reached < mechanism.bodies(); ++reached) {
    // Smallest first: closed joints, of these the ones without a free speed (cut, they would cost six rows each), of the
    // others those nearest to the ground, then those with fewest speeds.
    using Rank = std::tuple<bool, bool, int, int>;
    Rank best_rank;
    int best = -1;
    for (int j = 0; j < mechanism.joints(); ++j) {
      const int first = at(joints[j].first), second = at(joints[j].second);
      if ((first < 0) == (second < 0)) continue;
      const Rank rank(shape[j].opened, shape[j].speeds() > 0, std::max(first, second), shape[j].speeds());
      if (best < 0 || rank < best_rank) best = j, best_rank = rank;
    }
    if (best >= 0) {
      joints_.push_back(tree_joint(mechanism, best, at(joints[best].first) >= 0, shape[best]));
      in_tree[best] = true;
    } else {
      const auto lost = std::find(distance.begin(), distance.end(), -1);
      joints_.push_back(floating(static_cast<int>(lost - distance.begin())));
    }
    at(joints_.back().body) = at(joints_.back().parent) + 1;
  }
  for (int j = 0; j < mechanism.joints(); ++j)
    if (!in_tree[j] || shape[j].leaves_rows) cut_.push_back(j);
}

void SpanningTree::order_by_branch() {
  const int ground = bodies();  // its place in the list below
  std::vector<std::vector<int>> carried(bodies() + 1);
  const auto place = [&](int body) { return body == kGround ? ground : body; };
  for (int k = bodies() - 1; k >= 0; --k) carried[place(joints_[k].parent)].push_back(k);
  std::vector<TreeJoint> ordered;
  std::vector<int> open = carried[ground];
  while (!open.empty()) {
    const TreeJoint& t = joints_[open.back()];
    open.pop_back();
    ordered.push_back(t);
    open.insert(open.end(), carried[t.body].begin(), carried[t.body].end());
  }
  joints_ = std::move(ordered);
}

void SpanningTree::number() {
  last_speed_.resize(joints_.size());
  for (TreeJoint& t : joints_) {
    t.positions = t.speeds + (t.turns == Turns::ball ? 1 : 0);
    t.first_position = positions_;
    t.first_speed = speeds_;
    positions_ += t.positions;
    speeds_ += t.speeds;
    int last = last_speed(t.parent);
    for (int k = t.first_speed; k < speeds_; ++k) {
      speed_parent_.push_back(last);
      last = k;
    }
    last_speed_[t.body] = last;
  }
}

}  // namespace boresight
