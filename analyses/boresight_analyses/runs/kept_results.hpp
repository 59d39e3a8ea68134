// Results of the long computations that a study is made of, each kept as it is done: a start that goes on finds there what the
// ones before it computed. A kill loses at most the last quarter of a second of them.
//
//   const Measurement m = kept_or_computed<Measurement>(kept, number, [&] { return measure(...); });
//
// The file is a store of samples (sample_store.hpp), a result the history of one.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/runs/numbers.hpp"
#include "boresight_analyses/runs/sample_store.hpp"

namespace boresight {

class KeptResults {
 public:
  // store: opened with columns(); one that is there, or made with the first result.
  explicit KeptResults(std::unique_ptr<SampleStore> store);
  explicit KeptResults(std::function<std::unique_ptr<SampleStore>()> make);
  static std::vector<std::string> columns();

  // What the starts before this one took.
  SampleStore::Cost earlier() const { return earlier_; }
  // Of all starts together.
  std::size_t size() const;

  // From any thread. A key says what a result is the result of, and is kept once. Throw StoreFailed.
  std::optional<std::vector<double>> find(std::uint64_t key) const;
  void keep(std::uint64_t key, std::vector<double> numbers);
  // Of what a larger result took in. Nothing where nothing is kept under it.
  void forget(std::uint64_t key);

 private:
  std::unique_ptr<SampleStore> store_;
  std::function<std::unique_ptr<SampleStore>()> make_;
  SampleStore::Cost earlier_;
  std::map<std::uint64_t, std::uint64_t> number_;  // of the sample, by key
  std::uint64_t next_number_ = 0;
  std::chrono::steady_clock::time_point next_commit_;
  mutable std::mutex mutex_;
};

// kept: may be none.
template <typename Result>
std::optional<Result> kept_result(const KeptResults* kept, std::uint64_t key) {
  if (kept == nullptr) return {};
  std::optional<std::vector<double>> numbers = kept->find(key);
  if (!numbers) return {};
  try {
    return Numbers::back<Result>(std::move(*numbers));
  } catch (const std::out_of_range&) {  // of another version
    return {};
  }
}

template <typename Result, typename Compute>
Result kept_or_computed(KeptResults* kept, std::uint64_t key, const Compute& compute) {
  if (std::optional<Result> found = kept_result<Result>(kept, key)) return std::move(*found);
  Result result = compute();
  if (kept != nullptr) kept->keep(key, Numbers::of(result));
  return result;
}

}  // namespace boresight
