// A Monte Carlo study as a user gives it to the program, of a short motion.
#pragma once

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "program.hpp"

namespace boresight::app {

class MonteCarloProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    study("study.toml", 400);
  }
  void study(const std::string& name, int samples, const std::string& more = "") const {
    std::ofstream(folder_ / name) << "format = 1\nmechanism = \"" << mechanism_ << R"("
[[random]]
parameter = "clearance.F1.radial"
distribution = { normal = { mean = "0.1 mm", sd = "0.01 mm" }, truncate = ["0.05 mm", "0.15 mm"] }
[[random]]
parameter = "clearance.F1.contact.restitution"
distribution = { uniform = { min = 0.7, max = 0.95 } }
[[random]]
parameter = "clearance.F1.friction.coefficient"
distribution = { lognormal = { median = 0.03, factor = 1.3 } }
[montecarlo]
samples = )" << samples << "\n" << more
                                  << "\n";
  }
  // A motion of 20 ms on the cheapest rung with impacts.
  std::vector<std::string> quick(const std::string& name, const std::string& out,
                                 std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {
        "montecarlo", name, "--set", "motion.duration=20ms", "--rung", "perturbation", "--out", out, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  std::uintmax_t stored_bytes(const std::string& out) const {
    std::uintmax_t sum = 0;
    if (!std::filesystem::exists(folder_ / out)) return sum;
    std::error_code gone;  // the program may merge or remove one meanwhile
    for (const auto& file : std::filesystem::directory_iterator(folder_ / out))
      if (const std::uintmax_t size = std::filesystem::file_size(file, gone); !gone) sum += size;
    return sum;
  }
  // However fast the machine, there is something stored and more to come.
  void wait_until_stored(const std::string& out, std::uintmax_t before) const {
    for (int k = 0; k < 10000 && stored_bytes(out) < before + 100'000; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::string samples_of(const std::string& out) const {
    EXPECT_EQ(call({"export", out, "--quiet"}).status, 0);
    return text(out + "/samples.csv");
  }
  std::string csv_of(const std::string& name, const std::string& out, std::vector<std::string> more = {}) const {
    const Ended ended = call(quick(name, out, std::move(more)));
    EXPECT_EQ(ended.status, 0) << ended.err;
    return samples_of(out);
  }
};

}  // namespace boresight::app
