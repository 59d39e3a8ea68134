#include "boresight_analyses/calibration/calibration_keys.hpp"

#include "boresight/contact/normal_law.hpp"
#include "boresight/io/names_of.hpp"
#include "boresight_analyses/calibration/calibration_plan.hpp"

namespace boresight {
namespace {

std::string in_percent(double share) {
  std::string text = std::to_string(100.0 * share);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " %";
}

Key settings_key(const char* sentence) {
  return keys::texts("set").sometimes("left out, the mechanism file's own values hold").says(sentence);
}

Key of_parameter(const char* name, const char* otherwise, const char* sentence) {
  return keys::value(name, "the parameter").usually(otherwise).says(sentence);
}

}  // namespace

const KeyTable& calibrate_keys() {
  using namespace keys;
  static const CalibrationPlan p;
  static const KeyTable table_of_keys{
      .name = "calibrate",
      .says =
          "Contact parameters and standing errors from measured pointing data, by least squares over windows of the "
          "runs (Ceres).",
      .keys = {
          quantity("window", kDuration)
              .or_word("whole")
              .above(0.0, "more than 0, or \"whole\"")
              .says(
                  "Length of the windows that data are cut into, each with a start state of its own that is estimated "
                  "too; "
                  "\"whole\": a run is one window. Motions that cannot be predicted over a whole run need short ones."),
          choice("start", std::vector<KeyChoice>{{"rest", "as the mechanism file starts"}, {"free", "anywhere"}})
              .otherwise("rest")
              .says("Where the first window of a run begins."),
          choice("loss", std::vector<KeyChoice>{{"none", "least squares"},
                                                {"huber", "linear beyond loss_scale"},
                                                {"cauchy", "logarithmic beyond loss_scale, for gross outliers"}})
              .otherwise("huber")
              .says("How much single readings weigh that are far off."),
          number("loss_scale")
              .above(0.0, "more than 0 standard deviations")
              .usually("2, of cauchy 2.4")
              .says("From how many standard deviations of the noise on a reading counts less."),
          integer("starts").counting(1.0, 1000.0).otherwise(p.starts).says("Fits from other starts, side by side."),
          integer("seed")
              .counting(0.0, 4611686018427387904.0)
              .otherwise(static_cast<double>(p.seed))
              .says("Seed of the random numbers: the same seed gives the same results, bit for bit."),
          number("confidence")
              .inside_of(0.5, 1.0, "more than 0.5 and less than 1")
              .otherwise(p.confidence)
              .says("Confidence of all intervals."),
          quantity("time_offset", kDuration)
              .above(0.0, "more than 0: the largest that is possible")
              .sometimes("left out, the rig's clock is taken as right")
              .says("The largest offset of the rig's clock; an offset within it is fitted too."),
          quantity("sensor_lag", kDuration)
              .above(0.0, "more than 0: the standard deviation of what it may be")
              .sometimes("left out, none is fitted")
              .says(
                  "What the sensor's first-order lag may well be (its prior's standard deviation); one is fitted too."),
          boolean("mounting_bias", p.mounting_bias).says("Whether a constant offset of every channel is fitted too."),
          boolean("drift", p.drift)
              .says("Whether a steady drift of every channel's offset is fitted too, from each run's start."),
          boolean("offsets_per_run", p.offsets_per_run)
              .says("Whether every run has offsets and drifts of its own, as where the rig was set up anew in "
                    "between."),
          table("discrepancy", calibrate_discrepancy_keys)
              .sometimes("left out, that table's defaults hold")
              .says("How well what is not fitted is known; intervals are widened by what it may do to the answer."),
          quantity("hold_out", kRatio)
              .bounded({.least = 0.0, .most = 0.5, .above = true, .expected = "more than 0 % and at most 50 %"})
              .sometimes("left out, all windows are fitted")
              .says("Share of the windows that is kept out of the fit, to score it."),
          integer("corrections")
              .counting(0.0, 10.0)
              .otherwise(p.corrections)
              .says("How often at most what the fit's rung leaves out is taken from multibody."),
          boolean("profile", p.profile)
              .says("Whether intervals come from the profile of the loss as well, which takes other fits."),
          table("posterior", calibrate_posterior_keys)
              .sometimes("left out, none are drawn: posterior.toml is the fit's estimates and their errors")
              .says("Draws of what the parameters may be given the data, several modes and bent shapes included; "
                    "posterior.toml then has them."),
          choices("laws", names_of(normal_laws()), "contact laws")
              .sometimes("left out, the mechanism's own law only")
              .says("Contact laws that are fitted too, and compared by the same data."),
          table("noise", calibrate_noise_keys)
              .sometimes("left out, all noise is estimated")
              .says("Known noise of single channels."),
          tables("parameter", calibrate_parameter_keys)
              .at_least_of(1, "at least one [[calibrate.parameter]]")
              .says("What is fitted, one table each; at least one."),
          tables("run", calibrate_run_keys)
              .at_least_of(1, "at least one [[calibrate.run]]")
              .says("The runs that were measured, one table each; at least one."),
          tables("candidate", calibrate_candidate_keys)
              .sometimes("left out, none is judged")
              .says(
                  "Further tests that could be made; the report says which of them would narrow the intervals most.")}};
  return table_of_keys;
}

const KeyTable& calibrate_discrepancy_keys() {
  using namespace keys;
  static const Discrepancy d;
  static const KeyTable table_of_keys{
      .name = "calibrate.discrepancy",
      .says = "How well a calibration knows what it does not fit: one standard deviation each, 0 where it is exact.",
      .keys = {
          quantity("axial", kRatio)
              .bounded({.least = 0.0, .most = 1.0, .expected = "0 to 100 %"})
              .usually(in_percent(d.axial))
              .says("Of the axial gaps of clearances that are fitted."),
          quantity("masses", kRatio)
              .bounded({.least = 0.0, .most = 1.0, .expected = "0 to 100 %"})
              .usually(in_percent(d.masses))
              .says("Of every body's mass, each by itself. A mass that the data know better than half of this is "
                    "fitted too, "
                    "with this as its prior."),
          quantity("lag", kDuration)
              .bounded({.least = 0.0, .most = 1.0, .expected = "0 to 1 s"})
              .otherwise(d.lag)
              .says("Of the sensor's delay: an offset of the clock is fitted with this prior, unless time_offset or "
                    "sensor_lag is given."),
          boolean("law", d.law)
              .says("Whether the damping law may be another one of its family: then a restitution is known no better "
                    "than these laws agree on what they mean by it.")}};
  return table_of_keys;
}

const KeyTable& calibrate_posterior_keys() {
  using namespace keys;
  static const DrawOptions d;
  static const KeyTable table_of_keys{
      .name = "calibrate.posterior",
      .says =
          "Draws of the posterior by tempered Hamiltonian Monte Carlo. Runs start from rest; offsets, drifts, noise, "
          "and what the model may be wrong by are integrated out.",
      .keys = {
          integer("draws").counting(32.0, 1e7).otherwise(d.draws).says("How many, of all chains together."),
          integer("chains").counting(2.0, 64.0).otherwise(d.chains).says(
              "Chains that run beside one another, each from places of its own; their agreement is judged by R-hat."),
          integer("temperatures")
              .counting(2.0, 64.0)
              .otherwise(d.temperatures)
              .says("Temperatures of each chain, from a wide normal distribution to the posterior; more of them where "
                    "modes lie far apart."),
          integer("warm_up").counting(50.0, 1e6).otherwise(d.warm_up).says(
              "Iterations that find steps, shapes and temperatures before any draw counts."),
          integer("thin").counting(1.0, 1000.0).otherwise(d.thin).says("Iterations for one draw."),
          number("reach")
              .bounded({.least = 1.0, .most = 100.0, .expected = "1 to 100"})
              .otherwise(d.reach)
              .says("How much wider than the fit's errors the distribution is that chains start from: no mode beyond "
                    "it is found.")}};
  return table_of_keys;
}

const KeyTable& calibrate_noise_keys() {
  using namespace keys;
  static const KeyTable table_of_keys = [] {
    KeyTable noise{
        .name = "calibrate.noise", .says = "Standard deviation of the noise of single channels.", .keys = {}};
    for (const ChannelName& channel : channel_names()) {
      SiUnit unit = unit_called(channel.si_unit);
      if (unit.what == std::string("a value")) unit = {"a value", channel.si_unit, channel.si_unit};
      noise.keys.push_back(quantity(channel.name, unit)
                               .above(0.0, "more than 0")
                               .sometimes("left out, it is estimated")
                               .says(std::string("Noise of the channel ") + channel.name + ", " + channel.title + "."));
    }
    return noise;
  }();
  return table_of_keys;
}

const KeyTable& calibrate_parameter_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "calibrate.parameter",
      .says = "A parameter that is fitted.",
      .keys = {
          text("path").says(
              "The path of a parameter of a clearance, such as clearance.F1.contact.restitution, or of a "
              "standing error, "
              "such as error.rod1.length; of a mass (body.NAME.mass, payload.mass), with a prior. With errors alone no "
              "play is followed."),
          of_parameter("start", "the mechanism file's value", "Where the fit starts; of a clearance more than 0."),
          of_parameter("lower", "a tenth of start; of an error a thousand times what it may well be below it",
                       "Lower bound; of a clearance more than 0."),
          of_parameter("upper", "ten times start, where the parameter may be as large; of an error likewise",
                       "Upper bound."),
          value("prior", "the parameter")
              .above(0.0, "more than 0")
              .usually("none: the data alone decide")
              .says("What was known of it before: the standard deviation of its distance from start (a tolerance), "
                    "or a share of start, such as \"20 %\". The fit weighs it like a reading.")}};
  return table_of_keys;
}

const KeyTable& calibrate_run_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "calibrate.run",
      .says = "A run that was measured.",
      .keys = {
          text("data")
              .filled("the path of a file")
              .sometimes("left out where sensors have files of their own")
              .says("The CSV file of its readings, with commas between its columns, or with semicolons or tabs and "
                    "decimal commas or points. A relative name is taken from the study file's folder."),
          tables("sensor", calibrate_sensor_keys)
              .sometimes("left out, data is the one file of the run")
              .says("Sensors with files of their own, as their software writes them: columns, units and times are "
                    "mapped."),
          text("name")
              .filled("a name, or no key at all")
              .usually("the name of the data file")
              .says("What reports call the run."),
          settings_key("The mechanism's settings in this run, as --set takes them: [\"motion.drives.A=2*pi*t\"].")}};
  return table_of_keys;
}

const KeyTable& calibrate_candidate_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "calibrate.candidate",
      .says = "A test that could be made next.",
      .keys = {text("name").filled("a name").says("What reports call the test."),
               settings_key("The mechanism's settings in this test, as --set takes them.")}};
  return table_of_keys;
}

}  // namespace boresight
