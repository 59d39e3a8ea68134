// The HTML report of `stability`.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/stability/stability.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

report::Document stability_report(const Command& command, const Mechanism& mechanism, const StabilityResult& result);

// Whether measurement meets theory and every case shows what is said of it.
bool as_foreseen(const StabilityResult& result);
inline constexpr double kLimitTolerance = 0.02;  // of measured limits against theory

}  // namespace boresight::app
