#include "boresight_analyses/random/sampling_design.hpp"

#include <bit>
#include <stdexcept>

#include "boresight_analyses/random/counter_stream.hpp"
#include "boresight_analyses/random/permutation.hpp"

namespace boresight {

const char* to_string(SamplingKind kind) {
  switch (kind) {
    case SamplingKind::random:
      return "random";
    case SamplingKind::lhs:
      return "lhs";
    case SamplingKind::sobol:
      return "sobol";
  }
  return "";
}

std::string SamplingOptions::text() const {
  std::string text = std::string(to_string(kind)) + ", seed " + std::to_string(seed);
  if (kind == SamplingKind::lhs) text += ", strata " + std::to_string(strata);
  if (kind == SamplingKind::sobol) text += ", replicates " + std::to_string(replicates);
  return text;
}

SamplingDesign::SamplingDesign(const SamplingOptions& options, int dimensions)
    : options_(options), dimensions_(dimensions) {
  if (dimensions < 1) throw std::invalid_argument("a design has at least one dimension");
  if (options.kind == SamplingKind::lhs && options.strata < 2) throw std::invalid_argument("strata: at least 2");
  if (options.kind == SamplingKind::sobol) {
    if (options.replicates < 2) throw std::invalid_argument("replicates: at least 2");
    net_ = std::make_unique<SobolNet>(dimensions);
  }
}

void SamplingDesign::point(std::uint64_t k, std::span<double> coordinates) const {
  const std::uint64_t seed = options_.seed;
  switch (options_.kind) {
    case SamplingKind::random: {
      const CounterStream stream(seed, StreamPurpose::sample);
      for (int d = 0; d < dimensions_; ++d) coordinates[d] = stream.uniform(k, static_cast<std::uint64_t>(d));
      return;
    }
    case SamplingKind::lhs: {
      const CounterStream place(seed, StreamPurpose::within_cell);
      const std::uint64_t n = options_.strata, hypercube = k / n;
      for (int d = 0; d < dimensions_; ++d) {
        const auto dimension = static_cast<std::uint64_t>(d);
        const std::uint64_t stratum = permuted(k % n, n, seed, hypercube, dimension);
        coordinates[d] = (static_cast<double>(stratum) + place.uniform(k, dimension)) / static_cast<double>(n);
      }
      return;
    }
    case SamplingKind::sobol:
      for (int d = 0; d < dimensions_; ++d)
        coordinates[d] = net_->scrambled(k / options_.replicates, d, seed, k % options_.replicates);
      return;
  }
}

std::uint64_t SamplingDesign::replicate_of(std::uint64_t k) const {
  return options_.kind == SamplingKind::lhs ? k / options_.strata : k % options_.replicates;
}

std::uint64_t SamplingDesign::whole_replicates(std::uint64_t n) const {
  if (options_.kind == SamplingKind::lhs) return n / options_.strata;
  return n >= options_.replicates ? options_.replicates : 0;
}

std::uint64_t SamplingDesign::whole_points(std::uint64_t n) const {
  if (options_.kind == SamplingKind::random) return n;
  const std::uint64_t unit = options_.kind == SamplingKind::lhs ? options_.strata : options_.replicates;
  return n / unit * unit;
}

std::string SamplingDesign::warning(std::uint64_t n) const {
  if (options_.kind == SamplingKind::lhs && n < 10 * options_.strata)
    return "only " + std::to_string(n / options_.strata) + " hypercubes of " + std::to_string(options_.strata) +
           " points: intervals from fewer than ten replicates are wide; take more samples or fewer strata";
  if (options_.kind == SamplingKind::sobol) {
    const std::uint64_t each = n / options_.replicates;
    if (each == 0 || n % options_.replicates != 0 || !std::has_single_bit(each)) {
      const std::uint64_t low = std::bit_floor(each == 0 ? 1 : each) * options_.replicates;
      return std::to_string(n) + " samples are not a power of two in each of the " +
             std::to_string(options_.replicates) + " nets, so the nets lose part of their balance; " +
             std::to_string(low) + " or " + std::to_string(2 * low) + " would keep it";
    }
  }
  return "";
}

}  // namespace boresight
