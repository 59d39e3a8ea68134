#include "boresight_analyses/budget/noise_keys.hpp"

#include "boresight_analyses/budget/measured_course.hpp"
#include "boresight_analyses/budget/power_density.hpp"

namespace boresight {
namespace {

constexpr PhysicalRange kFrequencyRange{kFrequency, "1e-12 Hz", "1e12 Hz"};

Key frequency_key(const char* name) { return keys::quantity(name, kFrequencyRange).above(0.0, "more than 0"); }

const KeyTable& first_order_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "budget.contributor.through.first_order",
      .says = "A lag of first order, 1 / (1 + s / w).",
      .keys = {frequency_key("bandwidth").says("w / 2 pi, where half the power is left.")}};
  return table_of_keys;
}

std::vector<Key> of_second_order() {
  return {frequency_key("frequency").says("The undamped natural frequency wn / 2 pi."),
          keys::number("damping").above(0.0, "more than 0").says("The damping ratio zeta.")};
}

const KeyTable& second_order_keys() {
  static const KeyTable table_of_keys{
      .name = "budget.contributor.through.second_order",
      .says = "A loop of second order, wn^2 / (s^2 + 2 zeta wn s + wn^2): what it makes of its sensor's error.",
      .keys = of_second_order()};
  return table_of_keys;
}

const KeyTable& sensitivity_keys() {
  static const KeyTable table_of_keys{
      .name = "budget.contributor.through.sensitivity",
      .says =
          "The sensitivity of a loop of second order, (s^2 + 2 zeta wn s) / (s^2 + 2 zeta wn s + wn^2): "
          "what it leaves of a disturbance of the pointing.",
      .keys = of_second_order()};
  return table_of_keys;
}

std::vector<Key> coefficients() {
  return {keys::numbers("numerator").with_some_not_zero().says("Coefficients by falling powers of s, in SI units."),
          keys::numbers("denominator")
              .with_some_not_zero()
              .says("The same below the line; no power of s above stands higher.")};
}

const KeyTable& ratio_keys() {
  static const KeyTable table_of_keys{.name = "budget.contributor.through.ratio",
                                      .says = "A ratio of polynomials in s, stable.",
                                      .keys = coefficients()};
  return table_of_keys;
}

const KeyTable& loop_keys() {
  static const KeyTable table_of_keys = [] {
    KeyTable t{.name = "budget.contributor.through.loop",
               .says = "A closed loop by its open loop L, a ratio of polynomials in s.",
               .keys = coefficients()};
    t.keys.push_back(
        keys::choice("seen_by", std::vector<KeyChoice>{{"disturbance", "1 / (1 + L): of the pointing itself"},
                                                       {"sensor", "L / (1 + L): of what the loop follows"}})
            .says("Where the contributor enters the loop."));
    return t;
  }();
  return table_of_keys;
}

}  // namespace

const KeyTable& spectrum_keys() {
  using namespace keys;
  static const PowerDensity p;
  static const std::string some = "white, flicker, both, or a table";
  static const KeyTable table_of_keys{
      .name = "budget.contributor.spectrum",
      .says =
          "A stationary Gaussian noise by its one-sided power spectral density: its integral over frequency from zero "
          "on is the variance.",
      .keys = {quantity_of("white", "the index squared per hertz, or that of `of`")
                   .above(0.0, "more than 0")
                   .sometimes(some)
                   .says("The same density at all frequencies of the band."),
               quantity_of("flicker", "the index squared per hertz, or that of `of`")
                   .above(0.0, "more than 0")
                   .sometimes(some)
                   .says("The density at 1 Hz of noise that falls with a power of the frequency."),
               number("exponent")
                   .inside_of(0.0, 8.0, "more than 0 and less than 8")
                   .otherwise(p.exponent)
                   .says("That power: 1 for flicker, 2 for a random walk."),
               frequency_key("lower")
                   .usually("zero; flicker needs one unless `through` takes its slow part away")
                   .says("The lower end of the band."),
               frequency_key("upper")
                   .usually("none; white noise needs one unless `through` takes its fast part away")
                   .says("The upper end of the band."),
               table("table", spectrum_table_keys)
                   .sometimes("in place of all others but `of`")
                   .says("Measured densities from a CSV file, straight between each other in the logarithms of both."),
               text("of")
                   .usually("the index'")
                   .says("The SI unit of what has this spectrum, such as \"N m\", where `through` turns it into the "
                         "index: its "
                         "coefficients are then in SI units too.")}};
  return table_of_keys;
}

const KeyTable& spectrum_table_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "budget.contributor.spectrum.table",
      .says = "A power spectral density, one-sided, from a CSV file with a header line.",
      .keys = {text("file").says("The CSV file, with commas between its columns, or with semicolons and decimal commas "
                                 "or points; a relative "
                                 "name is taken from the study file's folder."),
               text("frequency").says("The name of its column of frequencies [Hz], above zero and rising."),
               text("density").says(
                   "The name of its column of densities, above zero; beyond the first and last there are none."),
               text("unit").says("Unit of the densities, such as \"arcsec^2/Hz\".")}};
  return table_of_keys;
}

const KeyTable& measured_keys() {
  using namespace keys;
  using Ends = MeasuredCourse::Ends;
  using Begin = MeasuredCourse::Begin;
  static const MeasuredCourse::Record r;
  static const KeyTable table_of_keys{
      .name = "budget.contributor.measured",
      .says =
          "An error as it was measured over time, or a disturbance that `through` makes an error of: a CSV file with a "
          "header line, straight "
          "between its rows.",
      .keys = {
          text("file").says("The CSV file, with commas between its columns, or with semicolons and decimal commas or "
                            "points; a relative "
                            "name is taken from the study file's folder."),
          text("time").says("The name of its column of times [s], which rise."),
          texts("columns").says("The names of its columns of values, one for each of `axes`."),
          text("unit").says("Unit of the values, such as \"arcsec\"."),
          text("of")
              .usually("the index'")
              .says("The SI unit of what was measured, such as \"N m\", where `through` turns it into the index."),
          choice("ends", std::vector<KeyChoice>{{to_string(Ends::refused), "the record holds the whole motion"},
                                                {to_string(Ends::held), "its first and last value"},
                                                {to_string(Ends::zero), "nothing"},
                                                {to_string(Ends::repeated),
                                                 "the record once more, its last row where its first one is"}})
              .otherwise(to_string(r.ends))
              .says("What is beyond the record's ends."),
          choice("begin", std::vector<KeyChoice>{{to_string(Begin::with_the_motion),
                                                  "its times are those of the motion, the same in all members"},
                                                 {to_string(Begin::anywhere), "each member at a place of its own"}})
              .otherwise(to_string(r.begin))
              .says("Where in the record a history begins.")}};
  return table_of_keys;
}

const KeyTable& through_keys() {
  using namespace keys;
  static const std::string one = "exactly one in each table";
  static const KeyTable table_of_keys{
      .name = "budget.contributor.through",
      .says =
          "What a contributor goes through before it is an error of the pointing: transfer functions one after the "
          "other, each stable.",
      .keys = {table("first_order", first_order_keys).sometimes(one).says("A lag of first order."),
               table("second_order", second_order_keys)
                   .sometimes(one)
                   .says("A loop of second order, of its sensor's error."),
               table("sensitivity", sensitivity_keys).sometimes(one).says("A loop of second order, of a disturbance."),
               table("ratio", ratio_keys).sometimes(one).says("A ratio of polynomials."),
               table("loop", loop_keys).sometimes(one).says("A closed loop by its open loop.")},
      .one_of = {"first_order", "second_order", "sensitivity", "ratio", "loop"},
      .one_of_what = "transfer function"};
  return table_of_keys;
}

}  // namespace boresight
