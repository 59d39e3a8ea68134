// Numbers of any magnitude, from denormal to the largest double, in a mechanism that is otherwise whole: what is read, checked and
// computed of it is refused in words, or finite. Nothing hangs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "fuzz_seed.hpp"
#include "mutation.hpp"

namespace boresight {
namespace {

constexpr double kLongest = 5.0;           // [s] of CPU for one input before it counts as hanging
constexpr double kManyTimesLonger = 10.0;  // [s] of motion, where the files have 1 s: long work by what is asked for
std::clock_t begun;

double seconds_since_begin() { return static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC; }

// The numbers of a text: in quotation marks before a unit, or bare after "= ", "[" or ", ".
std::vector<std::pair<std::size_t, std::size_t>> numbers_of(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 1; i < text.size();) {
    const char before = text[i - 1];
    const bool starts = (before == '"' || before == ' ' || before == '[') &&
                        (std::isdigit(static_cast<unsigned char>(text[i])) || text[i] == '-');
    std::size_t end = i;
    while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) ||
                                 std::string("+-.eE").find(text[end]) != std::string::npos))
      ++end;
    double value = 0.0;
    if (starts && end > i && parse_number(text.substr(i, end - i), value)) found.emplace_back(i, end - i);
    i = std::max(end, i + 1);
  }
  return found;
}

// One number, or two, of another magnitude: anywhere among the doubles, or within a million of what it was.
std::string with_other_magnitudes(std::string text, Mutator& mutator) {
  const std::size_t count = 1 + mutator.below(2);
  for (std::size_t n = 0; n < count; ++n) {
    const auto places = numbers_of(text);
    const auto [begin, length] = places[mutator.below(places.size())];
    double value = 0.0;
    parse_number(text.substr(begin, length), value);
    char number[40];
    if (mutator.below(2) == 0)
      std::snprintf(number, sizeof number, "%de%d", 1 + static_cast<int>(mutator.below(9)),
                    static_cast<int>(mutator.below(632)) - 323);
    else
      std::snprintf(number, sizeof number, "%.6g",
                    (value == 0.0 ? 1.0 : value) * std::pow(10.0, static_cast<double>(mutator.below(13)) - 6.0));
    text.replace(begin, length, number);
  }
  return text;
}

std::string fault_of(const PointingIndices& index) {
  for (const Statistics* s : {&index.position_error, &index.orientation_error, &index.boresight_error})
    for (const double value : {s->max, s->rms, s->mean})
      if (!std::isfinite(value)) return "an index";
  return "";
}

// Reads, checks and runs; "" where everything was finite, "refused" where a refusal in words came, "long" and "a long motion" where
// the time was up.
std::string computed(const std::string& text) {
  double duration = 0.0;
  try {
    const auto mechanism = std::make_shared<const Mechanism>(read_mechanism_text(text, "fuzz.toml"));
    duration = mechanism->duration();
    const KinematicReport k = analyse_kinematics(*mechanism, 11);
    for (const ConditioningSample& s : k.along)
      if (!std::isfinite(s.smallest_singular_value) || !std::isfinite(s.orientation) || !std::isfinite(s.position))
        return "conditioning";
    if (!k.feasible) return "refused";
    for (const ContactFrequency& c : analyse_contacts(*mechanism, mechanism->parameters()))
      for (const double value : {c.hertz_stiffness, c.axial_stiffness, c.effective_mass, c.typical_load, c.largest_load,
                                 c.typical_penetration, c.angular_frequency, c.largest_stable_step})
        if (!std::isfinite(value)) return "contact report of " + c.joint;
    for (const char* name : {"quasistatic", "perturbation"}) {
      RunOptions options;
      options.sample_spacing = 0.0;
      options.progress = [](const RunProgress&) { return seconds_since_begin() < 1.0; };
      const RunResult result = make_rung(name, mechanism)->run(mechanism->parameters(), options);
      if (const std::string fault = fault_of(result.index); !fault.empty()) return fault + " of " + name;
    }
    return "";
  } catch (const InputError&) {
    return "refused";
  } catch (const ComputationError& refusal) {
    return std::string(refusal.what()).empty() ? "a refusal without words" : "refused";
  } catch (const Interrupted&) {
    return duration > kManyTimesLonger ? "a long motion" : "long";  // it was heard: work for long, and no hang
  }
}

void run_fuzz(int count, std::uint64_t seed) {
  std::vector<std::string> texts;
  for (const char* name : {"/crank-slider/crank-slider.toml", "/four-bar/four-bar.toml"}) {
    std::ifstream in(std::string(BORESIGHT_EXAMPLES) + name, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  watch_work([](const char*, double) { return seconds_since_begin() < kLongest; });
  int refused = 0, finite = 0, long_work = 0, long_motions = 0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    Mutator mutator(seed + static_cast<std::uint64_t>(i));
    const std::string text = with_other_magnitudes(texts[mutator.below(texts.size())], mutator);
    begun = std::clock();
    const std::string found = computed(text);
    ++(found.empty() ? finite : found == "long" ? long_work : found == "refused" ? refused : long_motions);
    EXPECT_TRUE(found.empty() || found == "refused" || found == "long" || found == "a long motion")
        << "BORESIGHT_FUZZ_SEED=" << seed + static_cast<std::uint64_t>(i) << ": " << found << "\n"
        << text;
    EXPECT_LT(seconds_since_begin(), 2.0 * kLongest) << "input " << i << "\n" << text;
  }
  watch_work(nullptr);
  // Of 1950 inputs six are: most of them drawn so that a freedom is undriven and flies apart.
  EXPECT_LE(long_work, 1 + count / 40);
  EXPECT_GT(refused, count / 10);
  EXPECT_GT(finite, count / 20);
}

TEST(MagnitudeFuzz, IsRefusedInWordsOrFinite) { run_fuzz(40, fuzz_seed()); }

TEST(NightMagnitudeFuzz, IsRefusedInWordsOrFinite) { run_fuzz(130 * fuzz_times(), fuzz_seed() + 100'000); }

}  // namespace
}  // namespace boresight
