// A sensitivity study of three parameters, its store, and a model whose indices and slopes are known.
#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/sensitivity/sensitivity.hpp"

namespace boresight {

// y = 3 a + 2 b + 5 |c| in units of each parameter's sd: indices and slopes are known. Fails where asked.
class ClosedForm final : public SampleModel {
 public:
  std::string rung() const override { return "closed form"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 3; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>&) const override {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const auto& v = samples[k].values;
      ++evaluations;
      if (fails && fails(samples[k].number)) {
        outcomes[k].status = Outcome::Status::failed;
        continue;
      }
      outcomes[k].status = Outcome::Status::done;
      outcomes[k].value =
          3.0 * (v[0] - 1e-4) / 1e-5 + 2.0 * (v[1] - 0.8) / 0.01 + 5.0 * std::abs((v[2] - 0.03) / 0.001);
    }
  }
  mutable std::atomic<int> evaluations{0};
  std::function<bool(std::uint64_t)> fails;
};

class SensitivityTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("boresight-sensitivity-" + std::to_string(::getpid()) + "-" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  SensitivityPlan plan(const std::string& table, const std::string& more = "") const {
    const std::string file = (folder_ / "study.toml").string();
    std::ofstream(file) << "format = 1\nmechanism = \"" BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml\"\n" + table + R"(
[[random]]
parameter = "clearance.F1.radial"
distribution = { normal = { mean = "0.1 mm", sd = "0.01 mm" } , truncate = ["0.01 mm", "0.19 mm"] }
[[random]]
parameter = "clearance.F1.contact.restitution"
distribution = { normal = { mean = 0.8, sd = 0.01 } }
[[random]]
parameter = "clearance.F1.friction.coefficient"
distribution = { normal = { mean = 0.03, sd = 0.001 } }
)" + more;
    Document document = Document::from_file(file);
    Cursor root(document);
    const Study study = read_study(root, document.content_hash());
    return read_sensitivity_plan(root, study, read_mechanism(study.mechanism_file, {}), [](const Setting&) {});
  }
  std::unique_ptr<SampleStore> store(const SensitivityPlan& plan, const std::string& name = "samples.db") const {
    std::vector<std::string> names;
    for (const RandomParameter& p : plan.inputs.parameters) names.push_back(p.name());
    auto s =
        std::make_unique<SampleStore>(folder_ / name, std::map<std::string, std::string>{{"study", "test"}}, names);
    s->use_rung("closed form", 0.0);
    return s;
  }
  void expect_refused(const std::string& table, const std::string& words, const std::string& more = "") const {
    try {
      plan(table, more);
      FAIL() << "accepted: " << table;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(words)) << table;
    }
  }
  std::filesystem::path folder_;
};

}  // namespace boresight
