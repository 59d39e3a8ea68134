// This process among those that mpirun started (MPI), or alone.
//
// Rank 0 hands out blocks of sample numbers; each rank computes its block with its own threads and asks for the next
// one, bringing the values of the last. Rank 0 answers from its main thread while its own threads compute. A rank that
// is lost costs at most what it had not yet committed.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/runs/sample_store.hpp"

namespace boresight {

// The ranges cut into blocks of at most `most` numbers, in order.
std::vector<NumberRange> blocks_of(const std::vector<NumberRange>& ranges, std::uint64_t most);

class Ranks {
 public:
  // Joins the other processes if mpirun (or srun) started this one. Call once.
  static std::unique_ptr<Ranks> join();
  virtual ~Ranks() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Rank 0's text, to all.
  virtual void broadcast(std::string& text) = 0;
  virtual void wait_for_all() = 0;

  struct Work {
    std::vector<NumberRange> blocks;  // on rank 0; elsewhere not looked at
    // Computes a block and returns its values in any order, NaN for failed ones; `whole`: false if it was cut short.
    std::function<std::vector<double>(const NumberRange&, bool& whole)> compute;
    // On rank 0: values that another rank brought.
    std::function<void(std::span<const double>)> brought;
    // On rank 0: whether to hand out no further block.
    std::function<bool()> enough;
  };
  // Returns on rank 0 whether every block was computed whole; elsewhere true.
  virtual bool share(const Work& work) = 0;
};

}  // namespace boresight
