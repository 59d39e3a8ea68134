#include "results/stored_samples.hpp"

#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/fidelities/fidelity_study.hpp"
#include "boresight_analyses/tails/tail_study.hpp"

namespace boresight::app {

std::vector<std::filesystem::path> stored_samples(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> stores = {folder / "samples.db"};
  for (const std::string& rung : rung_names()) stores.push_back(folder / store_of_rung(rung));
  for (const std::string& rung : rung_names()) stores.push_back(folder / store_of_tail(rung));
  std::erase_if(stores, [](const std::filesystem::path& store) {
    std::error_code unreadable;
    return !std::filesystem::exists(store, unreadable);
  });
  return stores;
}

}  // namespace boresight::app
