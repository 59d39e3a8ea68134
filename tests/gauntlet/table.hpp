// The gauntlet's result in print: what agreed, what was refused and why, what is wrong, and how errors stand to claims.
#pragma once

#include <string>
#include <vector>

#include "verdict.hpp"

namespace boresight::gauntlet {

void print_table(const std::vector<Verdict>& verdicts);
// A line on each scene with a fault, and how to see it again: flags of the call, each with a space in front.
void print_faults(const Verdict& verdict, const std::string& flags);

}  // namespace boresight::gauntlet
