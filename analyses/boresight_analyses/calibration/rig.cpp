#include "boresight_analyses/calibration/rig.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdio>

#include "boresight/io/content_hash.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {

double channel_reading(int channel, const PoseSample& s, const Vec3& boresight_B, const Vec3& place_B) {
  if (is_of_a_point(channel)) {
    const Vec3 displacement = s.error.displacement + (s.pose.q * place_B - s.ideal.q * place_B);
    return channel < 3 ? displacement[channel] : displacement.norm();
  }
  if (channel < 6) return s.error.rotation[channel - 3];
  if (channel < 9) return (s.pose.q * boresight_B - s.ideal.q * boresight_B)[channel - 6];
  const double sizes[] = {s.error.orientation, s.error.boresight, s.error.line_of_sight};
  return sizes[channel - 10];
}

namespace {

// Of a history in which the readings' times lie, or lie close to: a clock that is off puts all of them between its samples, and a contact
// turns the motion within one.
double spacing_for(const std::vector<double>& times, double duration) {
  constexpr double kFinest = 1e-5, kMostSamples = 2e5, kFiner = 50.0;
  double spacing = duration;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) spacing = std::min(spacing, times[i] - times[i - 1]);
  const bool on_grid = std::all_of(times.begin(), times.end(),
                                   [&](double t) { return std::abs(t - spacing * std::round(t / spacing)) < 1e-9; });
  if (on_grid) return std::max(spacing, kFinest);
  return std::max({std::min(spacing, 1e-3) / kFiner, kFinest, duration / kMostSamples});
}

}  // namespace

MatX multibody_readings(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters,
                        const std::vector<double>& times, const std::vector<int>& channels,
                        const std::vector<Vec3>& places_B, bool implicit) {
  RunOptions options;
  options.integrator = implicit ? "rosenbrock" : "dopri5";
  options.tolerance = 1e-7;
  options.sample_spacing = spacing_for(times, mechanism->duration());
  options.events = false;
  const RunResult run = make_rung("multibody", mechanism)->run(parameters, options);
  MatX readings(static_cast<Eigen::Index>(times.size()), static_cast<Eigen::Index>(channels.size()));
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto after = std::lower_bound(run.time.begin(), run.time.end(), times[i] - 1e-9);
    const std::size_t b = std::min<std::size_t>(after - run.time.begin(), run.time.size() - 1);
    const std::size_t a = std::abs(run.time[b] - times[i]) < 1e-9 || b == 0 ? b : b - 1;
    const double share = a == b ? 0.0 : (times[i] - run.time[a]) / (run.time[b] - run.time[a]);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Vec3 place_B = places_B.empty() ? Vec3(Vec3::Zero()) : places_B[c];
      const double from = channel_reading(channels[c], run.boresight.samples[a], mechanism->boresight_B(), place_B);
      const double to = channel_reading(channels[c], run.boresight.samples[b], mechanism->boresight_B(), place_B);
      readings(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = from + share * (to - from);
    }
  }
  return readings;
}

std::vector<double> sample_times(const SyntheticRig& rig, double duration) {
  std::vector<double> times;
  if (rig.samples > 0) {
    for (int i = 1; i <= rig.samples; ++i) times.push_back(duration * i / rig.samples);
    return times;
  }
  for (int i = 0; i * rig.spacing < duration * (1.0 + 1e-9); ++i) times.push_back(std::min(i * rig.spacing, duration));
  return times;
}

MeasuredData with_rig_errors(const SyntheticRig& rig, const std::vector<double>& times, const MatX& clean, int run) {
  MeasuredData data;
  data.channels = rig.channels;
  data.time = times;
  data.value = clean;
  for (std::size_t i = 0; i < times.size(); ++i) data.line.push_back(static_cast<int>(i) + 2);
  const CounterStream stream(rig.seed, StreamPurpose::sample);
  const boost::math::normal normal;
  double largest[2] = {0.0, 0.0};
  const auto kind = [&](Eigen::Index c) {
    return std::string(channel_names()[rig.channels[static_cast<std::size_t>(c)]].si_unit) == "rad";
  };
  for (Eigen::Index c = 0; c < clean.cols(); ++c)
    largest[kind(c)] =
        std::max(largest[kind(c)], std::sqrt(clean.col(c).squaredNorm() / static_cast<double>(clean.rows())));
  for (Eigen::Index c = 0; c < clean.cols(); ++c) {
    const double sigma = rig.deviation > 0.0 ? rig.deviation : rig.noise * largest[kind(c)];
    for (Eigen::Index i = 0; i < clean.rows(); ++i) {
      const auto draw = [&](std::uint64_t what) {
        return stream.uniform(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(c) + 64 * what,
                              static_cast<std::uint64_t>(run));
      };
      data.value(i, c) += sigma * boost::math::quantile(normal, draw(0)) + (rig.bias.size() > 0 ? rig.bias[c] : 0.0);
      if (draw(1) < rig.outliers) data.value(i, c) += (draw(2) < 0.5 ? -1.0 : 1.0) * (20.0 + 30.0 * draw(3)) * sigma;
    }
  }
  return data;
}

std::string csv_of(const MeasuredData& data) {
  std::string out = "t [s]";
  for (int c : data.channels) {
    const bool angle = std::string(channel_names()[c].si_unit) == "rad";
    out += std::string(", ") + channel_names()[c].name + (angle ? " [urad]" : " [um]");
  }
  char text[40];
  for (std::size_t i = 0; i < data.time.size(); ++i) {
    std::snprintf(text, sizeof text, "\n%.12g", data.time[i]);
    out += text;
    for (Eigen::Index c = 0; c < data.value.cols(); ++c) {
      std::snprintf(text, sizeof text, ", %.4f", 1e6 * data.value(static_cast<Eigen::Index>(i), c));
      out += std::isfinite(data.value(static_cast<Eigen::Index>(i), c)) ? text : ", ";
    }
  }
  return out + "\n";
}

namespace {

constexpr std::string_view kSynthetic = "# synthetic, made by boresight calibrate --make-data; checksum ";

std::string checksum_of(const std::string& csv) {
  ContentHash hash;
  hash.add(csv);
  return hash.hexadecimal();
}

}  // namespace

std::string synthetic_csv_of(const MeasuredData& data) {
  const std::string csv = csv_of(data);
  return csv + std::string(kSynthetic) + checksum_of(csv) + "\n";
}

bool is_synthetic(const std::string& csv) {
  const std::size_t at = csv.rfind(kSynthetic);
  if (at == std::string::npos || at == 0 || csv[at - 1] != '\n') return false;
  return csv.substr(at + kSynthetic.size()) == checksum_of(csv.substr(0, at)) + "\n";
}

}  // namespace boresight
