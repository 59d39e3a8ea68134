// The comparison as people read it: a table on the terminal, and one page with the chart.
#pragma once

#include "comparison.hpp"
#include "report/document.hpp"

namespace boresight::peers {

// What is claimed of our rungs at an accuracy of the index, against what was measured.
struct Claim {
  std::string text;
  double asked = 0.0,
         measured = 0.0;  // times faster; measured 0: one of the two does not come within the accuracy
  std::string how;        // which ways were held against each other
  bool holds() const { return measured >= asked; }
};
std::vector<Claim> claims(const Comparison& comparison, double accuracy);

void print(const Comparison& comparison, double accuracy);
report::Document comparison_document(const Mechanism& mechanism, const Comparison& comparison, double accuracy);

}  // namespace boresight::peers
