#include "boresight_analyses/study/legal_corners.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "boresight/keys/units.hpp"

namespace boresight {
namespace {

std::string set_to(const BoxSide& side, double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return side.si_unit == "1" ? std::string(text) : text + (" " + side.si_unit);
}

std::vector<Setting> settings_of(const BoxSide& side, double value) {
  std::vector<Setting> settings;
  for (const std::string& path : side.paths) settings.push_back({path, set_to(side, value)});
  return settings;
}

std::string as_written(const BoxSide& side, double value) {
  const std::string unit = side.unit.empty() && side.si_unit != "1" ? side.si_unit : side.unit;
  char text[80];
  if (unit.empty())
    std::snprintf(text, sizeof text, "%.6g", value);
  else
    std::snprintf(text, sizeof text, "%.6g %s", value / scale_of_unit(unit, unit_called(side.si_unit, true)),
                  unit.c_str());
  return text;
}

// What the reader found, as the user wrote it.
std::string found_as_written(const std::string& found, const BoxSide& side, double value) {
  return found == in_quotes(set_to(side, value)) ? in_quotes(as_written(side, value)) : found;
}

void check_alone(const BoxSide& side, const AcceptsSetting& accepts) {
  for (const bool largest : {false, true}) {
    const double value = largest ? side.largest : side.least;
    for (const Setting& setting : settings_of(side, value)) try {
        accepts(setting);
      } catch (const InputError& error) {
        throw InputError(largest ? side.largest_at : side.least_at, setting.path,
                         found_as_written(error.found, side, value), error.expected, error.nearest);
      }
  }
}

// Parameters that a reader may ask something of together: those of one section of the file.
class Section {
 public:
  Section(const AcceptsSetting& accepts, const AcceptsSettings& accepts_all)
      : accepts_(accepts), accepts_all_(accepts_all) {}

  void add(const BoxSide& side) { sides_.push_back(&side); }

  void check() const {
    // Of so many numbers each by itself: their corners would take longer to read than the study takes.
    constexpr std::size_t kMostSides = 8;
    if (sides_.size() > kMostSides) {
      for (const BoxSide* side : sides_) check_alone(*side, accepts_);
      return;
    }
    for (std::size_t corner = 0; corner < corners(); ++corner)
      if (const std::optional<InputError> error = fault(corner)) refuse(corner, *error);
  }

 private:
  std::size_t corners() const { return std::size_t{1} << sides_.size(); }
  double value(std::size_t corner, std::size_t i) const {
    return (corner >> i) & 1 ? sides_[i]->largest : sides_[i]->least;
  }
  // A side of one value has one end.
  bool is_repeated(std::size_t corner) const {
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (((corner >> i) & 1) && sides_[i]->least == sides_[i]->largest) return true;
    return false;
  }

  std::optional<InputError> fault(std::size_t corner) const {
    if (is_repeated(corner)) return {};
    std::vector<Setting> settings;
    for (std::size_t i = 0; i < sides_.size(); ++i)
      for (Setting& setting : settings_of(*sides_[i], value(corner, i))) settings.push_back(std::move(setting));
    try {
      accepts_all_(settings);
    } catch (const InputError& error) {
      return error;
    }
    return {};
  }

  // Whether the side's value at this corner is refused whatever the others are.
  bool is_at_fault_alone(std::size_t corner, std::size_t i) const {
    for (std::size_t other = 0; other < corners(); ++other)
      if (value(other, i) == value(corner, i) && !is_repeated(other) && !fault(other)) return false;
    return true;
  }

  [[noreturn]] void refuse(std::size_t corner, const InputError& error) const {
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (is_at_fault_alone(corner, i)) check_alone(*sides_[i], accepts_);
    std::string point, found = error.found;
    Origin origin = corner & 1 ? sides_[0]->largest_at : sides_[0]->least_at;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const BoxSide& side = *sides_[i];
      point += (point.empty() ? "" : ", ") + side.paths.front() + " = " + as_written(side, value(corner, i));
      if (std::find(side.paths.begin(), side.paths.end(), error.key) == side.paths.end()) continue;
      origin = (corner >> i) & 1 ? side.largest_at : side.least_at;
      found = found_as_written(found, side, value(corner, i));
    }
    throw InputError(origin, error.key, found + " at the point " + point, error.expected, error.nearest);
  }

  const AcceptsSetting& accepts_;
  const AcceptsSettings& accepts_all_;
  std::vector<const BoxSide*> sides_;
};

}  // namespace

void check_corners(const std::vector<BoxSide>& sides, const AcceptsSetting& accepts,
                   const AcceptsSettings& accepts_all) {
  if (!accepts_all) {
    for (const BoxSide& side : sides) check_alone(side, accepts);
    return;
  }
  std::map<std::string, Section> sections;
  for (const BoxSide& side : sides) {
    const std::string name = side.paths.front().substr(0, side.paths.front().find('.'));
    sections.try_emplace(name, accepts, accepts_all).first->second.add(side);
  }
  for (const auto& [name, section] : sections) section.check();
}

}  // namespace boresight
