// Tolerance zones as [[random]] tables say them.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/parameter_groups.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/random/read_zone.hpp"
#include "boresight_analyses/random/sampling_design.hpp"

namespace boresight {
namespace zone_inputs_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kDefaultMechanism = BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml";
const std::string kBoth = "[\"gravity.x\", \"gravity.y\"]";
const std::string kFriction =
    "[[random]]\nparameter = \"clearance.F1.friction.coefficient\"\ndistribution = { uniform = { min = 0.01, max = "
    "0.05 } "
    "}\n";

const KeyTable& table_with_groups() {
  static const KeyTable keys{.name = "grouped",
                             .says = "A table with groups.",
                             .keys = {keys::table("groups", groups_keys).sometimes("").says("Groups.")}};
  return keys;
}

class ZoneInputs : public testing::Test {
 protected:
  static Document document(const std::string& text) {
    return Document::from_text(text, (std::filesystem::path(testing::TempDir()) / "study.toml").string());
  }
  RandomInputs read(const std::string& text) const {
    Document study = document(text);
    Cursor root(study);
    return read_random_inputs(root, mechanism_->description(), [](const Setting&) {});
  }
  NamedGroups groups(const std::string& text, const std::string& table) const {
    const RandomInputs inputs = read(text);
    Document study = document("[grouped]\n" + table);
    Cursor root(study);
    Cursor grouped = root.table("grouped");
    grouped.only(table_with_groups());
    return read_parameter_groups(grouped, inputs);
  }
  template <typename Function>
  static std::string fault_of(const Function& reads) {
    try {
      reads();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  std::string fault(const std::string& text) const {
    return fault_of([&] { read(text); });
  }
  static std::string zone(const std::string& distribution, const std::string& key = "parameters",
                          const std::string& paths = kBoth) {
    return "[[random]]\n" + key + " = " + paths + "\ndistribution = " + distribution + "\n";
  }
  // How far a rotation or another parameter may be off, by a distribution's table.
  static double reach(const std::string& table, const SiUnit& unit, bool planes = false) {
    Document study = document("zone = " + table + "\n");
    Cursor root(study);
    Cursor cursor = root.table("zone");
    cursor.only(planes ? planes_keys() : cylinder_keys());
    const double r = read_zone_reach(cursor, planes ? "width" : "diameter", unit);
    cursor.finish();
    return r;
  }

  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism(kDefaultMechanism));
};

TEST_F(ZoneInputs, ACylinderDrawsTwoParametersAsAPointOfItsDisc) {
  for (const char* key : {"parameters", "parameter"}) {
    const RandomInputs inputs =
        read(kFriction + zone("{ cylinder = { diameter = \"0.2 m/s^2\" }, zone = \"uniform\" }", key));
    ASSERT_EQ(inputs.size(), 3u);
    EXPECT_THAT(inputs.names(), ElementsAre("clearance.F1.friction.coefficient", "gravity.x", "gravity.y"));
    EXPECT_EQ(inputs.parameters[1].unit, "m/s^2");
    EXPECT_EQ(inputs.text_of(2), "disc(radius 0.10000000000000001, around 0, 0, uniform)");
    EXPECT_THAT(inputs.text, HasSubstr("gravity.x gravity.y ~ disc"));
    for (const SamplingKind kind : {SamplingKind::random, SamplingKind::lhs, SamplingKind::sobol}) {
      const SamplingDesign design({.kind = kind, .seed = 5}, 3);
      constexpr std::uint64_t n = 6400;
      double within = 0.0, friction = 0.0;
      for (std::uint64_t k = 0; k < n; ++k) {
        std::vector<double> v(3);
        design.point(k, v);
        inputs.values(v);
        EXPECT_LE(std::hypot(v[1], v[2]), 0.1 + 1e-15);
        within += std::hypot(v[1], v[2]) < 0.05;
        friction += v[0];
      }
      EXPECT_NEAR(within / n, 0.25, 0.02) << to_string(kind);
      EXPECT_NEAR(friction / n, 0.03, 5e-4) << to_string(kind);
    }
    std::vector<double> middle = inputs.values_at(0.5);
    EXPECT_THAT(middle, ElementsAre(testing::DoubleNear(0.03, 1e-15), 0.0, 0.0));
    const Parameters p = inputs.parameters_with(*mechanism_, std::vector<double>{0.02, 0.03, -0.04});
    EXPECT_EQ(p.gravity.x(), 0.03);
    EXPECT_EQ(p.gravity.y(), -0.04);
  }
}

TEST_F(ZoneInputs, LieAroundTheMechanismFilesValues) {
  const RandomInputs inputs =
      read(zone("{ cylinder = { diameter = \"0.2 m/s^2\" } }", "parameters", "[\"gravity.y\", \"gravity.z\"]"));
  EXPECT_THAT(inputs.values_at(0.5), ElementsAre(0.0, -9.81));
  const RandomInputs planes =
      read(zone("{ planes = { width = \"0.2 m/s^2\" }, zone = \"uniform\" }", "parameter", "\"gravity.z\""));
  EXPECT_NEAR(planes.parameters[0].distribution->lowest(), -9.91, 1e-14);
  EXPECT_NEAR(planes.parameters[0].distribution->highest(), -9.71, 1e-14);
}

TEST_F(ZoneInputs, HaveNoMiddleWhereTheirParametersDiffer) {
  EXPECT_THAT(fault(zone("{ planes = { width = \"0.2 m/s^2\" } }", "parameter", "[\"gravity.y\", \"gravity.z\"]")),
              HasSubstr("parameter: found values from -9.81 to 0 m/s^2, expected parameters that have one value"));
  EXPECT_EQ(fault(zone("{ planes = { width = \"0.2 m/s^2\" } }", "parameter", "[\"gravity.x\", \"gravity.y\"]")),
            "no fault");
}

// An axis of length L in a cylinder of diameter d has its ends at most d apart across it: it leans by at most d / L.
TEST_F(ZoneInputs, AnAxisLeansInItsZoneByTheWidthOverTheLength) {
  EXPECT_DOUBLE_EQ(reach("{ diameter = \"0.02 mm\", length = \"30 mm\" }", kAngle), 0.02 / 30.0);
  EXPECT_DOUBLE_EQ(reach("{ width = \"0.02 mm\", length = \"30 mm\" }", kAngle, true), 0.02 / 30.0);
  EXPECT_DOUBLE_EQ(reach("{ diameter = \"1 mrad\" }", kAngle), 0.5e-3);
  EXPECT_DOUBLE_EQ(reach("{ diameter = \"0.05 mm\" }", kLength), 0.025e-3);
  EXPECT_DOUBLE_EQ(reach("{ width = \"0.05 mm\" }", kLength, true), 0.025e-3);
  const auto wrong = [](const std::string& table, const SiUnit& unit) { return fault_of([&] { reach(table, unit); }); };
  EXPECT_THAT(wrong("{ diameter = \"0.02 mm\" }", kAngle),
              AllOf(HasSubstr("study.toml:1"), HasSubstr("an angle"), HasSubstr("or a length beside a diameter")));
  EXPECT_THAT(wrong("{ diameter = \"0.02 mm\", length = \"30 mm\" }", kLength), HasSubstr("is not an angle"));
  EXPECT_THAT(wrong("{ diameter = \"1 mrad\", length = \"30 mm\" }", kAngle), HasSubstr("a length"));
  EXPECT_THAT(wrong("{ diameter = \"30 mm\", length = \"20 mm\" }", kAngle), HasSubstr("more than the diameter"));
  EXPECT_THAT(wrong("{ diameter = \"1 mm\", length = \"-20 mm\" }", kAngle), HasSubstr("more than 0"));
}

TEST_F(ZoneInputs, BetweenPlanesAParameterIsUniformOrSixSigmaWide) {
  const auto between = [&](const char* law) {
    return read(zone(std::string("{ planes = { width = \"0.6 m/s^2\" }, zone = \"") + law + "\" }", "parameter",
                     "\"gravity.x\""))
        .parameters[0];
  };
  EXPECT_NEAR(between("uniform").distribution->sd(), 0.3 / std::sqrt(3.0), 1e-15);
  const RandomParameter normal = between("normal");
  EXPECT_EQ(normal.unit, "m/s^2");
  EXPECT_NEAR(normal.distribution->highest(), 0.3, 1e-16);
  // 2 Phi(1) - 1 over 2 Phi(3) - 1
  EXPECT_NEAR(normal.distribution->cdf(0.1) - normal.distribution->cdf(-0.1), 0.6826894921370859 / 0.9973002039367398,
              1e-13);
}

TEST_F(ZoneInputs, AZonesParameterCorrelatesWithAnothersScore) {
  const std::string text = zone("{ cylinder = { diameter = \"0.2 m/s^2\" } }") + kFriction +
                           "[[correlation]]\nparameters = [\"gravity.y\", \"clearance.F1.friction.coefficient\"]\n";
  const RandomInputs inputs = read(text + "coefficient = 0.8\n");
  const SamplingDesign design({.kind = SamplingKind::sobol, .seed = 4}, 3);
  constexpr std::uint64_t n = 1 << 14;
  double with_x = 0.0, with_y = 0.0, within = 0.0, xy = 0.0;
  for (std::uint64_t k = 0; k < n; ++k) {
    std::vector<double> v(3);
    design.point(k, v);
    inputs.values(v);
    const double score = (v[2] - 0.03) / (0.04 / std::sqrt(12.0));
    with_x += v[0] * score / n;
    with_y += v[1] * score / n;
    xy += v[0] * v[1] / n;
    within += std::hypot(v[0], v[1]) < 0.05;
  }
  const double sd = inputs.parameters[0].distribution->sd();
  EXPECT_NEAR(with_x / sd, 0.0, 0.01);
  EXPECT_NEAR(with_y / sd, 0.8, 0.05);
  EXPECT_NEAR(xy / (sd * sd), 0.0, 0.01);
  EXPECT_NEAR(within / n, (1.0 - std::exp(-4.5 * 0.25)) / (1.0 - std::exp(-4.5)), 2e-3);  // the zone is what it was

  EXPECT_THAT(fault(text + "coefficient = 0.5\nmeasure = \"spearman\"\n"),
              AllOf(HasSubstr("study.toml:10"), HasSubstr("\"normal\" for a parameter of a cylinder")));
  EXPECT_THAT(fault(zone("{ cylinder = { diameter = \"0.2 m/s^2\" } }") + "[[correlation]]\nparameters = " + kBoth +
                    "\ncoefficient = 0.5\n"),
              HasSubstr("given by their zone already"));
}

TEST_F(ZoneInputs, ACylindersParametersAreOneGroup) {
  const std::string text = zone("{ cylinder = { diameter = \"0.2 m/s^2\" } }") + kFriction;
  const NamedGroups by_itself = groups(text, "");
  EXPECT_THAT(by_itself.names, ElementsAre("gravity.x, gravity.y", "clearance.F1.friction.coefficient"));
  EXPECT_THAT(by_itself.members, ElementsAre(ElementsAre(0, 1), ElementsAre(2)));
  EXPECT_THAT(groups(text, "groups = { tilt = " + kBoth + " }").names,
              ElementsAre("tilt", "clearance.F1.friction.coefficient"));
  EXPECT_THAT(fault_of([&] { groups(text, "groups = { tilt = [\"gravity.y\"] }"); }),
              HasSubstr("only one of gravity.x and gravity.y"));
  EXPECT_THAT(fault_of([&] { groups(text, "groups = { a = [\"gravity.y\"], b = [\"gravity.x\"] }"); }),
              HasSubstr("one cylinder holds them"));
}

TEST_F(ZoneInputs, MistakesAreOneLineWithFileLineAndKey) {
  const auto says = [&](const std::string& text, const std::string& words) {
    EXPECT_THAT(fault(text), AllOf(HasSubstr("study.toml:"), HasSubstr(words))) << text;
    EXPECT_EQ(fault(text).find('\n'), std::string::npos);
  };
  const std::string good = "{ cylinder = { diameter = \"0.2 m/s^2\" } }";
  says(zone(good, "parameters", "[\"gravity.x\"]"), "two parameters");
  says(zone(good, "parameter", "\"gravity.x\""), "two parameters, whose point lies in the cylinder");
  says(zone(good, "parameters", "[\"gravity.x\", \"gravity.y\", \"gravity.z\"]"), "two parameters");
  says(zone(good, "parameters", "[\"gravity.x\", \"gravity.x\"]"), "a second time");
  says(zone(good, "parameters", "[\"gravity.x\", \"payload.mass\"]"), "two parameters of one unit, in m/s^2");
  says(zone(good) + zone("{ normal = { mean = \"0 m/s^2\", sd = \"1 m/s^2\" } }", "parameter", "\"gravity.y\""),
       "a second time");
  says("[[random]]\nparameter = \"gravity.z\"\nparameters = " + kBoth + "\ndistribution = " + good + "\n",
       "one of the two");
  says(zone("{ uniform = { min = \"0 m/s^2\", max = \"1 m/s^2\" } }"), "a cylinder, of which two parameters");
  says(zone("{ cylinder = { diameter = \"-0.2 m/s^2\" } }"), "more than 0");
  says(zone("{ cylinder = { diameter = \"0.2 mm\" } }"), "an acceleration");
  says(zone("{ cylinder = { diameter = 0.2 } }"), "an acceleration");
  says(zone("{ cylinder = { diamter = \"0.2 m/s^2\" } }"), "did you mean diameter?");
  says(zone("{ cylinder = { } }"), "diameter");
  says(zone("{ cylinder = 3 }"), "a table");
  says(zone("{ cylinder = { diameter = \"0.2 m/s^2\", length = \"3 mm\" } }"), "is not an angle");
  says(zone("{ cylinder = { diameter = \"0.2 m/s^2\" }, planes = { width = \"1 m/s^2\" } }"),
       "found planes and cylinder, expected one distribution");
  says(zone("{ cylinder = { diameter = \"0.2 m/s^2\" }, truncate = [\"0 m/s^2\", \"1 m/s^2\"] }"), "a cylinder alone");
  says(zone("{ cylinder = { diameter = \"0.2 m/s^2\" }, zone = \"unifrm\" }"), "did you mean uniform?");
  says(zone("{ planes = { width = \"0 m/s^2\" } }", "parameter", "\"gravity.x\""), "more than 0");
  says("[[random]]\ndistribution = " + good + "\n", "parameter");
}

// The error along [1, 0, 0] of a joint's frame in one body, and one along [1, 2, 0] of the same.
TEST_F(ZoneInputs, TwoErrorsOfOneFrameAreAlongPerpendicularDirections) {
  std::ifstream in(kDefaultMechanism);
  std::string text(std::istreambuf_iterator<char>(in), {});
  const auto error = [](const std::string& name, const std::string& kind, const std::string& direction,
                        const std::string& body = "platform") {
    return "[[error]]\nname = \"" + name + "\"\njoint = \"F1\"\nbody = \"" + body + "\"\n" + kind + " = " + direction +
           "\n";
  };
  text += error("x", "translation", "[1, 0, 0]") + error("y", "translation", "[0.0004, 1, 0]") +
          error("askew", "translation", "[1, 2, 0]") + error("turned", "rotation", "[1, 0, 0]") +
          error("leaning", "rotation", "[-1, 0.5, 0]") + error("of the rod", "translation", "[1, 0, 0]", "rod1");
  const MechanismDescription mechanism = read_mechanism_text(text, kDefaultMechanism);
  const auto fault_with = [&](const std::string& a, const std::string& b, const std::string& diameter) {
    return fault_of([&] {
      Document study = document(zone("{ cylinder = { diameter = \"" + diameter + "\" } }", "parameters",
                                     "[\"error." + a + "\", \"error." + b + "\"]"));
      Cursor root(study);
      read_random_inputs(root, mechanism, [](const Setting&) {});
    });
  };
  EXPECT_EQ(fault_with("x", "y", "0.1 mm"), "no fault");
  EXPECT_EQ(fault_with("askew", "of the rod", "0.1 mm"), "no fault");  // no point of one frame
  const std::string askew = fault_with("x", "askew", "0.1 mm");
  EXPECT_THAT(askew, AllOf(HasSubstr("study.toml:2: "), HasSubstr("parameters: found"),
                           HasSubstr(" 63.4 degrees apart"), HasSubstr("expected two along perpendicular directions")));
  EXPECT_EQ(askew.find('\n'), std::string::npos);
  EXPECT_THAT(fault_with("turned", "leaning", "0.1 mrad"), HasSubstr(" 26.6 degrees apart"));
}

}  // namespace zone_inputs_test
}  // namespace boresight
