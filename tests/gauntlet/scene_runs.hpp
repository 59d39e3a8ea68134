// The runs of one scene that the gauntlet holds against one another: each in a process of its own, the reference that all others are held
// against, and neighbours of a run, by which chaos is told from error.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure.hpp"
#include "trial.hpp"

namespace boresight::gauntlet {

struct Center {
  double median = 0.0, spread = 0.0;
};
Center center(const std::vector<Measured>& runs, std::size_t figure);

class SceneRuns {
 public:
  static constexpr double kMostOfLimit = 0.8;  // of the CPU limit, after which a run is asked to end

  SceneRuns(std::shared_ptr<const Mechanism> mechanism, Verdict& verdict, const TrialOptions& options)
      : mechanism_(std::move(mechanism)), verdict_(verdict), options_(options) {}

  const std::shared_ptr<const Mechanism>& mechanism() const { return mechanism_; }
  // Runs it in a process of its own; what goes wrong is noted. `quiet`: refusals are not.
  std::optional<Measured> measure_safely(const Asked& asked, bool quiet = false);
  // Differences below this mean nothing: a ten-thousandth of the smallest play.
  double floor_of(std::size_t figure) const;
  // What the program would state of the steps of a run of this mechanism, which takes more runs.
  void know_steps(Measured& run, const Asked& asked, const std::shared_ptr<const Mechanism>& mechanism);

  // Each rung by its own integrator.
  Measured& base(const std::string& rung) { return base_[rung]; }
  bool has_base(const std::string& rung) const { return base_.count(rung) != 0; }

  // Multibody at half its own step and two neighbours of it; more neighbours when a comparison is close.
  void make_reference();
  const std::vector<Measured>& reference() const { return reference_; }
  void add_references(std::size_t count, double first, double spacing);
  void know_steps_of_reference();

  // The same from other steps, or with another tolerance, or from a start beside: what a motion is one of.
  void add_neighbours(std::vector<Measured>& runs, const Asked& asked, const std::vector<double>& factors);
  // What rounding may grow to: the figure's range over so many steps that differ by a percent. (Less would round to the same steps.)
  double neighbours_spread(const Asked& asked, std::size_t figure, int count);
  // The same over numbers that differ as those of another drawing do. Only where steps scatter much too: where they do not, what follows
  // rounding is a fault.
  double rounded_spread(const Asked& asked, std::size_t figure);

 private:
  Asked reference_asked(double factor);
  void add_reference(double factor);

  std::shared_ptr<const Mechanism> mechanism_;
  Verdict& verdict_;
  const TrialOptions& options_;
  std::map<std::string, Measured> base_;
  std::map<std::string, std::vector<Measured>> neighbours_, rounded_;
  std::map<std::string, int> neighbours_tried_;
  std::vector<Measured> reference_;
  bool reference_steps_known_ = false;
};

}  // namespace boresight::gauntlet
