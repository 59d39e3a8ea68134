// The figures of README.md and lib/README.md are those that the program gives.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "program.hpp"

namespace boresight::app {
namespace readme_figures_test {

// README.md's table of rungs: position error of the default scene as `boresight run --rung` gives it, to the digits printed there. Multibody and
// perturbation follow impacts: their last digit may be the neighbour.
TEST_F(Program, TheReadmesTableOfRungsIsWhatTheRungsGive) {
  std::ifstream in(std::string(BORESIGHT_SOURCE) + "/README.md");
  int rows = 0;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream all(line);
    for (std::string cell; std::getline(all, cell, '|');) cells.push_back(cell);
    const std::string rung = cells[1].substr(2, cells[1].rfind('`') - 2);
    double max = 0.0, rms = 0.0;
    if (cells.size() < 7 || std::sscanf(cells[4].c_str(), " %lf mm", &max) != 1 ||
        std::sscanf(cells[5].c_str(), " %lf mm", &rms) != 1)
      continue;
    ++rows;
    ASSERT_EQ(call({"run", mechanism_, "--rung", rung, "--step-error", "off", "--quiet", "--out", rung}).status, 0)
        << rung;
    const auto error = json(rung + "/summary.json")["index"]["position_error"];
    EXPECT_NEAR(1e3 * error["max"].get<double>(), max, 0.00105) << rung;
    EXPECT_NEAR(1e3 * error["rms"].get<double>(), rms, 0.00105) << rung;
  }
  EXPECT_EQ(rows, 4);
}

TEST_F(Program, TheLibrarysErrorOfAFreeJournalIsWhatPerturbationGives) {
  std::ifstream in(std::string(BORESIGHT_SOURCE) + "/lib/README.md");
  const std::string readme{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = readme.find("boresight is off by ");
  ASSERT_NE(at, std::string::npos);
  const double milliradians = std::strtod(readme.c_str() + at + 20, nullptr);
  ASSERT_EQ(call({"run", mechanism_, "--rung", "perturbation", "--set", "clearance.F1.axes=free", "--set",
                  "clearance.F1.sleeve_length=120mm", "--step-error", "off", "--quiet", "--out", "out"})
                .status,
            0);
  EXPECT_NEAR(1e3 * json("out/summary.json")["index"]["boresight_error"]["max"].get<double>(), milliradians,
              0.02 * milliradians);
}

}  // namespace readme_figures_test
}  // namespace boresight::app
