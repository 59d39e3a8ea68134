// Draws of a calibration's posterior in its report.
#pragma once

#include "boresight_analyses/calibration/posterior_draws.hpp"
#include "report/document.hpp"

namespace boresight::app {

// With as many decimals as its error gives a meaning to.
std::string readable_to(double value, double error, const std::string& si_unit, const std::string& written_unit);

// A parameter's path without what every one of its kind begins with.
std::string name_of_path(const std::string& path);

report::Section draws_section(const PosteriorDraws& draws, double confidence);

}  // namespace boresight::app
