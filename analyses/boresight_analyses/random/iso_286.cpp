#include "boresight_analyses/random/iso_286.hpp"

#include <array>
#include <cctype>
#include <cstdlib>
#include <vector>

#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

constexpr int kRanges = 13;
// A range ends with (and includes) its upper size [mm].
constexpr std::array<double, kRanges> kUpTo = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};

// ISO 286-1:2010, Table 1: IT1 to IT13 [um], one row per range.
constexpr double kGrade[kRanges][13] = {
    {0.8, 1.2, 2, 3, 4, 6, 10, 14, 25, 40, 60, 100, 140},     {1, 1.5, 2.5, 4, 5, 8, 12, 18, 30, 48, 75, 120, 180},
    {1, 1.5, 2.5, 4, 6, 9, 15, 22, 36, 58, 90, 150, 220},     {1.2, 2, 3, 5, 8, 11, 18, 27, 43, 70, 110, 180, 270},
    {1.5, 2.5, 4, 6, 9, 13, 21, 33, 52, 84, 130, 210, 330},   {1.5, 2.5, 4, 7, 11, 16, 25, 39, 62, 100, 160, 250, 390},
    {2, 3, 5, 8, 13, 19, 30, 46, 74, 120, 190, 300, 460},     {2.5, 4, 6, 10, 15, 22, 35, 54, 87, 140, 220, 350, 540},
    {3.5, 5, 8, 12, 18, 25, 40, 63, 100, 160, 250, 400, 630}, {4.5, 7, 10, 14, 20, 29, 46, 72, 115, 185, 290, 460, 720},
    {6, 8, 12, 16, 23, 32, 52, 81, 130, 210, 320, 520, 810},  {7, 9, 13, 18, 25, 36, 57, 89, 140, 230, 360, 570, 890},
    {8, 10, 15, 20, 27, 40, 63, 97, 155, 250, 400, 630, 970}};

// ISO 286-1:2010, Table 4: upper deviations es of shafts, without their minus sign [um].
struct Letter {
  const char* name;
  std::array<double, kRanges> es;
};
constexpr Letter kLetters[] = {{"d", {20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230}},
                               {"e", {14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135}},
                               {"f", {6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68}},
                               {"g", {2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20}},
                               {"h", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}};

// c has finer ranges.
struct Step {
  double up_to, es;
};
constexpr Step kC[] = {{3, 60},    {6, 70},    {10, 80},   {18, 95},   {30, 110},  {40, 120},  {50, 130},  {65, 140},
                       {80, 150},  {100, 170}, {120, 180}, {140, 200}, {160, 210}, {180, 230}, {200, 240}, {225, 260},
                       {250, 280}, {280, 300}, {315, 330}, {355, 360}, {400, 400}, {450, 440}, {500, 480}};

constexpr double kMicrometre = 1e-6;
const char* const kExpected = "a fit such as \"20 H7/g6\": nominal size in mm, hole, shaft";

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

ToleranceZone zone(const std::string& name, double nominal_mm, bool is_hole, const std::string& whole) {
  std::size_t digits = 0;
  while (digits < name.size() && std::isalpha(static_cast<unsigned char>(name[digits]))) ++digits;
  const std::string letter = name.substr(0, digits);
  const std::string number = name.substr(digits);
  const bool upper = letter != lower_case(letter);
  if (letter.empty() || number.empty() || number.size() > 2 ||
      number.find_first_not_of("0123456789") != std::string::npos || upper != is_hole)
    throw ValueFault(in_quotes(whole), kExpected);
  const int grade = std::atoi(number.c_str());
  if (grade < 1 || grade > 13) throw ValueFault("grade " + number + " in " + in_quotes(whole), "a grade from 1 to 13");
  int range = 0;
  while (nominal_mm > kUpTo[range]) ++range;
  const double width = kGrade[range][grade - 1] * kMicrometre;

  const std::string plain = lower_case(letter);
  double es = -1.0;
  if (plain == "js") {
    return {name, -0.5 * width, 0.5 * width};
  } else if (plain == "c") {
    int step = 0;
    while (nominal_mm > kC[step].up_to) ++step;
    es = kC[step].es;
  } else {
    for (const Letter& known : kLetters)
      if (plain == known.name) es = known.es[range];
  }
  if (es < 0.0)
    throw ValueFault("the deviation " + letter + " in " + in_quotes(whole),
                     is_hole ? "one of C, D, E, F, G, H, JS" : "one of c, d, e, f, g, h, js");
  es *= kMicrometre;
  return is_hole ? ToleranceZone{name, es, es + width} : ToleranceZone{name, -es - width, -es};
}

}  // namespace

Fit parse_fit(const std::string& text) {
  const std::size_t blank = text.find(' '), slash = text.find('/');
  double nominal = 0.0;
  if (blank == std::string::npos || slash == std::string::npos || slash < blank ||
      !parse_number(text.substr(0, blank), nominal))
    throw ValueFault(in_quotes(text), kExpected);
  if (!(nominal > 0.0 && nominal <= 500.0))
    throw ValueFault("a nominal size of " + text.substr(0, blank) + " mm", "more than 0 and at most 500 mm");
  const std::size_t hole = text.find_first_not_of(' ', blank);
  return {text, nominal * 1e-3, zone(text.substr(hole, slash - hole), nominal, true, text),
          zone(text.substr(slash + 1), nominal, false, text)};
}

}  // namespace boresight
