// A step of the paper's method takes nothing from the heap: counted at malloc itself.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "boresight/formulations/formulation.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "scenes.hpp"

#if !defined(__SANITIZE_ADDRESS__)

namespace {
std::atomic<long> allocations{0};
}

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

namespace boresight {
namespace allocation_test {

void expect_no_allocation(const Mechanism& mechanism, const IdealMotion& ideal, Formulation& formulation) {
  IdealState start;
  ideal.state(0.0, start);
  VecX y;
  formulation.start(start, y);
  const std::vector<ContactMemory> memory(mechanism.clearances());
  ExplicitRungeKutta method(classical_rk4(), y.size());
  const auto derivative = [&](double t, const VecX& state, VecX& dy) { formulation.derivative(t, state, memory, dy); };
  constexpr double h = 2e-5;
  const auto step = [&](int k) {
    derivative(h * k, y, method.first_slope());
    method.step(h * k, h, y, derivative);
    formulation.stabilise(h * (k + 1), y);
  };
  step(0);
  const long before = allocations.load();
  for (int k = 1; k < 100; ++k) step(k);
  EXPECT_EQ(allocations.load() - before, 0);
  void* volatile block = std::malloc(1);
  std::free(block);
  EXPECT_GT(allocations.load(), before) << "the counter must count";
}

TEST(Formulations, TakeNothingFromTheHeapInsideAStep) {
  for (JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    MechanismDescription description = scenes::rrcpr();
    description.clearances[0].axes = axes;
    const auto mechanism = scenes::build(std::move(description));
    const IdealMotion ideal = IdealMotion::kinematic(*mechanism);
    for (Stabilisation stabilisation : {Stabilisation::baumgarte, Stabilisation::projection}) {
      const auto paper =
          make_paper_formulation(*mechanism, mechanism->parameters(), &ideal, {.stabilisation = stabilisation});
      expect_no_allocation(*mechanism, ideal, *paper);
      const auto tree =
          make_tree_formulation(*mechanism, mechanism->parameters(), &ideal, {.stabilisation = stabilisation});
      expect_no_allocation(*mechanism, ideal, *tree);
    }
  }
}

}  // namespace allocation_test
}  // namespace boresight

#endif
