// What an allocation is to find, as the [allocate] table of a study file says it:
//
//   [allocate]
//   requirement = { limit = "0.5 mm", probability = 0.95, confidence = 0.9 }
//   samples = 1000                     # of the gaps, common to all sets that the search judges
//   confirm = 120                      # fresh samples on the next rung up, each time; more where they could not
//                                      # show the requirement at the confidence of one confirmation
//   seed = 1
//   zone = "normal"                    # how sizes lie in their zones: normal or uniform (random/fit_clearance.hpp)
//   front = 6                          # points of the front of cost against accuracy; 0: none
//   fits = [{ fit = "20 H7/f7", price = 10 }, { fit = "20 H6/g5", price = 18 }]   # of all joints without their own
//   [[allocate.joint]]
//   parameter = "clearance.F1.radial"  # one path, or a list of paths that take the same fit (and the same gap)
//   # one of, unless `fits` above stands for it:
//   fits = [...]                       # of the joint's size: random/fit_size.hpp
//   processes = [{ name = "reamed", tolerance = "0.02 mm", price = 4 }, ...]   # tolerance: see cost
//   cost = { law = "reciprocal", a = 1, b = 0.2, unit = "mm" }                 # allocation/cost_curve.hpp; with it:
//   tolerance = ["0.002 mm", "0.1 mm"]                                         # its bounds; the gap lies between
//                                                                              # `least` and `least` + tolerance
//   least = "0 mm"
//   [[allocate.error]]
//   parameter = "error.rod1.length"    # or a list of them: each gets a tolerance of its own, from the same
//   processes = [{ name = "ground", tolerance = "0.02 mm", price = 4 }, ...]   # the zone lies to both sides of the
//                                                                              # error's value in the mechanism file
//   # or cost and tolerance, as above
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/allocation/continuous_allocation.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/random/fit_clearance.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight {

struct AllocationOption {
  std::string name;
  double price = 0.0;
  DistributionPtr gap;  // radial clearance [m], or the error
};

// What gets a tolerance: the radial clearance of a joint, or a standing error.
struct AllocationEntry {
  std::vector<std::string> paths;
  std::vector<ParameterPath> places;
  std::vector<AllocationOption> options;  // empty where a cost curve is given
  ContinuousTolerance curve;
  double least = 0.0;     // gap at tolerance zero [m]; of an error its value in the mechanism file
  bool is_error = false;  // whose zone lies to both sides of `least`
  std::string
      said_in;  // the unit that its tolerance is written in; of a scale without one "ppm"; "": as people read the SI unit

  const std::string& name() const { return paths.front(); }
  const std::string& unit() const { return places.front().unit(); }
  bool is_continuous() const { return options.empty(); }
  // How it scatters with this tolerance.
  DistributionPtr zone(double tolerance, ZoneLaw law) const;
};

struct AllocationPlan {
  std::vector<AllocationEntry> entries;
  Requirement requirement;
  ZoneLaw zone = ZoneLaw::normal;
  std::size_t samples = 1000, confirm = 120;
  std::uint64_t seed = 1;
  int front = 6;
  std::optional<RandomInputs> inputs;  // what else scatters
  // Which of the inputs the linear deviation has behind the entries, in its order; the others count in the confirmation alone.
  std::vector<std::size_t> linear_inputs = {};

  // Whether all entries have cost curves; whether any has.
  bool is_continuous() const;
  bool has_curves() const;
  ZonePlaces zone_places() const;
  // The gaps first, then the other random parameters.
  Parameters parameters_with(const Mechanism& mechanism, std::span<const double> gaps_then_random) const;
  std::size_t scattered() const { return inputs ? inputs->size() : 0; }  // other random parameters
  // Those that a linear deviation may be linear in: radial clearances and errors, each by itself or all of one kind.
  std::vector<std::size_t> inputs_to_be_linear_in() const;
  std::string sample_text(const Study& study) const;
};

// Between `least` and `least` + tolerance, as the zone's law has it.
DistributionPtr make_zone(double least, double tolerance, ZoneLaw law);

// Throws InputError. `accepts`: see read_random_inputs; asked of the least and the largest gap of every
// joint.
AllocationPlan read_allocation_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                    const std::function<void(const Setting&)>& accepts);

}  // namespace boresight
