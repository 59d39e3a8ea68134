// Elements whose force hangs on numbers of their own: the bristles of friction, and whatever else remembers (an encoder, a servo's
// integral, backlash).
//
// The numbers stand in one vector behind the rung's own state, and every integrator carries them with it. They obey what every
// state does: a right-hand side takes them as given and returns their rates, and only an accepted step or an event changes them
// otherwise, so that a rejected step leaves no trace.
#pragma once

#include <memory>
#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

class ElementState {
 public:
  virtual ~ElementState() = default;

  virtual Eigen::Index size() const = 0;
  // The element acts with these numbers from now on, for one right-hand side. h: length of the fixed step at hand, which is not to
  // be asked to follow anything faster [s]; 0 where steps follow an error estimate.
  virtual void take(const Eigen::Ref<const VecX>& x, double h) = 0;
  // How fast they change, once the forces were computed.
  virtual void rates(Eigen::Ref<VecX> x_dot) const = 0;
  // At an accepted time, or at an event: what changes at once (bristles of contacts that have parted spring back).
  virtual void accept(Eigen::Ref<VecX> x) = 0;
  // The error of a step that is allowed, of each number, where offsets may err by `share` of the smallest clearance.
  virtual void tolerances(double share, Eigen::Ref<VecX> error) const = 0;
};

// All of a rung's, one after the other.
class ElementStates {
 public:
  void add(std::unique_ptr<ElementState> element) {
    if (element->size() == 0) return;
    size_ += element->size();
    elements_.push_back(std::move(element));
  }

  Eigen::Index size() const { return size_; }
  bool empty() const { return size_ == 0; }

  void take(const Eigen::Ref<const VecX>& x, double h) const {
    each([&](ElementState& element, Eigen::Index first) { element.take(x.segment(first, element.size()), h); });
  }
  void rates(Eigen::Ref<VecX> x_dot) const {
    each([&](ElementState& element, Eigen::Index first) { element.rates(x_dot.segment(first, element.size())); });
  }
  void accept(Eigen::Ref<VecX> x) const {
    each([&](ElementState& element, Eigen::Index first) { element.accept(x.segment(first, element.size())); });
  }
  void tolerances(double share, Eigen::Ref<VecX> error) const {
    each([&](ElementState& element, Eigen::Index first) {
      element.tolerances(share, error.segment(first, element.size()));
    });
  }

 private:
  template <typename Do>
  void each(const Do& with) const {
    Eigen::Index first = 0;
    for (const std::unique_ptr<ElementState>& element : elements_) {
      with(*element, first);
      first += element->size();
    }
  }

  std::vector<std::unique_ptr<ElementState>> elements_;
  Eigen::Index size_ = 0;
};

}  // namespace boresight
