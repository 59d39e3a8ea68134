#include "boresight_analyses/runs/ranks.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

#ifdef BORESIGHT_MPI
#include <mpi.h>
#endif

namespace boresight {
namespace {

class Alone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void broadcast(std::string&) override {}
  void wait_for_all() override {}
  bool share(const Work& work) override {
    for (const NumberRange& block : work.blocks) {
      if (work.enough()) return false;
      bool whole = true;
      work.compute(block, whole);
      if (!whole) return false;
    }
    return true;
  }
};

#ifdef BORESIGHT_MPI

bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

class Mpi final : public Ranks {
 public:
  Mpi() {
    // Whoever has begun it, as another library of an interpreter, ends it too.
    int begun = 0, provided = 0;
    MPI_Initialized(&begun);
    own_ = begun == 0;
    if (own_) MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  // A rank that ends by an exception leaves without finalising: mpirun then ends the others.
  ~Mpi() override {
    if (own_ && std::uncaught_exceptions() == 0) MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void broadcast(std::string& text) override {
    auto length = static_cast<unsigned long>(text.size());
    MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
    text.resize(length);
    MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, MPI_COMM_WORLD);
  }
  void wait_for_all() override { MPI_Barrier(MPI_COMM_WORLD); }

  bool share(const Work& work) override {
    if (rank_ > 0) {
      ask(work);
      return true;
    }
    return hand_out(work);
  }

 private:
  static constexpr int kNext = 1, kLeaving = 2, kBlock = 3;

  static void ask(const Work& work) {
    std::vector<double> values;
    bool whole = true;
    for (;;) {
      MPI_Send(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, whole ? kNext : kLeaving, MPI_COMM_WORLD);
      if (!whole) return;
      unsigned long block[2] = {0, 0};
      MPI_Recv(block, 2, MPI_UNSIGNED_LONG, 0, kBlock, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      if (block[0] == block[1]) return;
      values = work.compute({block[0], block[1]}, whole);
    }
  }

  bool hand_out(const Work& work) const {
    std::mutex mutex;
    std::size_t next = 0;
    bool all_whole = true;
    std::exception_ptr fault;
    const auto take = [&]() -> NumberRange {
      const std::scoped_lock lock(mutex);
      if (next == work.blocks.size()) return {};
      if (fault || work.enough()) {
        all_whole = false;
        return {};
      }
      return work.blocks[next++];
    };
    std::atomic<bool> own_done{false};
    std::thread own([&] {
      try {
        for (NumberRange block = take(); block.size() > 0; block = take()) {
          bool whole = true;
          work.compute(block, whole);
          const std::scoped_lock lock(mutex);
          all_whole = all_whole && whole;
          if (!whole) break;
        }
      } catch (...) {
        const std::scoped_lock lock(mutex);
        fault = std::current_exception();
      }
      own_done = true;
    });
    int others = size_ - 1;
    std::vector<double> values;
    while (others > 0 || !own_done) {
      int waiting = 0;
      MPI_Status status;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &waiting, &status);
      if (!waiting) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      int count = 0;
      MPI_Get_count(&status, MPI_DOUBLE, &count);
      values.resize(static_cast<std::size_t>(count));
      MPI_Recv(values.data(), count, MPI_DOUBLE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      if (count > 0) work.brought(values);
      if (status.MPI_TAG == kLeaving) {
        const std::scoped_lock lock(mutex);
        all_whole = false;
        --others;
        continue;
      }
      const NumberRange block = take();
      const unsigned long ends[2] = {block.first, block.end};
      MPI_Send(ends, 2, MPI_UNSIGNED_LONG, status.MPI_SOURCE, kBlock, MPI_COMM_WORLD);
      if (block.size() == 0) --others;
    }
    own.join();
    if (fault) std::rethrow_exception(fault);
    return all_whole;
  }

  int rank_ = 0, size_ = 1;
  bool own_ = true;
};

#endif

}  // namespace

std::vector<NumberRange> blocks_of(const std::vector<NumberRange>& ranges, std::uint64_t most) {
  std::vector<NumberRange> blocks;
  for (const NumberRange& range : ranges)
    for (std::uint64_t first = range.first; first < range.end; first += most)
      blocks.push_back({first, std::min(first + most, range.end)});
  return blocks;
}

std::unique_ptr<Ranks> Ranks::join() {
#ifdef BORESIGHT_MPI
  if (started_by_mpi()) {
    // A second study of one process, an interpreter, whose ranks have parted: once ended MPI cannot begin again.
    int ended = 0;
    MPI_Finalized(&ended);
    if (ended == 0) return std::make_unique<Mpi>();
  }
#endif
  return std::make_unique<Alone>();
}

}  // namespace boresight
