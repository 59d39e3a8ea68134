#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace boresight::gauntlet {
namespace {

void print_counts(const char* title, const std::map<std::string, int>& counts) {
  if (counts.empty()) return;
  fmt::print("\n{}\n", title);
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto& [what, count] : counts) sorted.emplace_back(-count, what);
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [count, what] : sorted) fmt::print("  {:5}  {}\n", -count, what);
}

// Actual over stated; where nothing was stated, infinite unless nothing was off.
double ratio(const Claim& claim) {
  if (claim.actual <= 0.0) return 0.0;
  return claim.stated > 0.0 ? claim.actual / claim.stated : std::numeric_limits<double>::infinity();
}

}  // namespace

void print_faults(const Verdict& v, const std::string& flags) {
  for (const Fault& f : v.faults)
    fmt::print("  {} ({}): {}{} in {}: {}\n", v.scene, v.family,
               f.known       ? "known: "
               : f.unclaimed ? "error not measured: "
                             : "",
               f.kind, f.stage, f.text);
  if (v.faults.empty()) return;
  const bool seeded = v.scene.rfind("seed ", 0) == 0;
  fmt::print("    again: boresight_gauntlet {}\n",
             (seeded ? "--from " + v.scene.substr(5) + " --count 1" : "--scene " + v.scene) + flags);
  if (seeded) fmt::print("    file:  boresight_gauntlet{} --write {} scene.toml\n", flags, v.scene.substr(5));
}

void print_table(const std::vector<Verdict>& verdicts) {
  int agreed = 0, refused = 0, wrong = 0, known = 0, unclaimed = 0;
  double cpu = 0.0;
  std::map<std::string, int> wrong_kinds, scene_refusals, stage_refusals, families, wrong_families;
  std::map<std::string, std::vector<double>> ratios;
  for (const Verdict& v : verdicts) {
    cpu += v.cpu_seconds;
    ++families[v.family];
    std::map<std::string, bool> kinds;
    for (const Fault& f : v.faults) kinds[f.kind + ": " + f.stage] = true;
    for (const auto& [kind, seen] : kinds) ++wrong_kinds[kind];
    for (const Refusal& r : v.refusals) ++stage_refusals[r.stage + ": " + normalised(r.reason)];
    for (const Claim& c : v.claims) ratios[c.stage].push_back(ratio(c));
    if (!v.faults.empty()) {
      const bool claimed =
          std::any_of(v.faults.begin(), v.faults.end(), [](const Fault& f) { return !f.known && !f.unclaimed; });
      ++(!has_new_fault(v) ? known : claimed ? wrong : unclaimed);
      ++wrong_families[v.family];
    } else if (v.compared == 0) {
      ++refused;
      ++scene_refusals[normalised(v.refused)];
    } else {
      ++agreed;
    }
  }
  fmt::print(
      "\n{} scenes: {} agreed, {} refused, {} wrong{}{}; {:.1f} s of CPU\n", verdicts.size(), agreed, refused, wrong,
      known > 0 ? fmt::format(", {} with known faults only", known) : "",
      unclaimed > 0 ? fmt::format(", {} off only where the run says that its error was not measured", unclaimed) : "",
      cpu);
  fmt::print("\nscenes by family (wrong of all)\n");
  for (const auto& [family, count] : families)
    fmt::print("  {:<20} {:4} of {:4}\n", family, wrong_families[family], count);
  print_counts("wrong, scenes by kind and stage", wrong_kinds);
  print_counts("scenes refused as a whole, by reason", scene_refusals);
  print_counts("stages refused, by reason", stage_refusals);
  fmt::print(
      "\nactual error over stated, where the comparison asked for the steps\' part\n  {:<32} {:>5} {:>8} {:>8} {:>8} "
      "{:>8} {:>8}\n",
      "", "runs", "median", "90 %", "95 %", "99 %", "max");
  for (auto& [stage, values] : ratios) {
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double p) {
      return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1))];
    };
    fmt::print("  {:<32} {:5} {:8.3g} {:8.3g} {:8.3g} {:8.3g} {:8.3g}\n", stage, values.size(), quantile(0.5),
               quantile(0.9), quantile(0.95), quantile(0.99), values.back());
  }
}

}  // namespace boresight::gauntlet
