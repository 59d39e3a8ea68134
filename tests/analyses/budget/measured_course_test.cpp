// Measured courses: what lies between rows and beyond ends, and what a transfer function makes of them.
#include "boresight_analyses/budget/measured_course.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight_analyses/budget/contributor.hpp"
#include "boresight_analyses/budget/course_filter.hpp"

namespace boresight {
namespace measured_course_test {

using Ends = MeasuredCourse::Ends;
using Begin = MeasuredCourse::Begin;

std::vector<double> values_of(const std::vector<Vec3>& history, int axis = 0) {
  std::vector<double> out;
  for (const Vec3& e : history) out.push_back(e[axis]);
  return out;
}

// Of x' = -w x + w u: exact for what is straight between instants (integrated by hand).
TEST(CourseFilter, OfFirstOrderFollowsARampOneTimeConstantBehind) {
  const double bandwidth = 3.0, w = 2.0 * M_PI * bandwidth, step = 0.01;
  std::vector<double> ramp;
  for (int k = 0; k < 100; ++k) ramp.push_back(2.0 * step * k);
  const std::vector<double> seen = CourseFilter(TransferFunction::first_order(bandwidth), step).through(ramp);
  for (int k = 0; k < 100; ++k) {
    const double t = step * k;
    EXPECT_NEAR(seen[std::size_t(k)], 2.0 * (t - (1.0 - std::exp(-w * t)) / w), 1e-12);
  }
  EXPECT_NEAR(TransferFunction::first_order(bandwidth).slope(), -1.0 / w, 1e-15);
}

// A step of the loop of second order, drawn as a ramp over one step from the value before: the integral of its step response over that step.
TEST(CourseFilter, OfSecondOrderRespondsToAStepAsItsClosedFormSays) {
  const double fn = 5.0, zeta = 0.3, wn = 2.0 * M_PI * fn, wd = wn * std::sqrt(1.0 - zeta * zeta), step = 1e-4;
  std::vector<double> course(4000, 1.0);
  course[0] = 0.0;
  const std::vector<double> seen = CourseFilter(TransferFunction::second_order(fn, zeta), step).through(course);
  for (std::size_t k = 10; k < course.size(); k += 100) {
    const double t = step * (double(k) - 0.5);  // the middle of the ramp
    const double expected = 1.0 - std::exp(-zeta * wn * t) * (std::cos(wd * t) + zeta * wn / wd * std::sin(wd * t));
    EXPECT_NEAR(seen[k], expected, 1e-6) << t;
  }
}

TEST(CourseFilter, LeavesOfASinusoidWhatTheFunctionSaysOnceItHasSettled) {
  const TransferFunction loop = TransferFunction::sensitivity(2.0, 0.5) * TransferFunction::first_order(30.0) *
                                TransferFunction({1.0}, {800.0, 0.5, 2.0});
  const double f = 4.0, step = 1e-3, settled = CourseFilter::settling_time(loop);
  const auto first = static_cast<std::size_t>(std::ceil(settled / step));
  std::vector<double> course;
  for (std::size_t k = 0; k < first + 1000; ++k) course.push_back(std::cos(2.0 * M_PI * f * step * double(k)));
  const std::vector<double> seen = CourseFilter(loop, step).through(course);
  const std::complex<double> h = loop.at(f);
  for (std::size_t k = first; k < course.size(); k += 37) {
    const double expected = std::real(h * std::polar(1.0, 2.0 * M_PI * f * step * double(k)));
    EXPECT_NEAR(seen[k], expected,
                1e-4 * std::abs(h));  // straight lines between samples of a sinusoid: (w step)^2 / 12
  }
}

TEST(CourseFilter, LeavesAConstantAsItStands) {
  const CourseFilter filter(TransferFunction({3.0, 1.0}, {6.0, 11.0, 6.0, 1.0}), 0.02);
  for (const double e : filter.through(std::vector<double>(50, 4.0))) EXPECT_NEAR(e, 2.0, 1e-12);
  EXPECT_EQ(CourseFilter(TransferFunction({3.0}, {2.0}), 0.02).through({2.0, 4.0}), (std::vector<double>{3.0, 6.0}));
}

MeasuredCourse::Record record(Ends ends, Begin begin = Begin::with_the_motion) {
  MeasuredCourse::Record r{.time = {0.0, 1.0, 3.0}, .value = {}, .ends = ends, .begin = begin};
  r.value[1] = {0.0, 2.0, 1.0};
  return r;
}

TEST(MeasuredCourse, IsStraightBetweenItsRowsAndBeyondItsEndsWhatTheyAreSaidToBe) {
  const auto from = [](Ends ends, double start, std::size_t samples) {
    return values_of(MeasuredCourse(record(ends), {}, 0.5, samples, start).history(0.5), 1);
  };
  EXPECT_EQ(from(Ends::refused, 0.0, 7), (std::vector<double>{0.0, 1.0, 2.0, 1.75, 1.5, 1.25, 1.0}));
  EXPECT_EQ(from(Ends::held, 2.5, 4), (std::vector<double>{1.25, 1.0, 1.0, 1.0}));
  EXPECT_EQ(from(Ends::zero, 2.5, 4), (std::vector<double>{1.25, 1.0, 0.0, 0.0}));
  EXPECT_EQ(from(Ends::repeated, 2.0, 5), (std::vector<double>{1.5, 1.25, 0.0, 1.0, 2.0}));
  EXPECT_THROW(from(Ends::refused, 0.5, 7), std::invalid_argument);
  EXPECT_NEAR(MeasuredCourse(record(Ends::repeated), {}, 0.5, 5, 0.0).jump(), 0.5, 1e-12);
}

// A sinusoid of three whole turns, begun anywhere: the phase is uniform, and its moments are those of the class periodic.
TEST(MeasuredCourse, OfASinusoidBegunAnywhereHasTheMomentsOfAPeriodicOne) {
  MeasuredCourse::Record r{.time = {}, .value = {}, .ends = Ends::repeated, .begin = Begin::anywhere};
  const double period = 0.2, amplitude = 3.0;
  for (int k = 0; k <= 1200; ++k) {
    r.time.push_back(0.0005 * k);
    r.value[0].push_back(amplitude * std::sin(2.0 * M_PI * r.time.back() / period));
  }
  constexpr std::size_t kSamples = 500;
  constexpr double kSpacing = 0.002;
  const Windows windows{.window = 0.05, .separation = 0.3};
  const DistributionPtr spread = make_uniform(0.5, 1.5), one = make_discrete({amplitude}, {1.0});
  for (const bool filtered : {false, true}) {
    std::optional<TransferFunction> loop;
    if (filtered) loop = TransferFunction::second_order(4.0, 0.6);
    Contributor measured{.name = "m", .kind = ContributorClass::measured, .parameter = {spread}};
    measured.measured = std::make_shared<const MeasuredCourse>(r, loop, kSpacing, kSamples, 0.0);
    Contributor periodic{.name = "p",
                         .kind = ContributorClass::periodic,
                         .parameter = {make_uniform(0.5 * amplitude, 1.5 * amplitude)},
                         .period = period,
                         .through = loop};
    for (const ErrorIndex index : {ErrorIndex::ape, ErrorIndex::mpe, ErrorIndex::rpe, ErrorIndex::pde})
      for (const Interpretation i : {Interpretation::mixed, Interpretation::temporal}) {
        const Moments expected = moments(periodic, 0, index, i, windows, 1.0),
                      found = moments(measured, 0, index, i, windows, 1.0);
        // The worst stretch may hold a broken turn, whose mean is not zero.
        if (i == Interpretation::mixed) {
          EXPECT_NEAR(found.mean, 0.0, 0.02 * expected.sd) << to_string(index);
        }
        EXPECT_NEAR(found.sd, expected.sd, 0.02 * expected.sd) << to_string(index) << ' ' << to_string(i) << filtered;
      }
    // And so do the courses of members, of both.
    for (const Contributor& c : {measured, periodic}) {
      double squares = 0.0;
      constexpr int kMembers = 2000;
      for (std::uint64_t member = 0; member < kMembers; ++member)
        for (const Vec3& e : course(c, 1, member, 0, kSpacing, kSamples, windows))
          squares += e.x() * e.x() / (kMembers * double(kSamples));
      const double expected = moments(periodic, 0, ErrorIndex::ape, Interpretation::mixed, windows, 1.0).sd;
      EXPECT_NEAR(std::sqrt(squares), expected, 0.02 * expected);
    }
  }
}

TEST(MeasuredCourse, WithTheMotionIsTheSameInEveryMemberButForItsFactor) {
  Contributor c{.name = "m", .kind = ContributorClass::measured, .parameter = {nullptr, make_uniform(0.5, 1.5)}};
  c.measured = std::make_shared<const MeasuredCourse>(record(Ends::refused), std::nullopt, 0.5, 7, 0.0);
  const std::vector<Vec3> first = course(c, 1, 0, 0, 0.5, 7, {}), second = course(c, 1, 1, 0, 0.5, 7, {});
  EXPECT_NE(first[2].y(), second[2].y());
  for (std::size_t k = 1; k < 7; ++k) EXPECT_NEAR(first[k].y() / second[k].y(), first[2].y() / second[2].y(), 1e-12);
  EXPECT_EQ(first[2].x(), 0.0);
  EXPECT_THROW(course(c, 1, 0, 0, 0.5, 8, {}), std::invalid_argument);
}

// A ramp that begins long before the motion does: what a first-order loop sees of it has settled one time constant behind.
TEST(MeasuredCourse, ThroughALoopHasSettledWhereItsRecordBeginsBeforeTheMotion) {
  const double slope = 3.0, bandwidth = 2.0, lag = 1.0 / (2.0 * M_PI * bandwidth), start = 5.0, spacing = 0.02;
  MeasuredCourse::Record ramp{.time = {0.0, 10.0}, .value = {std::vector{1.0, 1.0 + 10.0 * slope}, {}, {}}};
  const MeasuredCourse course(ramp, TransferFunction::first_order(bandwidth), spacing, 100, start);
  const std::vector<double> seen = values_of(course.history(0.5));
  for (std::size_t k = 0; k < seen.size(); k += 9)
    EXPECT_NEAR(seen[k], 1.0 + slope * (start + spacing * double(k) - lag), 1e-5) << k;
}

// A motion of 2 s in a record of 10 s that begins anywhere in it: from its beginning to where the motion ends as the record does.
TEST(MeasuredCourse, ThatBeginsAnywhereEndsWithinItsRecord) {
  MeasuredCourse::Record ramp{.time = {3.0, 13.0}, .value = {std::vector{0.0, 10.0}, {}, {}}, .begin = Begin::anywhere};
  const MeasuredCourse course(ramp, std::nullopt, 0.5, 5, 0.0);
  EXPECT_NEAR(values_of(course.history(0.0)).front(), 0.0, 1e-12);
  EXPECT_NEAR(values_of(course.history(0.25)).front(), 2.0, 1e-12);
  EXPECT_NEAR(values_of(course.history(1.0)).front(), 8.0, 1e-12);
  EXPECT_NEAR(values_of(course.history(1.0)).back(), 10.0, 1e-12);
}

// Half the gain and a lag of 0.2 s, once settled.
TEST(Contributor, OfAClassIsSeenThroughATransferFunctionAsItSettles) {
  const TransferFunction lag({1.0}, {2.0, 0.4});
  const Windows windows{.window = 0.1, .separation = 0.3};
  const auto seen = [&](ContributorClass kind) {
    return Contributor{.name = "c", .kind = kind, .parameter = {make_discrete({3.0}, {1.0})}, .through = lag};
  };
  EXPECT_NEAR(course(seen(ContributorClass::bias), 1, 0, 0, 0.01, 100, windows)[50].x(), 1.5, 1e-12);
  EXPECT_NEAR(moments(seen(ContributorClass::bias), 0, ErrorIndex::ape, Interpretation::mixed, windows, 1.0).mean, 1.5,
              1e-12);
  EXPECT_NEAR(course(seen(ContributorClass::drift), 1, 0, 0, 0.01, 100, windows)[50].x(), 1.5 * (0.505 - 0.2), 1e-12);
  EXPECT_NEAR(moments(seen(ContributorClass::drift), 0, ErrorIndex::ape, Interpretation::mixed, windows, 1.0).mean,
              1.5 * (0.5 - 0.2), 1e-12);
  EXPECT_NEAR(moments(seen(ContributorClass::drift), 0, ErrorIndex::pde, Interpretation::mixed, windows, 1.0).mean,
              1.5 * 0.3, 1e-12);
}

}  // namespace measured_course_test
}  // namespace boresight
