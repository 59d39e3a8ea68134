// What numbers of a mechanism must hold together, whoever gives them: its file, a sample that is drawn, a point of a function.
//
//   if (const auto impossible = impossible_numbers(mechanism.description(), parameters)) ...   // impossible->text()
//
// What a key asks of its own value is in its table (mechanism_keys.hpp), but for the restitution, of which the law decides.
#pragma once

#include <optional>
#include <string>

#include "boresight/mechanism/description.hpp"

namespace boresight {

// Of one clearance. Owner: the numbers that it asks of.
template <typename Owner>
struct NumbersTogether {
  const char* key;  // at fault, within the table that it stands in
  const char* expected;
  bool (*hold)(const Owner&);
};

inline constexpr NumbersTogether<ClearanceParameters> kPlayWithinJournal{
    "radial", "less than journal_radius", [](const ClearanceParameters& p) { return p.radial < p.journal_radius; }};
// Of a joint without caps, whose radius is zero, too.
inline constexpr NumbersTogether<ClearanceParameters> kCapsBeyondBore{
    "cap_radius", "more than journal_radius + radial",
    [](const ClearanceParameters& p) { return p.cap_radius == 0.0 || p.cap_radius > p.journal_radius + p.radial; }};
inline constexpr NumbersTogether<ClearanceParameters> kGapWithinWidth{
    "width_gap", "less than half of width", [](const ClearanceParameters& p) { return p.width_gap < 0.5 * p.width; }};
inline constexpr NumbersTogether<ClearanceParameters> kGapWithinHeight{
    "height_gap", "less than half of height",
    [](const ClearanceParameters& p) { return p.height_gap < 0.5 * p.height; }};
inline constexpr NumbersTogether<FrictionParameters> kSpeedsInOrder{
    "dynamic_speed", "dynamic_speed above static_speed",
    [](const FrictionParameters& p) { return p.dynamic_speed > p.static_speed; }};
inline constexpr NumbersTogether<FrictionParameters> kStictionAboveFriction{
    "static_coefficient", "a number of at least coefficient",
    [](const FrictionParameters& p) { return p.static_coefficient >= p.coefficient; }};

// Of the span of a bearing pair.
inline constexpr char kSleevesApart[] = "at least half of both sleeves' lengths, at which the bearings touch";

// What is expected of a restitution that the law in force does not take: its damping may grow without bound as restitution vanishes.
// dissipation: as ClearanceDescription has it.
std::optional<std::string> refused_restitution(const std::string& law, const std::string& dissipation,
                                               double restitution);

// The first that does not hold, as an InputError has it.
struct ImpossibleNumbers {
  std::string path;             // "clearance.F1.cap_radius"
  std::string found, expected;  // "9 mm with journal_radius = 8 mm, radial = 2 mm"; "more than journal_radius + radial"

  std::string text() const { return path + ": found " + found + ", expected " + expected; }
};

// Where the reader of mechanism files would refuse these numbers for what they are together.
std::optional<ImpossibleNumbers> impossible_numbers(const MechanismDescription& mechanism,
                                                    const Parameters& parameters);

}  // namespace boresight
