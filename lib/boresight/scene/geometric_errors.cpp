#include "boresight/scene/geometric_errors.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

constexpr int kBlock = 8;                      // samples side by side
using Side = Eigen::Array<double, kBlock, 1>;  // a number of each
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Of a turn by phi, from its square: sin(phi)/phi, (1 - cos(phi))/phi^2, and (sin(phi/2)/(phi/2))^2, which is twice the second.
struct Turned {
  Side sine, cosine;
};
Turned turned(const Side& square) {
  // Series where they are exact to rounding, which turns by errors hardly ever leave.
  constexpr double kSmall = 0.01;
  if (square.maxCoeff() < kSmall)
    return {1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0))),
            0.5 * (1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0 * (1.0 - square / 90.0))))};
  Turned exact;
  for (int j = 0; j < kBlock; ++j) {
    const double angle = std::sqrt(square[j]), half = 0.5 * angle;
    exact.sine[j] = angle > 0.0 ? std::sin(angle) / angle : 1.0;
    exact.cosine[j] = angle > 0.0 ? 0.5 * std::pow(std::sin(half) / half, 2) : 0.5;
  }
  return exact;
}

// out = rows x eps, kBlock columns side by side: two thirds of all operations. Processors with fused multiply-adds give the same bits, and
// so do those without.
template <int W>  // of a register
[[gnu::always_inline]] inline void contract_rows(const double* rows, Eigen::Index count, Eigen::Index errors,
                                                 const double* eps, double* out) {
  using Numbers [[gnu::vector_size(W * sizeof(double))]] = double;
  constexpr int kParts = kBlock / W;
  constexpr Eigen::Index kTogether = W == 8 ? 6 : 12 / W;  // rows; every knot has three or six
  for (Eigen::Index r = 0; r < count; r += kTogether) {
    // Towards the end some rows are taken twice.
    const Eigen::Index first = std::min(r, count - kTogether);
    const double* row = rows + first * errors;
    Numbers sum[kTogether][kParts] = {};
    for (Eigen::Index e = 0; e < errors; ++e) {
      Numbers column[kParts];
      for (int part = 0; part < kParts; ++part)
        __builtin_memcpy(&column[part], eps + kBlock * e + W * part, sizeof(Numbers));
      for (Eigen::Index i = 0; i < kTogether; ++i)
        for (int part = 0; part < kParts; ++part) sum[i][part] += row[i * errors + e] * column[part];
    }
    for (Eigen::Index i = 0; i < kTogether; ++i)
      for (int part = 0; part < kParts; ++part)
        __builtin_memcpy(out + kBlock * (first + i) + W * part, &sum[i][part], sizeof(Numbers));
  }
}
#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] void contract_avx2(const double* rows, Eigen::Index count, Eigen::Index errors,
                                               const double* eps, double* out) {
  contract_rows<4>(rows, count, errors, eps, out);
}
[[gnu::target("avx512f,fma")]] void contract_avx512(const double* rows, Eigen::Index count, Eigen::Index errors,
                                                    const double* eps, double* out) {
  contract_rows<8>(rows, count, errors, eps, out);
}
#endif
void contract(const double* rows, Eigen::Index count, Eigen::Index errors, const double* eps, double* out) {
#if defined(__x86_64__)
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  static const bool widest = wide && __builtin_cpu_supports("avx512f");
  if (widest) return contract_avx512(rows, count, errors, eps, out);
  if (wide) return contract_avx2(rows, count, errors, eps, out);
#endif
  contract_rows<2>(rows, count, errors, eps, out);
}

struct Vector {
  Side x, y, z;
  Side square() const { return x * x + y * y + z * z; }
};
// a x b
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector cross(const Vector& a, const Vec3& b) {
  return {a.y * b.z() - a.z * b.y(), a.z * b.x() - a.x * b.z(), a.x * b.y() - a.y * b.x()};
}

}  // namespace

struct GeometricErrors::Prepared {
  std::shared_ptr<const Mechanism> mechanism;
  PointingQuantity quantity;
  TimeStatistic statistic;
  double start;
  IdealMotion commanded;
  std::shared_ptr<const StandingErrors> influence;
  StandingColumns columns;
  Columns values;  // of them, row by row
  StandingCurvature curvature;
  std::vector<double> time;  // of every instant
  std::vector<Vec3> axis,
      line;  // of the ideal motion at every instant: pointing axis; to the target, and from the centre of mass to
  std::vector<Vec3> arm;     // where that line starts
  std::size_t first = 0;     // instant that counts
  double first_share = 0.0;  // of the one before it: how far the start lies behind that
  TimeWeights weights;

  Prepared(std::shared_ptr<const Mechanism> mechanism_of, PointingQuantity quantity_of, TimeStatistic statistic_of,
           double start_of, const std::vector<double>& typical);
  std::vector<double> counted() const;
  Side square(const Side* x, std::size_t instant) const;
  double value(double square) const;
  void block(std::span<const Parameters> samples, std::span<GeometricOutcome> outcomes) const;
  void take(const std::vector<Side>& squares, Eigen::Index column, GeometricOutcome& outcome) const;
};

namespace {

// All six of the displacement, or its half that the quantity hangs on.
Eigen::Matrix<double, Eigen::Dynamic, 6> parts(PointingQuantity quantity) {
  const MatX all = MatX::Identity(6, 6);
  switch (quantity) {
    case PointingQuantity::position_error:
      return all.topRows(3);
    case PointingQuantity::line_of_sight_error:
      return all;
    case PointingQuantity::orientation_error:
    case PointingQuantity::boresight_error:
      break;
  }
  return all.bottomRows(3);
}

}  // namespace

GeometricErrors::Prepared::Prepared(std::shared_ptr<const Mechanism> mechanism_of, PointingQuantity quantity_of,
                                    TimeStatistic statistic_of, double start_of, const std::vector<double>& typical)
    : mechanism(std::move(mechanism_of)),
      quantity(quantity_of),
      statistic(statistic_of),
      start(start_of),
      commanded(ideal_motion(*mechanism, mechanism->parameters())),
      influence(StandingErrors::of_all(*mechanism, commanded)),
      columns(*influence, mechanism->boresight_body(), static_cast<int>(parts(quantity).rows()),
              [this](double) { return parts(quantity); }),
      values(columns.values),
      curvature(*mechanism, commanded, *influence, quantity, typical),
      weights({}) {
  const long instants = static_cast<long>(influence->cells()) * influence->instants_a_cell();
  for (long i = 0; i <= instants; ++i) {
    const double t = mechanism->duration() * static_cast<double>(i) / static_cast<double>(instants);
    const BodyMotion ideal = commanded.body(t, mechanism->boresight_body());
    time.push_back(t);
    axis.push_back(ideal.R * mechanism->boresight_B());
    if (const auto& sight = mechanism->pointing().line_of_sight) {
      arm.push_back(ideal.R * sight->from_B);
      line.push_back(sight->line({ideal.p, Quat(ideal.R)}));
    }
  }
  while (first + 1 < time.size() && time[first] < start) ++first;
  if (first > 0 && time[first] > start) first_share = (start - time[first - 1]) / (time[first] - time[first - 1]);
  weights = TimeWeights(counted());
}

// As StatisticsOverTime counts: from the start on, where that lies between two instants by the straight line between them.
std::vector<double> GeometricErrors::Prepared::counted() const {
  std::vector<double> times(time.begin() + static_cast<std::ptrdiff_t>(first), time.end());
  if (first_share > 0.0) times.insert(times.begin(), start);
  return times;
}

// A number that grows with the index at one instant, cheaper than that; exactly as pose_error() has it of a body displaced by x.
Side GeometricErrors::Prepared::square(const Side* x, std::size_t instant) const {
  const Vector first_part{x[0], x[1], x[2]};
  switch (quantity) {
    case PointingQuantity::position_error:
    case PointingQuantity::orientation_error:
      return first_part.square();
    case PointingQuantity::boresight_error:
      // The chord between the two axes: |turn x axis| sin(phi/2)/(phi/2).
      return cross(first_part, axis[instant]).square() * 2.0 * turned(first_part.square()).cosine;
    case PointingQuantity::line_of_sight_error:
      break;
  }
  // The tangent of the line's turn: the start of the line moves by d = p + (sin/phi) turn x arm + (1 - cos)/phi^2 turn x (turn x arm).
  const Vector turn{x[3], x[4], x[5]}, once = cross(turn, arm[instant]), twice = cross(turn, once);
  const Turned by = turned(turn.square());
  const Vector d{x[0] + by.sine * once.x + by.cosine * twice.x, x[1] + by.sine * once.y + by.cosine * twice.y,
                 x[2] + by.sine * once.z + by.cosine * twice.z};
  const Vec3& l = line[instant];
  const Side along = l.squaredNorm() - (d.x * l.x() + d.y * l.y() + d.z * l.z());
  const Side across = cross(d, l).square();
  // Beyond a right angle the target has been passed.
  return (along > 0.0).select(across / (along * along), Side::Constant(std::numeric_limits<double>::infinity()));
}

double GeometricErrors::Prepared::value(double square_of) const {
  const double root = std::sqrt(square_of);
  if (quantity == PointingQuantity::boresight_error) return 2.0 * std::asin(std::min(1.0, 0.5 * root));
  return quantity == PointingQuantity::line_of_sight_error ? std::atan(root) : root;
}

void GeometricErrors::Prepared::take(const std::vector<Side>& squares, Eigen::Index column,
                                     GeometricOutcome& outcome) const {
  thread_local std::vector<double> over_time;
  over_time.clear();
  for (std::size_t i = first; i < squares.size(); ++i) over_time.push_back(value(squares[i][column]));
  if (first_share > 0.0) {
    const double before = value(squares[first - 1][column]);
    over_time.insert(over_time.begin(), before + first_share * (over_time.front() - before));
  }
  switch (statistic) {
    case TimeStatistic::max: {
      const std::size_t place = weights.place_of_max(over_time);
      outcome.value = over_time[place];
      const std::size_t skipped = first_share > 0.0 ? 1 : 0;
      outcome.time_of_max = place < skipped ? start : time[first + place - skipped];
      break;
    }
    case TimeStatistic::rms:
      outcome.value = weights.rms(over_time);
      break;
    case TimeStatistic::mean:
      outcome.value = weights.mean(over_time);
      break;
    case TimeStatistic::p9973:
      outcome.value = weights.p9973(over_time);
      break;
  }
}

void GeometricErrors::Prepared::block(std::span<const Parameters> samples, std::span<GeometricOutcome> outcomes) const {
  const auto errors = static_cast<Eigen::Index>(values.cols());
  thread_local std::vector<Side> of_errors, at_knots, squares;
  of_errors.assign(static_cast<std::size_t>(errors), Side::Zero());
  for (std::size_t j = 0; j < samples.size(); ++j) {
    try {
      influence->require(samples[j].error);
    } catch (const ComputationError& strained) {
      outcomes[j].refusal = strained.what();
      continue;
    }
    for (Eigen::Index e = 0; e < errors; ++e)
      of_errors[static_cast<std::size_t>(e)][static_cast<Eigen::Index>(j)] =
          samples[j].error[static_cast<std::size_t>(e)];
  }
  at_knots.resize(static_cast<std::size_t>(values.rows()));
  contract(values.data(), values.rows(), errors, of_errors[0].data(), at_knots[0].data());
  // The cubics of TimeTable, at instants that lie alike in every cell.
  const int f = columns.functions, per_cell = influence->instants_a_cell();
  squares.resize(time.size());
  // The highest square is that of the highest value, and all that a maximum over the whole motion asks for.
  const bool peak = statistic == TimeStatistic::max && first == 0;
  Side highest = Side::Zero(), place = Side::Zero();
  const auto see = [&](const Side* displacement, std::size_t instant) {
    const Side found = square(displacement, instant);
    if (!peak) {
      squares[instant] = found;
      return;
    }
    place = (found > highest).select(Side::Constant(static_cast<double>(instant)), place);
    highest = highest.max(found);
  };
  Side slope[6], next_slope[6], x[6];
  const auto at_knot = [&](int k, int i) -> const Side& { return at_knots[static_cast<std::size_t>(f * k + i)]; };
  const auto slopes_at = [&](int k, Side* out) {
    for (int i = 0; i < f; ++i)
      out[i] = TimeTable::slope_at_knot(k, columns.knots, [&](int n) { return Side(at_knot(n, i)); });
  };
  slopes_at(0, next_slope);
  for (int k = 0; k + 1 < columns.knots; ++k) {
    std::copy_n(next_slope, f, slope);
    slopes_at(k + 1, next_slope);
    const auto from = static_cast<std::size_t>(k) * static_cast<std::size_t>(per_cell);
    for (int i = 0; i < f; ++i) x[i] = at_knot(k, i);
    see(x, from);
    for (int n = 1; n < per_cell; ++n) {
      const double s = static_cast<double>(n) / per_cell, s2 = s * s, s3 = s2 * s;
      const double to = 3.0 * s2 - 2.0 * s3, from_slope = s - 2.0 * s2 + s3, to_slope = s3 - s2;
      for (int i = 0; i < f; ++i)
        x[i] = (1.0 - to) * at_knot(k, i) + to * at_knot(k + 1, i) + from_slope * slope[i] + to_slope * next_slope[i];
      see(x, from + static_cast<std::size_t>(n));
    }
  }
  for (int i = 0; i < f; ++i) x[i] = at_knot(columns.knots - 1, i);
  see(x, time.size() - 1);
  for (std::size_t j = 0; j < samples.size(); ++j) {
    if (!outcomes[j].refusal.empty()) continue;
    const auto column = static_cast<Eigen::Index>(j);
    if (peak) {
      outcomes[j].value = value(highest[column]);
      outcomes[j].time_of_max = time[static_cast<std::size_t>(place[column])];
    } else {
      take(squares, column, outcomes[j]);
    }
    outcomes[j].model_error = curvature.error(samples[j].error, outcomes[j].value);
  }
}

bool GeometricErrors::serve(const Mechanism& mechanism) {
  return !mechanism.description().errors.empty() && mechanism.clearances() == 0 && is_kinematic(mechanism);
}

GeometricErrors::GeometricErrors(std::shared_ptr<const Mechanism> mechanism, PointingQuantity quantity,
                                 TimeStatistic statistic, double start, const std::vector<double>& typical)
    : prepared_(std::make_unique<const Prepared>(std::move(mechanism), quantity, statistic, start, typical)) {}
GeometricErrors::~GeometricErrors() = default;

double GeometricErrors::operations() const {
  const double errors = prepared_->influence->count(),
               rows = prepared_->quantity == PointingQuantity::line_of_sight_error ? 6.0 : 3.0;
  const double knots = prepared_->influence->cells() + 1.0, instants = static_cast<double>(prepared_->time.size());
  return 2.0 * rows * knots * errors + 30.0 * instants;
}

std::size_t GeometricErrors::run(std::span<const Parameters> samples, std::span<GeometricOutcome> outcomes,
                                 const std::atomic<bool>* stop) const {
  std::size_t done = 0;
  while (done < samples.size() && (stop == nullptr || !stop->load(std::memory_order_relaxed))) {
    const std::size_t some = std::min<std::size_t>(kBlock, samples.size() - done);
    prepared_->block(samples.subspan(done, some), outcomes.subspan(done, some));
    done += some;
  }
  return done;
}

}  // namespace boresight
