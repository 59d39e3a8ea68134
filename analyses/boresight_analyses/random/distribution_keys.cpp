#include "boresight_analyses/random/random_keys.hpp"

namespace boresight {
namespace {

Key value_of(const char* name, const char* sentence) { return keys::value(name, "the parameter").says(sentence); }
Key positive_value(const char* name, const char* sentence) {
  return keys::value(name, "the parameter").above(0.0, "more than 0").says(sentence);
}
Key positive_number(const char* name, const char* sentence) {
  return keys::number(name).above(0.0, "more than 0").says(sentence);
}

}  // namespace

const KeyTable& normal_keys() {
  static const KeyTable table_of_keys{.name = "distribution.normal",
                                      .says = "Normal distribution.",
                                      .keys = {value_of("mean", "Mean."), positive_value("sd", "Standard deviation.")}};
  return table_of_keys;
}

const KeyTable& uniform_keys() {
  static const KeyTable table_of_keys{.name = "distribution.uniform",
                                      .says = "Uniform distribution.",
                                      .keys = {value_of("min", "Least value."), value_of("max", "Largest value.")}};
  return table_of_keys;
}

const KeyTable& lognormal_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "distribution.lognormal",
      .says = "Lognormal distribution: the logarithm is normal.",
      .keys = {positive_value("median", "Median."),
               number("factor")
                   .above(1.0, "more than 1: 68 % lie between median / factor and median * factor")
                   .says("Geometric standard deviation: 68 % lie between median / factor and median * factor.")}};
  return table_of_keys;
}

const KeyTable& triangular_keys() {
  static const KeyTable table_of_keys{
      .name = "distribution.triangular",
      .says = "Triangular distribution.",
      .keys = {value_of("min", "Least value."), value_of("mode", "Most probable value, between min and max."),
               value_of("max", "Largest value.")}};
  return table_of_keys;
}

const KeyTable& beta_keys() {
  static const KeyTable table_of_keys{
      .name = "distribution.beta",
      .says =
          "Beta distribution: density proportional to x^(alpha - 1) (1 - x)^(beta - 1), x from 0 at min to 1 at max.",
      .keys = {positive_number("alpha", "Exponent at min; 1 is a finite density there."),
               positive_number("beta", "Exponent at max; 1 is a finite density there."),
               value_of("min", "Least value."), value_of("max", "Largest value.")}};
  return table_of_keys;
}

const KeyTable& weibull_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "distribution.weibull",
      .says = "Weibull distribution: exp(-((x - location) / scale)^shape) is the probability of more than x.",
      .keys = {positive_number("shape", "Shape; 1 is an exponential distribution."),
               positive_value("scale", "Scale: 63 % lie within it above location."),
               value("location", "the parameter").otherwise(0.0).says("Least value.")}};
  return table_of_keys;
}

const KeyTable& discrete_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "distribution.discrete",
      .says = "Some values, each with a probability.",
      .keys = {values("values", "the parameter").at_least_of(1, "at least one value").says("The values; at least one."),
               numbers("probabilities")
                   .at_least(0.0, "none below 0")
                   .usually("the same for all")
                   .says("Their probabilities, as many as values; they add up to 1.")}};
  return table_of_keys;
}

const KeyTable& empirical_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "distribution.empirical",
      .says = "The values of a CSV column, each as probable as any other.",
      .keys = {text("file").says("The CSV file, with commas between its columns, or with semicolons and decimal commas "
                                 "or points; a relative "
                                 "name is taken from the study file's folder."),
               text("column").says("The column's name, as in the file's first line."),
               text("unit")
                   .sometimes("needed unless the parameter is a pure number")
                   .says("Unit of the column, such as \"mm\".")}};
  return table_of_keys;
}

namespace {

// across: "diameter" or "width".
Key across_zone(const char* across, const char* sentence) {
  return keys::value(across, "the parameter; with a length, m").above(0.0, "more than 0").says(sentence);
}
Key along_zone(const char* sentence) {
  return keys::quantity("length", kSizeRange)
      .above(0.0, "more than 0")
      .sometimes("for rotations whose zone is given as a length")
      .says(sentence);
}

}  // namespace

const KeyTable& planes_keys() {
  static const KeyTable table_of_keys{
      .name = "distribution.planes",
      .says = "A tolerance zone between two parallel planes (ISO 1101), around the mechanism file's value.",
      .keys = {across_zone("width", "Their distance: the parameter is off by at most half of it."),
               along_zone("Length of the feature between the planes: it leans by at most width / length to either "
                          "side.")}};
  return table_of_keys;
}

const KeyTable& cylinder_keys() {
  static const KeyTable table_of_keys{
      .name = "distribution.cylinder",
      .says =
          "A cylindrical tolerance zone (ISO 1101), around the mechanism file's values of two parameters: a "
          "position in two directions across the cylinder, or with a length the tilt about them.",
      .keys = {across_zone("diameter", "Its diameter: the point of the two parameters lies in a disc of it."),
               along_zone("Length of the axis in the cylinder: it leans by at most diameter / length to any side.")}};
  return table_of_keys;
}

}  // namespace boresight
