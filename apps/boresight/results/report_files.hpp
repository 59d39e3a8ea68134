// report.html, and report.json: what it shows, from which `boresight report DIR` makes the page again.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "results/output_directory.hpp"

namespace boresight::app {

// Sets both aside, to be published with the rest of the results. Throws WriteError.
void write_report(const OutputDirectory& out, const nlohmann::json& document);

// Writes report.html of a folder of results anew. Throws InputError where the folder has no results, or none that a report can be made of;
// OutputDirectoryError where another process writes in it; WriteError.
void rebuild_report(const std::filesystem::path& folder);

}  // namespace boresight::app
