#include "exchange/sdf_frames.hpp"

#include <algorithm>

#include "boresight/mechanism/error.hpp"

namespace boresight::app {

Placement raw_pose(const XmlElement& pose) {
  const std::vector<double> v = pose.content_numbers();
  if (v.empty()) return {};
  const std::string format = pose.text("rotation_format", "euler_rpy");
  if (format == "quat_xyzw") {
    if (v.size() != 7) pose.fail("pose", "\"" + pose.content() + "\"", "seven numbers");
    return {turned_by(v[6], v[3], v[4], v[5]), {v[0], v[1], v[2]}};
  }
  if (v.size() != 6) pose.fail("pose", "\"" + pose.content() + "\"", "six numbers: x y z roll pitch yaw");
  const bool degrees = pose.text("degrees", "false") == "true" || pose.text("degrees", "false") == "1";
  return {turned_by(Vec3(v[3], v[4], v[5]) * (degrees ? EIGEN_PI / 180.0 : 1.0)), {v[0], v[1], v[2]}};
}

SdfFrames::SdfFrames(const XmlElement& model) : model_(model) {
  for (const char* tag : {"link", "joint", "frame", "model"})
    for (const XmlElement& named : model.children(tag)) {
      const std::string name = named.text("name");
      const auto pose = named.child("pose");
      std::string in = pose ? pose->text("relative_to", pose->text("frame", "")) : "";
      if (in.empty() && named.tag() == "joint") in = named.needed("child").content();
      if (in.empty() && named.tag() == "frame") in = named.text("attached_to", "");
      if (in.empty()) in = "__model__";
      const Placement X = pose ? raw_pose(*pose) : Placement();
      if (!frames_.emplace(name, Frame{named, in, X, false, false, Placement()}).second)
        named.fail(named.tag() + ".name", "\"" + name + "\" a second time", "a name of its own");
    }
}

void SdfFrames::check_canonical_link() {
  const std::string given = model_.text("canonical_link", "");
  if (given.empty()) return;
  const std::vector<std::string> names = links();
  if (std::find(names.begin(), names.end(), given) == names.end())
    model_.fail("model.canonical_link", "\"" + given + "\"", "the name of a link", nearest_name(given, names));
}

Placement SdfFrames::placement(const std::string& name, const XmlElement& asks, const std::string& key) {
  if (name == "__model__" || name.empty()) return {};
  const auto found = frames_.find(name);
  if (found == frames_.end()) {
    // A frame of a model in this one, whether that has been read or not.
    const std::size_t end = name.find("::");
    const auto inner = frames_.find(name.substr(0, end));
    if (end != std::string::npos && inner != frames_.end() && inner->second.element.tag() == "model")
      return placement(inner->first, asks, key) * model_called(inner->first).placement(name.substr(end + 2), asks, key);
    std::vector<std::string> names;
    for (const auto& [known, frame] : frames_) names.push_back(known);
    asks.fail(key, "\"" + name + "\"", "the name of a frame, link or joint", nearest_name(name, names));
  }
  Frame& frame = found->second;
  if (frame.placed) return frame.X_M;
  if (frame.in_work)
    frame.element.fail("pose.relative_to", "frames that go in a circle", "frames that end at the model");
  frame.in_work = true;
  frame.X_M = placement(frame.in, frame.element, "pose.relative_to") * frame.X;
  frame.placed = true;
  return frame.X_M;
}

std::optional<std::string> SdfFrames::link_of(std::string name) {
  for (std::size_t steps = 0; steps <= frames_.size(); ++steps) {  // more of them go in a circle
    if (name == "world") return name;
    if (name == "__model__") return canonical_link();
    const auto found = frames_.find(name);
    if (found == frames_.end()) {
      const std::size_t end = name.find("::");
      if (end == std::string::npos) return std::nullopt;
      return link_in(name.substr(0, end), name.substr(end + 2));
    }
    const XmlElement& named = found->second.element;
    if (named.tag() == "link") return name;
    if (named.tag() == "model") return link_in(name, "__model__");
    name = named.tag() == "joint" ? named.needed("child").content() : named.text("attached_to", "");
    if (name.empty()) name = "__model__";
  }
  return std::nullopt;
}

SdfFrames& SdfFrames::model_called(const std::string& name) {
  std::unique_ptr<SdfFrames>& known = inner_[name];
  if (!known) known = std::make_unique<SdfFrames>(frames_.at(name).element);
  return *known;
}

// Those of models in this one, too.
std::vector<std::string> SdfFrames::links() {
  std::vector<std::string> names;
  for (const auto& [name, frame] : frames_) {
    if (frame.element.tag() == "link") names.push_back(name);
    if (frame.element.tag() == "model")
      for (const std::string& link : model_called(name).links()) names.push_back(name + "::" + link);
  }
  return names;
}

// What the model's own frame is attached to: the first link, where the model names none.
std::optional<std::string> SdfFrames::canonical_link() {
  if (const std::string given = model_.text("canonical_link", ""); !given.empty()) return given;
  if (const auto first = model_.child("link")) return first->text("name");
  for (const XmlElement& inner : model_.children("model"))
    if (const auto link = link_in(inner.text("name"), "__model__")) return link;
  return std::nullopt;
}

std::optional<std::string> SdfFrames::link_in(const std::string& model, const std::string& name) {
  const auto found = frames_.find(model);
  if (found == frames_.end() || found->second.element.tag() != "model") return std::nullopt;
  const auto link = model_called(model).link_of(name);
  if (!link || *link == "world") return link;
  return model + "::" + *link;
}

}  // namespace boresight::app
