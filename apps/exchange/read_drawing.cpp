#include "boresight/io/whole_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "exchange/readers.hpp"
#include "exchange/xml_element.hpp"

namespace boresight::app {

Drawing read_drawing(const std::string& file) {
  const std::string text = read_whole_file(file);
  const XmlElement root = XmlElement::root_of(text, file);
  if (root.tag() == "robot") return read_urdf(text, file);
  if (root.tag() == "sdf" || root.tag() == "gazebo") return read_sdf(text, file);
  if (root.tag() == "mujoco") return read_mjcf(file);
  root.fail(root.tag(), "<" + root.tag() + ">", "<robot> (URDF), <sdf> or <mujoco> (MJCF)");
}

}  // namespace boresight::app
