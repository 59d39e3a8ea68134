// The crank-slider, numbers of its contact varied: what motions with slopes are followed of.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/slopes/contact_number_slopes.hpp"

namespace boresight::crank_slider {

class Scene {
 public:
  Scene(const std::vector<Setting>& settings, const std::vector<std::string>& varied)
      : mechanism(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml", settings)),
        prepared(mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters()),
        tables(prepared.tables(mechanism.parameters())) {
    for (const std::string& path : varied) paths.emplace_back(mechanism.description(), path);
    for (const ParameterPath& path : paths) values.push_back(path.get(mechanism.parameters()));
  }

  Parameters at(const std::vector<double>& v) const {
    Parameters p = mechanism.parameters();
    for (std::size_t k = 0; k < paths.size(); ++k) paths[k].set(p, v[k]);
    return p;
  }
  ContactNumbers numbers(const std::vector<double>& v) const {
    return contact_numbers(
        mechanism, [&](const auto& x) { return at(x); }, v);
  }

  Mechanism mechanism;
  PreparedScene prepared;
  std::shared_ptr<const SceneTables> tables;
  std::vector<ParameterPath> paths;
  std::vector<double> values;
};

}  // namespace boresight::crank_slider
