#include "boresight_analyses/random/iso_286.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/keys/value_fault.hpp"
#include "boresight_analyses/random/fit_clearance.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace iso_286_test {

struct Golden {
  const char* fit;
  double least, largest;  // diametral clearance [um]
};

// ISO 286-2:2010, limits of common fits.
TEST(Iso286, CommonFitsHaveTheStandardsClearances) {
  const Golden goldens[] = {
      {"14 H7/h6", 0, 29},   {"20 H7/h6", 0, 34},   {"40 H7/h6", 0, 41},     {"14 H7/g6", 6, 35},
      {"20 H7/g6", 7, 41},   {"40 H7/g6", 9, 50},   {"14 H7/f7", 16, 52},    {"20 H7/f7", 20, 62},
      {"40 H7/f7", 25, 75},  {"14 H8/f7", 16, 61},  {"20 H8/f7", 20, 74},    {"40 H8/f7", 25, 89},
      {"14 H8/e8", 32, 86},  {"20 H8/e8", 40, 106}, {"40 H8/e8", 50, 128},   {"14 H9/d9", 50, 136},
      {"20 H9/d9", 65, 169}, {"40 H9/d9", 80, 204}, {"45 H11/c11", 130, 450}};
  validation::PrintedTable table("ISO 286-2:2010", "clearances of common fits [um]", 1e-9);
  for (const Golden& g : goldens) {
    const Fit fit = parse_fit(g.fit);
    table.expect(g.fit, g.least, 1e6 * fit.least_clearance());
    table.expect(g.fit, g.largest, 1e6 * fit.largest_clearance());
  }
}

TEST(Iso286, ShaftBasisGivesTheSameClearanceAsHoleBasis) {
  for (const char* letter : {"c", "d", "e", "f", "g", "h"}) {
    std::string upper(1, static_cast<char>(letter[0] - 'a' + 'A'));
    const Fit hole = parse_fit("100 H8/" + std::string(letter) + "7"), shaft = parse_fit("100 " + upper + "8/h7");
    EXPECT_NEAR(hole.least_clearance(), shaft.least_clearance(), 1e-15);
    EXPECT_NEAR(hole.largest_clearance(), shaft.largest_clearance(), 1e-15);
  }
}

// ISO 286-1:2010, Table 1, grade by grade as it is printed: one number per range of nominal sizes [um].
TEST(Iso286, GradesAreThoseOfTheStandardsTable) {
  const double ends[] = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};
  const double grades[13][13] = {{0.8, 1, 1, 1.2, 1.5, 1.5, 2, 2.5, 3.5, 4.5, 6, 7, 8},
                                 {1.2, 1.5, 1.5, 2, 2.5, 2.5, 3, 4, 5, 7, 8, 9, 10},
                                 {2, 2.5, 2.5, 3, 4, 4, 5, 6, 8, 10, 12, 13, 15},
                                 {3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20},
                                 {4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27},
                                 {6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40},
                                 {10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63},
                                 {14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97},
                                 {25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155},
                                 {40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250},
                                 {60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400},
                                 {100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630},
                                 {140, 180, 220, 270, 330, 390, 460, 540, 630, 720, 810, 890, 970}};
  validation::PrintedTable table("ISO 286-1:2010, Table 1", "tolerance grades IT1 to IT13 [um]", 1e-9);
  for (int g = 0; g < 13; ++g)
    for (int r = 0; r < 13; ++r) {
      const std::string name = std::to_string(ends[r]) + " H" + std::to_string(g + 1) + "/h6";
      table.expect(name, grades[g][r], 1e6 * parse_fit(name).hole.upper);
    }
}

// ISO 286-1:2010, Table 4, letter by letter: -es [um], per range, and of c per its finer ranges.
TEST(Iso286, DeviationsAreThoseOfTheStandardsTable) {
  const auto es = [](double size, const std::string& letter) {
    return -1e6 * parse_fit(std::to_string(size) + " H7/" + letter + "6").shaft.upper;
  };
  const double ends[] = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};
  const struct {
    const char* letter;
    double es[13];
  } letters[] = {{"d", {20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230}},
                 {"e", {14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135}},
                 {"f", {6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68}},
                 {"g", {2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20}}};
  validation::PrintedTable table("ISO 286-1:2010, Table 4", "deviations of shafts c, d, e, f, g [um]", 1e-9);
  for (const auto& l : letters)
    for (int r = 0; r < 13; ++r) table.expect(l.letter + std::to_string(ends[r]), l.es[r], es(ends[r], l.letter));
  const double c[][2] = {{3, 60},    {6, 70},    {10, 80},   {14, 95},   {18, 95},   {24, 110},  {30, 110},
                         {40, 120},  {50, 130},  {65, 140},  {80, 150},  {100, 170}, {120, 180}, {140, 200},
                         {160, 210}, {180, 230}, {200, 240}, {225, 260}, {250, 280}, {280, 300}, {315, 330},
                         {355, 360}, {400, 400}, {450, 440}, {500, 480}};
  for (const auto& [size, expected] : c) table.expect("c" + std::to_string(size), expected, es(size, "c"));
}

// i = 0.45 D^(1/3) + 0.001 D um, D the geometric mean of the range; the standard rounds. Grades 6 to 11 are 10 i ..
// 100 i.
TEST(Iso286, GradesFollowTheToleranceUnitWithinTheStandardsRounding) {
  const double ends[] = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};
  const double units[] = {10, 16, 25, 40, 64, 100};
  for (int r = 1; r < 13; ++r) {
    const double D = std::sqrt(ends[r - 1] * ends[r]), i = 0.45 * std::cbrt(D) + 0.001 * D;
    for (int g = 0; g < 6; ++g) {
      const std::string name = std::to_string(ends[r]) + " H" + std::to_string(6 + g) + "/h6";
      const Fit fit = parse_fit(name);
      const double width = units[g] * i;
      EXPECT_NEAR(1e6 * (fit.hole.upper - fit.hole.lower), width, std::max(0.75, 0.06 * width)) << name;
    }
  }
}

// ISO 286-1: es of d = 16 D^0.44, e = 11 D^0.41, f = 5.5 D^0.41, g = 2.5 D^0.34, c = 52 D^0.2 (to 40) or 95 + 0.8 D.
TEST(Iso286, DeviationsFollowTheirFormulasWithinTheStandardsRounding) {
  const double ends[] = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};
  const auto es = [](double size, const char* letter) {
    return -1e6 * parse_fit(std::to_string(size) + " H7/" + letter + "6").shaft.upper;
  };
  for (int r = 1; r < 13; ++r) {
    const double D = std::sqrt(ends[r - 1] * ends[r]);
    EXPECT_NEAR(es(ends[r], "d") / (16.0 * std::pow(D, 0.44)), 1.0, 0.05) << ends[r];
    EXPECT_NEAR(es(ends[r], "e") / (11.0 * std::pow(D, 0.41)), 1.0, 0.06) << ends[r];
    EXPECT_NEAR(es(ends[r], "f") / (5.5 * std::pow(D, 0.41)), 1.0, 0.06) << ends[r];
    EXPECT_NEAR(es(ends[r], "g") - 2.5 * std::pow(D, 0.34), 0.0, 0.7) << ends[r];
    EXPECT_EQ(es(ends[r], "h"), 0.0);
  }
  const double fine[] = {30, 40, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500};
  for (int k = 2; k < 19; ++k) {
    const double D = std::sqrt(fine[k - 1] * fine[k]);
    EXPECT_NEAR(es(fine[k], "c") / (95.0 + 0.8 * D), 1.0, 0.03) << fine[k];
  }
}

TEST(Iso286, ASizeOnTheBorderBelongsToTheLowerRange) {
  EXPECT_NEAR(parse_fit("18 H7/h6").hole.upper, 18e-6, 1e-15);
  EXPECT_NEAR(parse_fit("18.01 H7/h6").hole.upper, 21e-6, 1e-15);
}

TEST(Iso286, WhatItDoesNotCoverIsRefusedByName) {
  for (const char* text :
       {"20", "20 H7", "H7/g6", "20 H7/g", "20 h7/g6", "20 H7/G6", "20 H7/g14", "20 H0/g6", "20 K7/h6", "20 H7/k6",
        "0 H7/g6", "501 H7/g6", "-20 H7/g6", "nan H7/g6", "20 H7/g6x", "20 /", "20 H7/ g6"})
    EXPECT_THROW(parse_fit(text), ValueFault) << text;
}

TEST(FitClearance, RadialClearanceIsHalfTheDifferenceOfTwoIndependentDeviations) {
  const Fit fit = parse_fit("20 H7/g6");  // hole 0 .. 21, shaft -20 .. -7
  const DistributionPtr uniform = make_fit_clearance(fit, ZoneLaw::uniform);
  EXPECT_NEAR(uniform->lowest(), 3.5e-6, 1e-15);
  EXPECT_NEAR(uniform->highest(), 20.5e-6, 1e-15);
  EXPECT_NEAR(uniform->mean(), 12e-6, 1e-15);
  EXPECT_NEAR(uniform->sd(), 0.5 * std::sqrt((21.0 * 21.0 + 13.0 * 13.0) / 12.0) * 1e-6, 1e-15);
  // A trapezoid: rising over 13 um, level over 8, falling over 13, of the diametral clearance 7 .. 41.
  EXPECT_NEAR(uniform->cdf(0.5 * 20e-6), 0.5 * 13.0 / 21.0, 1e-12);
  EXPECT_NEAR(uniform->cdf(12e-6), 0.5, 1e-12);
  EXPECT_NEAR(uniform->density(12e-6) * 1e-6, 2.0 / 21.0, 1e-9);
  const DistributionPtr normal = make_fit_clearance(fit, ZoneLaw::normal);
  EXPECT_NEAR(normal->mean(), 12e-6, 1e-15);
  // Six standard deviations wide, cut at three: sd is 0.98658 of a sixth of the width.
  EXPECT_NEAR(normal->sd(), 0.5 * std::hypot(21.0, 13.0) / 6.0 * 0.986578 * 1e-6, 1e-11);
  EXPECT_NEAR(normal->quantile(0.5), 12e-6, 1e-12);
}

}  // namespace iso_286_test
}  // namespace boresight
