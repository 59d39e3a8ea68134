// What the cheap rungs share: the ideal motion and the scene of a mechanism, computed on first use and kept.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "boresight/rungs/clearance_scene.hpp"
#include "boresight/rungs/rung.hpp"

namespace boresight {

class SceneRung : public Rung {
 public:
  // Times the computation, then hands over to follow().
  RunResult run(const Parameters& parameters, const RunOptions& options) const final;

 protected:
  explicit SceneRung(std::shared_ptr<const Mechanism> mechanism) : mechanism_(std::move(mechanism)) {}
  virtual RunResult follow(const Parameters& parameters, const RunOptions& options) const = 0;

  const Mechanism& mechanism() const { return *mechanism_; }
  const IdealMotion& ideal() const { return *ideal_; }
  const ClearanceScene& scene() const { return *scene_; }

 private:
  std::shared_ptr<const Mechanism> mechanism_;
  mutable std::once_flag once_;
  mutable std::optional<IdealMotion> ideal_;
  mutable std::optional<ClearanceScene> scene_;
};

}  // namespace boresight
