#include "boresight_analyses/runs/kept_results.hpp"

namespace boresight {

// Doubles hold 53 bits.
std::vector<std::string> KeptResults::columns() { return {"key_high", "key_low"}; }

KeptResults::KeptResults(std::unique_ptr<SampleStore> store) : store_(std::move(store)), earlier_(store_->earlier()) {
  store_->read(~std::uint64_t{0} >> 1, [&](const SampleRecord& record) {
    number_[(static_cast<std::uint64_t>(record.inputs[0]) << 32) | static_cast<std::uint64_t>(record.inputs[1])] =
        record.number;
    next_number_ = record.number + 1;
  });
}

KeptResults::KeptResults(std::function<std::unique_ptr<SampleStore>()> make) : make_(std::move(make)) {}

std::size_t KeptResults::size() const {
  const std::scoped_lock lock(mutex_);
  return number_.size();
}

std::optional<std::vector<double>> KeptResults::find(std::uint64_t key) const {
  const std::scoped_lock lock(mutex_);
  const auto found = number_.find(key);
  if (found == number_.end()) return {};
  return store_->history(found->second);
}

void KeptResults::keep(std::uint64_t key, std::vector<double> numbers) {
  constexpr auto kCommitEvery = std::chrono::milliseconds(250);
  const std::scoped_lock lock(mutex_);
  if (!store_) store_ = make_();
  if (!number_.emplace(key, next_number_).second) return;
  SampleRecord record;
  record.number = next_number_++;
  record.inputs = {static_cast<double>(key >> 32), static_cast<double>(key & 0xffffffffu)};
  record.outcome.status = Outcome::Status::done;
  record.outcome.history = std::move(numbers);
  store_->add(record);
  const auto now = std::chrono::steady_clock::now();
  if (now < next_commit_) return;
  store_->commit();
  next_commit_ = now + kCommitEvery;
}

void KeptResults::forget(std::uint64_t key) {
  const std::scoped_lock lock(mutex_);
  const auto found = number_.find(key);
  if (found == number_.end()) return;
  store_->remove(found->second);
  number_.erase(found);
}

}  // namespace boresight
