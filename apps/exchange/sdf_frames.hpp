// The frames of a model of SDF: where they stand in it, and the links that they are attached to.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "exchange/drawing.hpp"
#include "exchange/xml_element.hpp"

namespace boresight::app {

// A pose as it is written: in what, and about which element.
Placement raw_pose(const XmlElement& pose);

// Frames are the links, joints, frames and models of a model, known by their name in it; those of a model in it as MODEL::NAME.
// __model__ is the model's own.
class SdfFrames {
 public:
  // Throws InputError for a name that two have.
  explicit SdfFrames(const XmlElement& model);

  // Throws InputError where the model says that a link is its canonical one which it has not.
  void check_canonical_link();

  // Of the frame of this name in the model. Throws InputError where there is none: that of `asks`, for its `key`.
  Placement placement(const std::string& name, const XmlElement& asks, const std::string& key);

  // The link that a frame is attached to, which is not what its pose is given in; "world" for what stands in that; nothing where
  // there is no such frame, or no link at its end.
  std::optional<std::string> link_of(std::string name);

 private:
  // A named frame: where it is written, and in which other one.
  struct Frame {
    XmlElement element;
    std::string in;  // "__model__" or another frame's name
    Placement X;
    bool placed = false;
    bool in_work = false;
    Placement X_M;  // in the model
  };

  SdfFrames& model_called(const std::string& name);  // one of `frames_`
  std::vector<std::string> links();
  std::optional<std::string> canonical_link();
  std::optional<std::string> link_in(const std::string& model, const std::string& name);

  XmlElement model_;
  std::map<std::string, Frame> frames_;
  std::map<std::string, std::unique_ptr<SdfFrames>> inner_;  // of the models in this one, as far as they were asked for
};

}  // namespace boresight::app
