// Histories of a motion as Python sees them: arrays that show the memory in which the run left them, which each keeps alive.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"

namespace boresight::python {

using KeptResult = std::shared_ptr<const RunResult>;

// `every`: of so many samples one is told.
// The history of one body.
struct BodyHistoryView {
  KeptResult owner;
  const BodyHistory* body;
  std::size_t every;
};
struct ClearanceHistoryView {
  KeptResult owner;
  const std::vector<ClearanceSample>* samples;
  std::string joint;
  std::size_t every;
};

}  // namespace boresight::python
