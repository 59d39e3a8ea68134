// A step up to an event may come out longer than the step that found the event, and its error too large: what is tried next must be shorter
// than both, or the same step finds the same event for ever.
#include <gtest/gtest.h>

#include <cmath>

#include "boresight/integrate/integrator.hpp"

namespace boresight {
namespace mended_cuts_test {

constexpr double kEvent = 0.85;  // y = t comes to it

struct OneEvent {
  int closings = 0;
  void derivative(double, const VecX&, VecX& dy) const { dy[0] = 1.0; }
  int gap_count() const { return 1; }
  void gaps(double, const VecX& y, VecX& g) const { g[0] = kEvent - y[0]; }
  AfterEvent on_event(const GapEvent& event, VecX&) {
    closings += event.crossing == Crossing::closing;
    return AfterEvent::crossed;
  }
};

// y' = 1, but that steps taken anew up to an event fall short of it, so that each is mended to be longer; and whose error is too large
// beyond a step of 1.
class FallsShort {
 public:
  const char* name() const { return "falls short"; }
  int order() const { return 5; }
  int error_order() const { return 4; }
  Eigen::Index size() const { return 1; }
  template <typename S>
  void begin(const S&, double, const VecX& y) {
    start_ = y;
    slope_ = VecX::Ones(1);
    anew_ = 0;
  }
  template <typename S>
  Attempt attempt(const S&, double, double h, const VecX& y) {
    ++attempts_;
    start_ = y;
    proposed_ = y.array() + (anew_ > 0 ? 0.5 : 1.0) * h;
    error_ = VecX::Constant(1, h <= 1.0 ? 0.5 * std::pow(h, 5) : 1.0001);
    return Attempt::done;
  }
  // Four attempts up to the event follow one that found it.
  template <typename S>
  void finish(const S&, double) {
    anew_ = anew_ == 0 ? 4 : anew_ - 1;
  }
  const VecX& proposed() const { return proposed_; }
  const VecX& error() const { return error_; }
  void interpolate(double share, VecX& out) const { out = start_ + share * (proposed_ - start_); }
  const VecX& start_slope() const { return slope_; }
  void advance() { anew_ = 0; }
  double step_stiffness() const { return 0.0; }
  double stability_limit() const { return 1.0; }
  MethodCost& cost() { return cost_; }
  long attempts() const { return attempts_; }

 private:
  VecX start_ = VecX::Zero(1), proposed_ = start_, error_ = start_, slope_ = start_;
  int anew_ = 0;
  long attempts_ = 0;
  MethodCost cost_;
};

TEST(MendedCuts, ThatErrTooMuchMakeTheNextAttemptShorter) {
  OneEvent system;
  VecX y = VecX::Zero(1);
  IntegrationOptions options;
  options.relative_tolerance = 0.0;
  options.absolute_tolerance = 1.0;
  options.first_step = 0.92;
  options.most_steps = 1000;
  Integrator<FallsShort> integrator(FallsShort(), 1);
  const IntegrationSummary summary = integrator.run(system, 0.0, 10.0, y, options);
  EXPECT_TRUE(summary.completed()) << summary;
  EXPECT_EQ(system.closings, 1);
  EXPECT_GT(summary.rejected_by_error, 0) << "the scene does not show what it is meant to";
  EXPECT_LT(integrator.method().attempts(), 200);
}

}  // namespace mended_cuts_test
}  // namespace boresight
