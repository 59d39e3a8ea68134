#include "command_line/option_range.hpp"

#include <charconv>

#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "command_line/command.hpp"

namespace boresight::app {

double positive_quantity(const std::string& option, const std::string& text, const SiUnit& unit) {
  double value = 0.0;
  try {
    value = parse_quantity(text, unit);
  } catch (const ValueFault& fault) {
    throw InputError(kCommandLine, option, fault.found, fault.expected, fault.nearest);
  }
  if (value <= 0.0) throw InputError(kCommandLine, option, in_quotes(text), "more than 0");
  return value;
}

double quantity_between(const std::string& option, const std::string& text, const PhysicalRange& range) {
  const double value = positive_quantity(option, text, range.unit);
  if (!holds(range, value)) throw InputError(kCommandLine, option, in_quotes(text), in_words(range));
  return value;
}

std::uint64_t whole_number(const std::string& option, const std::string& text, std::uint64_t least,
                           std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size() || value < least || value > most)
    throw InputError(kCommandLine, option, in_quotes(text),
                     "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return value;
}

}  // namespace boresight::app
