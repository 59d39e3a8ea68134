// Evaluations that were paid for, kept for the next start: every sample of every design is a row of a store
// of samples (montecarlo/sample_store.hpp), with the design's variables, the sample's place in its design,
// and the contact measures as columns. A design counts as known once all its samples are there; one that a
// kill cut short is computed anew.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/runs/sample_store.hpp"

namespace boresight {

class EvaluationStore {
 public:
  // `facts` name the study, and all that decides an outcome but the design: rung, step, seed, number of
  // samples. Throws StoreRefused, StoreFailed.
  EvaluationStore(const std::filesystem::path& file, const std::map<std::string, std::string>& facts,
                  const std::vector<std::string>& variables, const std::string& rung, double step);

  std::size_t size() const { return known_.size(); }  // whole designs
  // The outcomes of a design's samples, in order, if all of them are known.
  const std::vector<Outcome>* find(std::span<const double> design, std::size_t samples) const;
  // Commits: the design is on disk when this returns.
  void add(std::span<const double> design, const std::vector<Outcome>& outcomes);
  void note(const std::string& key, const std::string& value) { store_.note(key, value); }
  std::string fact(const std::string& key) const { return store_.fact(key); }
  std::string damage() const { return store_.damage(); }
  SampleStore::Cost earlier() const { return store_.earlier(); }

 private:
  SampleStore store_;
  std::size_t variables_;
  std::uint64_t next_ = 0;
  std::map<std::vector<double>, std::vector<Outcome>> known_;
};

}  // namespace boresight
