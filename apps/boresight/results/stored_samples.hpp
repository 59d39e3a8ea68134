// The stores of samples that a folder of results holds: samples.db; of a study on several rungs one per rung.
#pragma once

#include <filesystem>
#include <vector>

namespace boresight::app {

// samples.db, samples-RUNG.db of `fidelities`, and, while a study of a tail is not whole, its points-RUNG.db; cheapest rung first.
std::vector<std::filesystem::path> stored_samples(const std::filesystem::path& folder);

}  // namespace boresight::app
