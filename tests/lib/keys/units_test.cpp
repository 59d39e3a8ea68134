// Every unit a mechanism or study file needs, and what must not pass for it.
#include "boresight/keys/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "boresight/keys/value_fault.hpp"

namespace boresight {
namespace units_test {

constexpr double kPi = std::numbers::pi;

struct Case {
  const char* text;
  SiUnit unit;
  double value;
};

TEST(Units, ConvertToSi) {
  const Case cases[] = {{"0.1 mm", kLength, 1e-4},
                        {"0.2mm", kLength, 2e-4},
                        {"3 um", kLength, 3e-6},
                        {"3 µm", kLength, 3e-6},
                        {"3 μm", kLength, 3e-6},
                        {"2 m", kLength, 2.0},
                        {"2 km", kLength, 2000.0},
                        {"180 deg", kAngle, kPi},
                        {"60 arcmin", kAngle, kPi / 180},
                        {"3600 arcsec", kAngle, kPi / 180},
                        {"3600e3 mas", kAngle, kPi / 180},
                        {"3600e6 uas", kAngle, kPi / 180},
                        {"3600e6 µas", kAngle, kPi / 180},
                        {"3600e6 μas", kAngle, kPi / 180},
                        {"200 gon", kAngle, kPi},
                        {"200e3 mgon", kAngle, kPi},
                        {"36 mdeg", kAngle, 36e-3 * kPi / 180},
                        {"3600e3 mas/s", kAngularRate, kPi / 180},
                        {"1.5 rad", kAngle, 1.5},
                        {"2 mrad", kAngle, 2e-3},
                        {"2 urad", kAngle, 2e-6},
                        {"2 µrad", kAngle, 2e-6},
                        {"60 rpm", kAngularRate, 2 * kPi},
                        {"5000 rpm", kAngularRate, 5000 * 2 * kPi / 60},
                        {"6 rad/s", kAngularRate, 6.0},
                        {"180 deg/s", kAngularRate, kPi},
                        {"50 Hz", kFrequency, 50.0},
                        {"1 s", kDuration, 1.0},
                        {"5 ms", kDuration, 5e-3},
                        {"15 kg", kMass, 15.0},
                        {"15 g", kMass, 0.015},
                        {"10 N", kForce, 10.0},
                        {"10 kN", kForce, 1e4},
                        {"0.033 N m", kTorque, 0.033},
                        {"8e5 N/m", kStiffness, 8e5},
                        {"4e4 N s/m", kDamping, 4e4},
                        {"1 Pa", kElasticModulus, 1.0},
                        {"1 kPa", kElasticModulus, 1e3},
                        {"1 MPa", kElasticModulus, 1e6},
                        {"72 GPa", kElasticModulus, 72e9},
                        {"2700 kg/m^3", kDensity, 2700.0},
                        {"0.45 kg m^2", kInertia, 0.45},
                        {"1 g mm^2", kInertia, 1e-9},
                        {"2 m/s", kSpeed, 2.0},
                        {"1 mm/s", kSpeed, 1e-3},
                        {"-9.81 m/s^2", kAcceleration, -9.81},
                        {"1 %", kRatio, 0.01},
                        {"0.3 1", kRatio, 0.3},
                        {"0 mm", kLength, 0.0},
                        {"-0.0 kg", kMass, 0.0},
                        {"+5 mm", kLength, 5e-3},
                        {" 5 mm ", kLength, 5e-3},
                        {".5 m", kLength, 0.5},
                        {"1e-3 m", kLength, 1e-3},
                        {"5 kg m2", kInertia, 5.0},
                        {"5 kg.m^2", kInertia, 5.0},
                        {"5 kg*m^2", kInertia, 5.0},
                        {"5 m s-2", kAcceleration, 5.0},
                        {"3 1/s", kFrequency, 3.0}};
  for (const Case& c : cases) {
    try {
      EXPECT_NEAR(parse_quantity(c.text, c.unit), c.value, 1e-14 * std::abs(c.value)) << c.text;
    } catch (const ValueFault& fault) {
      ADD_FAILURE() << c.text << ": " << fault.what();
    }
  }
}

TEST(Units, RefuseAnotherDimensionTheRadianIncluded) {
  const Case cases[] = {{"5 mm", kAngle, 0},         {"5 deg", kLength, 0},     {"20 %", kAngle, 0},
                        {"1 1", kAngle, 0},          {"5 Hz", kAngularRate, 0}, {"5 1/s", kAngularRate, 0},
                        {"5 rad/s", kFrequency, 0},  {"5 rpm", kFrequency, 0},  {"5 deg", kRatio, 0},
                        {"5 kg", kForce, 0},         {"5 N", kMass, 0},         {"5 N/m^2", kStiffness, 0},
                        {"5 m/s", kAcceleration, 0}, {"5 J", kMass, 0},         {"5 rad m", kLength, 0}};
  for (const Case& c : cases)
    EXPECT_THROW(parse_quantity(c.text, c.unit), ValueFault) << c.text << " as " << c.unit.what;
}

TEST(Units, RefuseWhatIsNotOneFiniteNumberWithOneUnit) {
  for (const char* text : {"",
                           " ",
                           "mm",
                           "5",
                           "5 ",
                           "nan mm",
                           "inf mm",
                           "-inf mm",
                           "0x10 mm",
                           "1e999 mm",
                           "1e308 km",
                           "5 mm mm^-1 x",
                           "5 2 mm",
                           "5 mm 2",
                           "5,0 mm",
                           "5 mm; 6",
                           "--5 mm",
                           "+-5 mm",
                           "- 5 mm",
                           "5e mm",
                           "5 degC",
                           "5 K @ 2",
                           "5 s since 2000-01-01",
                           "5 lg(re mW)",
                           "5 m^999",
                           "5 (m",
                           "5 \xff",
                           "1 m\n",
                           "5 m m",
                           "5 m^0"}) {
    EXPECT_THROW(parse_quantity(text, kLength), ValueFault) << text;
  }
  EXPECT_THROW(parse_quantity(std::string(100000, '9') + " mm", kLength), ValueFault);
  EXPECT_THROW(parse_quantity("5 " + std::string(100000, 'm'), kLength), ValueFault);
}

TEST(Units, NameTheNearestUnit) {
  try {
    parse_quantity("5 mmm", kLength);
    FAIL();
  } catch (const ValueFault& fault) {
    EXPECT_EQ(fault.found, "\"5 mmm\" with the unknown unit \"mmm\"");
    EXPECT_EQ(fault.expected, "a length such as \"0.1 mm\"");
    EXPECT_EQ(fault.nearest, "mm");
  }
}

TEST(Units, ThatCountFromAZeroOfTheirOwnAreSaidToDoSo) {
  try {
    parse_quantity("8 degC", kTemperature);
    ADD_FAILURE() << "no fault";
  } catch (const ValueFault& fault) {
    EXPECT_EQ(fault.found, "\"8 degC\", whose unit counts from a zero of its own");
    EXPECT_EQ(fault.expected, "a difference of temperatures such as \"5 K\"");
    EXPECT_EQ(fault.nearest, "");
  }
}

TEST(Units, AreSuggestedWhereTheyMeasureWhatIsAsked) {
  const auto nearest = [](const char* unit, const SiUnit& expected) {
    try {
      scale_of_unit(unit, expected);
    } catch (const ValueFault& fault) {
      return fault.nearest;
    }
    return std::string("no fault");
  };
  EXPECT_EQ(nearest("asec", kAngle), "arcsec") << "an attosecond";
  EXPECT_EQ(nearest("min", kLength), "");
  EXPECT_EQ(nearest("kg", kLength), "");
  EXPECT_EQ(nearest("degg", kTemperature), "");
}

// The example of a value has a number; where there is none, the unit is said to be one.
TEST(Units, OfAParameterAreSaidWithAValue) {
  EXPECT_EQ(expectation(unit_called("rad")), "an angle such as \"30 deg\"");
  EXPECT_EQ(expectation(unit_called("K")), "a difference of temperatures such as \"5 K\"");
  EXPECT_EQ(expectation(unit_called("N m s/rad")), "a value in N m s/rad");
}

TEST(Units, AreSafeFromManyThreads) {
  std::vector<std::thread> threads;
  std::vector<double> sums(4, 0.0);
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([&sums, k] {
      for (int i = 0; i < 200; ++i) sums[k] += parse_quantity("1 mm", kLength) + parse_quantity("1 um/ms", kSpeed);
    });
  }
  for (auto& thread : threads) thread.join();
  for (const double sum : sums) EXPECT_NEAR(sum, 200 * 2e-3, 1e-12);
}

// Two bytes a letter: 81 letters are cut after 60 of them, and 80 are not.
TEST(Quotes, CountAndCutLetters) {
  std::string eighty, sixty;
  for (int k = 0; k < 80; ++k) eighty += "\u00e4";
  for (int k = 0; k < 60; ++k) sixty += "\u00e4";
  EXPECT_EQ(in_quotes(eighty), "\"" + eighty + "\"");
  EXPECT_EQ(in_quotes("x" + eighty), "\"x" + sixty.substr(2) + "...\"");
}

TEST(Numbers, AreReadWholeOrNotAtAll) {
  double value = 0.0;
  EXPECT_TRUE(parse_number("0.7", value));
  EXPECT_EQ(value, 0.7);
  for (const char* text : {"", "0.7x", "nan", "inf", "1e999", "0.7 mm", "1 2", "++1", "true"}) {
    EXPECT_FALSE(parse_number(text, value)) << text;
  }
}

}  // namespace units_test
}  // namespace boresight
