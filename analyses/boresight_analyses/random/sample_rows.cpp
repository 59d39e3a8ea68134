#include "boresight_analyses/random/sample_rows.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <numeric>

#include "boresight/math/eigenvalues.hpp"

namespace boresight {
namespace {

// 0 to n - 1; ties share their mean.
VecX ranks_of(const VecX& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
  VecX ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    const double shared = 0.5 * static_cast<double>(first + last);
    for (; first <= last; ++first) ranks[order[first]] = shared;
  }
  return ranks;
}

}  // namespace

SampleRows::SampleRows(const MatX& rows) : rows_(rows) {
  const Eigen::Index n = rows.rows(), d = rows.cols();
  MatX ranks(n, d);
  for (Eigen::Index k = 0; k < d; ++k) ranks.col(k) = ranks_of(rows.col(k)).array() - 0.5 * static_cast<double>(n - 1);
  const Eigen::SelfAdjointEigenSolver<MatX> principal(ranks.transpose() * ranks);
  VecX axis = principal.eigenvectors().col(d - 1);
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  if (axis[largest] < 0.0) axis = -axis;
  const VecX along = ranks * axis;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return along[a] < along[b]; });
  for (Eigen::Index i = 0; i < n; ++i) rows_.row(i) = rows.row(order[static_cast<std::size_t>(i)]);
}

std::string SampleRows::text() const {
  // FNV-1a (Fowler, Noll, Vo, 64 bits) over all values.
  std::uint64_t hash = 14695981039346656037ull;
  for (Eigen::Index i = 0; i < rows_.size(); ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(rows_.data()[i] + 0.0);
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ ((bits >> (8 * byte)) & 0xff)) * 1099511628211ull;
  }
  char text[80];
  std::snprintf(text, sizeof text, "rows(%ld of %ld, %016llx)", static_cast<long>(rows_.rows()),
                static_cast<long>(rows_.cols()), static_cast<unsigned long long>(hash));
  return text;
}

Eigen::Index SampleRows::row_of(double u) const {
  return std::min(static_cast<Eigen::Index>(u * static_cast<double>(rows_.rows())), rows_.rows() - 1);
}

namespace {

// The column's values by themselves, as any measured ones, and where they are from.
class ColumnOfRows final : public Distribution {
 public:
  ColumnOfRows(std::shared_ptr<const SampleRows> rows, Eigen::Index k) : rows_(std::move(rows)), k_(k) {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < rows_->size(); ++i) values.push_back(rows_->at(i, k));
    own_ = make_empirical(std::move(values));
  }
  std::string text() const override { return rows_->text() + " column " + std::to_string(k_); }
  double quantile(double u) const override { return own_->quantile(u); }
  double upper_quantile(double v) const override { return own_->upper_quantile(v); }
  double cdf(double x) const override { return own_->cdf(x); }
  double survival(double x) const override { return own_->survival(x); }
  double density(double x) const override { return own_->density(x); }
  double lowest() const override { return own_->lowest(); }
  double highest() const override { return own_->highest(); }
  bool is_discrete() const override { return true; }
  double mean() const override { return own_->mean(); }
  double sd() const override { return own_->sd(); }

  const SampleRows& rows() const { return *rows_; }
  bool first() const { return k_ == 0; }

 private:
  DistributionPtr shared() const override { return std::make_shared<ColumnOfRows>(*this); }

  std::shared_ptr<const SampleRows> rows_;
  Eigen::Index k_;
  DistributionPtr own_;
};

}  // namespace

DistributionPtr column_of(std::shared_ptr<const SampleRows> rows, Eigen::Index k) {
  return std::make_shared<ColumnOfRows>(std::move(rows), k);
}

const SampleRows* rows_with(const DistributionPtr& distribution) {
  const auto* column = dynamic_cast<const ColumnOfRows*>(distribution.get());
  return column != nullptr ? &column->rows() : nullptr;
}

const SampleRows* rows_from(const DistributionPtr& distribution) {
  const auto* column = dynamic_cast<const ColumnOfRows*>(distribution.get());
  return column != nullptr && column->first() ? &column->rows() : nullptr;
}

}  // namespace boresight
