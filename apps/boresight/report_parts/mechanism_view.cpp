#include "report_parts/mechanism_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "boresight/math/singular_values.hpp"
#include "report_parts/report_parts.hpp"

namespace boresight::app {
namespace {

constexpr double kMmPerM = 1e3;
constexpr double kNowhere = 1e-12;   // a deviation that is rounding [m]
constexpr double kSamePlace = 1e-9;  // of the mechanism's size
constexpr double kTip = 0.035;       // half the length of an axis, of the mechanism's size
constexpr double kRay = 0.4;         // length of the boresight, likewise

// A point fixed in a body.
struct BodyPoint {
  int body = kGround;
  Vec3 p = Vec3::Zero();  // from its centre of mass, body axes
};

Vec3 at(const BodyPoint& point, const std::vector<Pose>& pose) {
  if (point.body == kGround) return point.p;
  return pose[point.body].p + pose[point.body].q * point.p;
}

class ViewBuilder {
 public:
  ViewBuilder(const Mechanism& mechanism, const RunResult& result) : mechanism_(mechanism), result_(result) {
    Vec3 least = Vec3::Constant(1e300), most = -least;
    const auto reach = [&](const Vec3& p) { least = least.cwiseMin(p), most = most.cwiseMax(p); };
    for (const JointDescription& joint : mechanism.description().joints) reach(joint.point);
    for (const BodyDescription& body : mechanism.description().bodies) reach(body.center_of_mass);
    size_ = (most - least).norm();
    on_body_.resize(mechanism.bodies() + 1);
  }

  report::View build() {
    view_ = {.title = "The mechanism in motion", .caption = caption(), .unit = "mm"};
    for (const Frame& frame : result_.frames) view_.time.push_back(result_.time[frame.sample]);
    for (int j = 0; j < mechanism_.joints(); ++j) add_joint(j);
    add_body("ground", kGround);
    for (int b = 0; b < mechanism_.bodies(); ++b) add_body(mechanism_.description().bodies[b].name, b);
    const int body = mechanism_.boresight_body();
    view_.rays.push_back({.name = "boresight of " + mechanism_.description().bodies[body].name,
                          .from = add({body, Vec3::Zero()}),
                          .to = add({body, kRay * size_ * mechanism_.boresight_B()})});
    return std::move(view_);
  }

 private:
  std::string caption() const {
    std::string text = fmt::format("{} instants of the motion, on the {} rung.", result_.frames.size(), result_.rung);
    if (mechanism_.clearances() > 0)
      text +=
          " Each point is moved off its ideal place by its deviation times the exaggeration: joints without "
          "clearance stay closed, and bodies look strained where the exaggeration is large. Play is drawn with the dot "
          "of the moving part's centre, exaggerated alike: " +
          rooms() + ".";
    return text;
  }

  // How the room of each kind of play that there is is drawn.
  std::string rooms() const {
    bool journals = false, balls = false, pads = false, corners = false, sliders = false;
    for (int c = 0; c < mechanism_.clearances(); ++c)
      (is_ball(mechanism_, c)                                ? balls
       : is_pad(mechanism_, c) && has_corners(parameters(c)) ? corners
       : is_pad(mechanism_, c)                               ? pads
       : is_slider(mechanism_, c)                            ? sliders
                                                             : journals) = true;
    std::string text;
    for (const auto& [there, says] : {std::pair{journals, "a journal's in its sleeve as a ring"},
                                      std::pair{balls, "a ball's in its socket as three rings"},
                                      std::pair{pads, "a pad's between its faces as two rings of the pad's size"},
                                      std::pair{corners, "a rectangular pad's as two rectangles of its size"},
                                      std::pair{sliders, "a slider's in its guide as a rectangle"}})
      if (there) text += (text.empty() ? "" : ", ") + std::string(says);
    return text;
  }

  const ClearanceParameters& parameters(int c) const {
    return mechanism_.parameters().clearance[static_cast<std::size_t>(c)];
  }

  int add(const BodyPoint& point) {
    if (point.body == kGround) {
      report::ViewPoint still;
      put({&still.x, &still.y, &still.z}, point.p);
      view_.points.push_back(std::move(still));
      return static_cast<int>(view_.points.size()) - 1;
    }
    return add_moving([&](const Frame&) { return point; });
  }

  // A point that need not stay in its place in the body.
  template <typename PointOf>
  int add_moving(const PointOf& point_of) {
    report::ViewPoint track;
    double most = 0.0;
    for (const Frame& frame : result_.frames) {
      const BodyPoint point = point_of(frame);
      const Vec3 ideal = at(point, frame.ideal), off = at(point, frame.pose) - ideal;
      put({&track.x, &track.y, &track.z}, ideal);
      put({&track.dx, &track.dy, &track.dz}, off);
      most = std::max(most, off.norm());
    }
    if (most < kNowhere || mechanism_.clearances() == 0)
      for (report::Numbers* numbers : {&track.dx, &track.dy, &track.dz}) numbers->clear();
    view_.points.push_back(std::move(track));
    return static_cast<int>(view_.points.size()) - 1;
  }

  static void put(const std::array<report::Numbers*, 3>& into, const Vec3& value) {
    for (int k = 0; k < 3; ++k) into[k]->push_back(kMmPerM * value[k]);
  }

  // Where the part that slides would be without play, carried by the body that it slides in.
  int add_room(const JointFrame& seat, const JointFrame& insert) {
    return add_moving([&](const Frame& frame) {
      const Vec3 p = at({insert.body, insert.p}, frame.ideal);
      if (seat.body == kGround) return BodyPoint{kGround, p};
      const Pose& body = frame.ideal[seat.body];
      return BodyPoint{seat.body, body.q.conjugate() * (p - body.p)};
    });
  }

  // Points of one body at one place are one point.
  int add_end(const JointFrame& end) {
    auto& known = on_body_[end.body + 1];
    for (const auto& [index, p] : known)
      if ((p - end.p).norm() <= kSamePlace * size_) return index;
    known.push_back({add({end.body, end.p}), end.p});
    return known.back().first;
  }

  int add_tip(const JointFrame& end, int axis = 1) { return add({end.body, end.p + kTip * size_ * end.R.col(axis)}); }

  void add_joint(int j) {
    const JointDescription& joint = mechanism_.description().joints[j];
    const JointFrame *first = &mechanism_.geometry(j).first, *second = &mechanism_.geometry(j).second;
    const int c = mechanism_.clearance_of(j);
    if (c >= 0 && mechanism_.description().clearances[c].journal == first->body) std::swap(first, second);
    report::ViewJoint drawn{.name = joint.name, .first = add_end(*first), .second = add_end(*second)};
    if (joint.type != JointType::spherical && joint.type != JointType::fixed) drawn.tip = add_tip(*first);
    if (c >= 0) {
      const ClearanceParameters& p = parameters(c);
      const bool corners = is_pad(mechanism_, c) && has_corners(p);
      drawn.clearance = report::ViewClearance{.radial = kMmPerM * p.radial,
                                              .axial = kMmPerM * p.axial,
                                              .width = kMmPerM * p.width_gap,
                                              .height = kMmPerM * p.height_gap,
                                              .pad = kMmPerM * p.pad_radius,
                                              .pad_width = corners ? kMmPerM * p.width : 0.0,
                                              .pad_length = corners ? kMmPerM * p.length : 0.0};
      if (drawn.tip >= 0) drawn.second_tip = add_tip(*second);
      if (is_slider(mechanism_, c)) drawn.side = add_tip(*first, 0);
      if (corners) drawn.side = add_tip(*second, 0);  // it turns in its slot
      if (slides_along_axis(joint.type) || joint.type == JointType::planar) drawn.room = add_room(*first, *second);
    }
    view_.joints.push_back(std::move(drawn));
  }

  // Two points make a rod, more a plate: its corners in turn around their middle.
  void add_body(const std::string& name, int body) {
    const auto& corners = on_body_[body + 1];
    report::ViewBody drawn{.name = name, .muted = body == kGround};
    for (const auto& [index, p] : corners) drawn.points.push_back(index);
    if (corners.size() == 1 && body != kGround && corners[0].second.norm() > kSamePlace * size_)
      drawn.points.push_back(add({body, Vec3::Zero()}));
    if (corners.size() > 2) {
      MatX centred(3, corners.size());
      for (std::size_t i = 0; i < corners.size(); ++i) centred.col(static_cast<Eigen::Index>(i)) = corners[i].second;
      centred.colwise() -= Vec3(centred.rowwise().mean());
      const auto [size, directions] = singular_decomposition(centred.transpose());
      const MatX along = directions.transpose() * centred;
      drawn.closed = size[1] > 1e-6 * size[0];
      std::map<int, double> turn;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        turn[corners[i].first] = drawn.closed ? std::atan2(along(1, k), along(0, k)) : along(0, k);
      }
      std::sort(drawn.points.begin(), drawn.points.end(), [&](int a, int b) { return turn[a] < turn[b]; });
    }
    if (!drawn.points.empty()) view_.bodies.push_back(std::move(drawn));
  }

  const Mechanism& mechanism_;
  const RunResult& result_;
  report::View view_;
  double size_ = 1.0;
  std::vector<std::vector<std::pair<int, Vec3>>> on_body_;  // [body + 1]: its joints' points
};

}  // namespace

double view_frame_spacing(const Mechanism& mechanism) {
  constexpr double kMostNumbers = 6e4;  // some 600 kB
  const double points = 3.0 * mechanism.joints() + 2.0 * mechanism.clearances() + mechanism.bodies() + 2.0;
  return mechanism.duration() / std::clamp(std::floor(kMostNumbers / (6.0 * points)), 40.0, 120.0);
}

report::View mechanism_view(const Mechanism& mechanism, const RunResult& result) {
  return ViewBuilder(mechanism, result).build();
}

}  // namespace boresight::app
