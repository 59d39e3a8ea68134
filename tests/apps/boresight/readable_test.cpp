#include "terminal/readable.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight::app {
namespace readable_test {

TEST(Readable, UsesTheUnitsPeopleRead) {
  EXPECT_EQ(readable(2.3117787e-4, "m"), "0.231 mm");
  EXPECT_EQ(readable(1e-4, "m"), "0.1 mm");
  EXPECT_EQ(readable(2.19e-5, "m"), "21.9 µm");
  EXPECT_EQ(readable(0.5, "m"), "500 mm");
  EXPECT_EQ(readable(2.396e-3, "rad"), "2.4 mrad");
  EXPECT_EQ(readable(5947.0, "N"), "5.95 kN");
  EXPECT_EQ(readable(0.0477, "m/s"), "47.7 mm/s");
  EXPECT_EQ(readable(72e9, "Pa"), "72 GPa");
  EXPECT_EQ(readable(250.0, "kg"), "250 kg");
  EXPECT_EQ(readable(0.9, "1"), "0.9");
  EXPECT_EQ(readable(9.81, "m/s^2"), "9.81 m/s²");
  EXPECT_EQ(readable(1.58e-4, "s"), "0.158 ms");
  EXPECT_EQ(readable(1.0, "s"), "1 s");
}

TEST(Readable, ZeroAndRoundingAreSaidPlainly) {
  EXPECT_EQ(readable(0.0, "m"), "0 mm");
  EXPECT_EQ(readable(2.9e-13, "rad"), "below 1 prad");
  EXPECT_EQ(readable_arcsec(2.9e-13), "below 0.000001 arcsec");
}

TEST(Readable, AMilliarcsecondAndLessIsANumber) {
  EXPECT_EQ(readable(4.85e-9, "rad"), "4.85 nrad");
  EXPECT_EQ(readable(3.366e-11, "rad"), "33.7 prad");
  EXPECT_EQ(readable(-5e-12, "m"), "-5 pm");
  EXPECT_EQ(readable_arcsec(3.366e-11), "6.94e-06 arcsec");
}

TEST(Readable, StaysInTheUnitThatTheUserWrote) {
  const double arcsec = 4.84813681109536e-6;
  EXPECT_EQ(readable_as(30.0 * arcsec, "rad", "arcsec"), "30 arcsec");
  EXPECT_EQ(readable_as(15.06 * arcsec, "rad", "arcsec"), "15.1 arcsec");
  EXPECT_EQ(readable_as(2.5e-4, "m", "um"), "250 um");
  EXPECT_EQ(readable_as(2.5e-4, "m", ""), "0.25 mm");
  EXPECT_EQ(readable_as(2.5e-7, "m", "m"), "0.25 µm") << "0.00000025 m is for nobody";
  EXPECT_EQ(readable_as(INFINITY, "rad", "arcsec"), "not known");
  EXPECT_EQ(readable_as(2.5e-4, "rad", "ppm"), "250 ppm");  // a scale
  EXPECT_DOUBLE_EQ(display_unit_as("rad", 1e-4, "arcsec").per_si * arcsec, 1.0);
}

TEST(Readable, ALimitKeepsTheDigitsThatItWasTypedWith) {
  EXPECT_EQ(readable_limit(45.96 * 1e-6, "rad", "urad"), "45.96 urad");
  EXPECT_EQ(readable_limit(29.95 * 1e-3, "m", "mm"), "29.95 mm");
  EXPECT_EQ(readable_limit(15.0625 * 4.84813681109536e-6, "rad", "arcsec"), "15.0625 arcsec");
  EXPECT_EQ(readable_limit(0.0005 * 1e-3, "m", "mm"), "0.0005 mm") << "in the unit that it was typed in";
  EXPECT_EQ(readable_limit(1234567.0 * 1e-6, "m", "um"), "1234567 um");
  EXPECT_EQ(readable_limit(1.2345, "1", ""), "1.2345");
}

TEST(Readable, AScaleIsAShare) {
  EXPECT_EQ(readable_of_error(2.5e-4, "1"), "250 ppm");
  EXPECT_EQ(readable_of_error(-3e-5, "1"), "-30 ppm");
  EXPECT_EQ(readable_of_error(2e-3, "1"), "0.2 %");
  EXPECT_EQ(readable_of_error(2.5e-4, "rad"), "0.25 mrad");
}

TEST(Readable, AScaleInPartsPerMillionIsNeverALength) {
  EXPECT_EQ(readable_as(1.86e-4, "m", "ppm"), "186 ppm");
  EXPECT_EQ(readable_as(0.0, "m", "ppm"), "0 ppm");
  EXPECT_EQ(readable_as(0.25, "m", "ppm"), "25 %");
  EXPECT_EQ(readable_as(5e-10, "rad", "ppm"), "0.0005 ppm");
}

TEST(Readable, ArcsecondsAndShares) {
  EXPECT_EQ(readable_arcsec(2.396e-3), "494 arcsec");
  EXPECT_EQ(readable_share(0.9786), "97.9 %");
  EXPECT_EQ(readable_error(0.9786), "97.9 %");
  EXPECT_EQ(readable_error(35.2), "35 times the value itself");
  EXPECT_EQ(readable_error(1e9), "over 10000 times the value itself");
}

TEST(Readable, AShareNearAllHasDigitsOfWhatItLacksAndIsRoundedDown) {
  EXPECT_EQ(readable_near_all(0.962351), "96.2 %");
  EXPECT_EQ(readable_near_all(0.9997319), "99.973 %");
  EXPECT_EQ(readable_near_all(0.9973), "99.73 %");
  EXPECT_EQ(readable_near_all(0.5), "50 %");
  EXPECT_EQ(readable_near_all(1.0), "100 %");
}

TEST(Readable, OneIsNoPlural) {
  EXPECT_EQ(how_many(1, "impact"), "1 impact");
  EXPECT_EQ(how_many(0, "impact"), "0 impacts");
  EXPECT_EQ(how_many(1, "body", "bodies"), "1 body");
  EXPECT_EQ(how_many(2, "body", "bodies"), "2 bodies");
}

}  // namespace readable_test
}  // namespace boresight::app
