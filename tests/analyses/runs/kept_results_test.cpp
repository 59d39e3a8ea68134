#include "boresight_analyses/runs/kept_results.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/runs/study_run.hpp"

namespace boresight {

struct Kind {
  std::string word;
  std::vector<double> values;
  std::optional<Eigen::MatrixXd> matrix;
  bool flag = false;
  std::int64_t count = 0;
};
static void fields(Numbers& n, Kind& k) { n(k.word, k.values, k.matrix, k.flag, k.count); }

namespace kept_results_test {

class KeptResultsTest : public testing::Test {
 protected:
  KeptResultsTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~KeptResultsTest() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<SampleStore> store() const {
    return std::make_unique<SampleStore>(folder_ / "kept.db", std::map<std::string, std::string>{{"study", "this"}},
                                         KeptResults::columns());
  }
  StudyRun study(const std::string& identity) const { return {mechanism_, {.identity = identity, .folder = folder_}}; }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("boresight_kept_results_" + std::to_string(::getpid()));
  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism(BORESIGHT_EXAMPLES "/four-bar/four-bar.toml"));
};

TEST_F(KeptResultsTest, ForgetWhatALargerResultTookIn) {
  {
    KeptResults kept(store());
    for (std::uint64_t key = 1; key <= 3; ++key) kept.keep(key, {static_cast<double>(key)});
    kept.forget(1);
    kept.forget(3);
    kept.forget(4);  // never kept
    EXPECT_FALSE(kept.find(1));
    EXPECT_EQ(kept.size(), 1u);
  }
  EXPECT_EQ(store()->count(), 1u);
  KeptResults kept(store());
  EXPECT_FALSE(kept.find(3));
  EXPECT_EQ(kept.find(2), std::vector<double>{2.0});
  kept.keep(3, {4.0});
  EXPECT_EQ(kept.find(3), std::vector<double>{4.0});
  EXPECT_EQ(kept.find(2), std::vector<double>{2.0}) << "overwritten";
}

TEST_F(KeptResultsTest, ComeBackBitForBitInTheNextStart) {
  const Kind kind{
      "Störung \"a\"\n", {0.1, -0.0, INFINITY, 1e-310}, Eigen::MatrixXd::Random(3, 2), true, 1'234'567'890'123};
  const std::uint64_t key = 0xfedcba9876543210u;
  {
    KeptResults kept(store());
    EXPECT_FALSE(kept.find(key));
    kept.keep(key, Numbers::of(kind));
  }
  KeptResults kept(store());
  EXPECT_EQ(kept.size(), 1u);
  EXPECT_FALSE(kept.find(key + 1));
  const Kind back = kept_or_computed<Kind>(&kept, key, []() -> Kind { throw std::logic_error("computed again"); });
  EXPECT_EQ(back.word, kind.word);
  EXPECT_EQ(back.values, kind.values);
  EXPECT_TRUE(std::signbit(back.values[1]));
  EXPECT_EQ(*back.matrix, *kind.matrix);
  EXPECT_EQ(back.flag, kind.flag);
  EXPECT_EQ(back.count, kind.count);
}

TEST_F(KeptResultsTest, WhatIsOfAnotherTypeIsComputedAnew) {
  KeptResults kept(store());
  kept.keep(1, {1e9, 2.0});
  EXPECT_FALSE(kept_result<Kind>(&kept, 1));
  kept.keep(2, Numbers::of(std::vector<double>{1.0, 2.0}));
  EXPECT_FALSE(kept_result<double>(&kept, 2)) << "more than one number";
}

TEST_F(KeptResultsTest, AStudyGoesOnWithTheRungThatItWasBegunWith) {
  int chosen = 0;
  const auto choose = [&] { return RungChoice{.name = ++chosen == 1 ? "perturbation" : "multibody", .why = "asked"}; };
  {
    const StudyRun run = study("one");
    const Unfinished begun = run.go_on(choose);
    EXPECT_FALSE(std::filesystem::exists(folder_ / kUnfinished)) << "nothing to keep yet";
    begun.results->keep(7, {1.0});
  }
  {
    const StudyRun run = study("one");
    const Unfinished on = run.go_on(choose);
    EXPECT_EQ(on.rung.name, "perturbation");
    EXPECT_EQ(on.results->size(), 1u);
    EXPECT_EQ(chosen, 1);
  }
  {
    const StudyRun run = study("one");
    const Unfinished anew = run.go_on(choose, "something else decides");
    EXPECT_EQ(anew.rung.name, "multibody");
    EXPECT_EQ(anew.results->size(), 0u);
  }
  study("one").forget(kUnfinished);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(KeptResultsTest, AStudyDoesNotGoOnWithWhatAnotherVersionKept) {
  const auto of = [&](const std::string& version) {
    return StudyRun(mechanism_, {.identity = "one", .version = version, .folder = folder_});
  };
  const auto choose = [] { return RungChoice{.name = "perturbation", .why = "asked"}; };
  of("0.9.0").open_samples("", {"x"});
  of("0.9.0").go_on(choose).results->keep(7, {1.0});
  of("0.9.0").open_evaluations("evaluations.db", {"x"}, "perturbation", 1e-5, "a model");
  const StudyRun later = of("1.0.0");
  const auto refused = testing::ThrowsMessage<StoreRefused>(
      testing::AllOf(testing::HasSubstr("version 0.9.0"), testing::HasSubstr("give another --out, or remove it")));
  EXPECT_THAT([&] { later.open_samples("", {"x"}); }, refused);
  EXPECT_THAT([&] { later.go_on(choose); }, refused);
  for (const char* model : {"a model", "another model"})
    EXPECT_THAT([&] { later.open_evaluations("evaluations.db", {"x"}, "perturbation", 1e-5, model); }, refused);
  EXPECT_THAT([&] { later.rung_of_designs({}, "evaluations.db"); }, refused);
  EXPECT_EQ(of("0.9.0").go_on(choose).results->size(), 1u) << "it is left as it was";
}

TEST_F(KeptResultsTest, AStoreThatWasCutShortAsItWasMadeBlocksNobody) {
  std::ofstream(folder_ / kUnfinished).close();
  const StudyRun run = study("one");
  const Unfinished begun = run.go_on([] { return RungChoice{.name = "perturbation", .why = "asked"}; });
  EXPECT_EQ(begun.rung.name, "perturbation");
  begun.results->keep(7, {1.0});
  EXPECT_TRUE(begun.results->find(7));
}

}  // namespace kept_results_test
}  // namespace boresight
