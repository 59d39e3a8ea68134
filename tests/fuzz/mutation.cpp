#include "mutation.hpp"

#include <utility>
#include <vector>

namespace boresight {
namespace {

using Span = std::pair<std::size_t, std::size_t>;  // begin, length

std::vector<Span> lines_of(const std::string& text) {
  std::vector<Span> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) end = text.size() - 1;
    lines.emplace_back(begin, end - begin + 1);
    begin = end + 1;
  }
  return lines;
}

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '-' || c == '"';
}

std::vector<Span> tokens_of(const std::string& text) {
  std::vector<Span> tokens;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_word(text[end])) ++end;
    if (end > i) tokens.emplace_back(i, end - i);
    i = end + 1;
  }
  return tokens;
}

// The right-hand sides of KEY = VALUE and the contents of quotation marks.
std::vector<Span> values_of(const std::string& text) {
  std::vector<Span> values;
  for (const auto& [begin, length] : lines_of(text)) {
    const std::string line = text.substr(begin, length);
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos && length > equals + 2)
      values.emplace_back(begin + equals + 2, length - equals - 3);
    for (std::size_t open = line.find('"'); open != std::string::npos;) {
      const std::size_t close = line.find('"', open + 1);
      if (close == std::string::npos) break;
      values.emplace_back(begin + open + 1, close - open - 1);
      open = line.find('"', close + 1);
    }
  }
  return values;
}

std::string repeated(const std::string& part, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += part;
  return text;
}

const std::vector<std::string>& nasty_values() {
  static const std::vector<std::string> values = {"1e999",
                                                  "-1e999",
                                                  "nan",
                                                  "inf",
                                                  "-inf",
                                                  "-1",
                                                  "0",
                                                  "\"\"",
                                                  "",
                                                  "1e308",
                                                  "1e-320",
                                                  "true",
                                                  "[]",
                                                  "{}",
                                                  "[[]]",
                                                  "9223372036854775807",
                                                  "99999999999999999999",
                                                  "\"nan mm\"",
                                                  "\"-1 mm\"",
                                                  "\"0 mm\"",
                                                  "\"1e308 km\"",
                                                  "\"1e300 kg\"",
                                                  "\"1e-300 kg\"",
                                                  "\"5 deg\"",
                                                  "\"%s%n\"",
                                                  "9^9^9^9",
                                                  "1/t",
                                                  "sqrt(t-1)",
                                                  "t^64",
                                                  "((((",
                                                  "exp(exp(exp(9*t)))",
                                                  "2*pi*t",
                                                  "0*t",
                                                  "atan2(t,t)",
                                                  "psi",
                                                  "ground",
                                                  "platform",
                                                  "rod1",
                                                  "A1",
                                                  "free",
                                                  "revolute",
                                                  "spherical",
                                                  "universal",
                                                  "cylindrical",
                                                  "planar",
                                                  "fixed",
                                                  "prismatic",
                                                  "{i}",
                                                  "{i}{i}",
                                                  "clearance",
                                                  "\\u0000",
                                                  "\\n",
                                                  "\xff\xfe",
                                                  "1979-05-27T07:32:00Z",
                                                  "0x7fffffff",
                                                  "1_000",
                                                  "'''",
                                                  "\"\"\"",
                                                  "1 mm",
                                                  "1 kg",
                                                  "0.1 mm",
                                                  "1 N",
                                                  "-0.0 s",
                                                  "1e-9 s",
                                                  "1e9 s"};
  return values;
}

}  // namespace

std::string Mutator::once(std::string text) {
  if (text.empty()) return text;
  switch (below(13)) {
    case 0:
      text[below(text.size())] ^= static_cast<char>(1u << below(8));
      return text;
    case 1:
      text[below(text.size())] = static_cast<char>(below(256));
      return text;
    case 2:
      return text.erase(below(text.size()), 1 + below(below(4) == 0 ? 200 : 4));
    case 3:
      return text.insert(below(text.size()), 1, "[]{}\"'=#\n\\.,"[below(12)]);
    case 4:
      return text.substr(0, below(text.size()));
    case 5: {  // a line lost
      const auto lines = lines_of(text);
      const Span line = lines[below(lines.size())];
      return text.erase(line.first, line.second);
    }
    case 6: {  // a line twice, possibly elsewhere
      const auto lines = lines_of(text);
      const Span line = lines[below(lines.size())], place = lines[below(lines.size())];
      return text.insert(below(2) == 0 ? line.first : place.first, text.substr(line.first, line.second));
    }
    case 7: {  // two tokens swapped
      const auto tokens = tokens_of(text);
      if (tokens.size() < 2) return text;
      Span a = tokens[below(tokens.size())], b = tokens[below(tokens.size())];
      if (a.first > b.first) std::swap(a, b);
      if (a.first == b.first) return text;
      const std::string first = text.substr(a.first, a.second), second = text.substr(b.first, b.second);
      text.replace(b.first, b.second, first);
      return text.replace(a.first, a.second, second);
    }
    case 8:
    case 9: {  // another value
      const auto values = values_of(text);
      if (values.empty()) return text;
      const Span value = values[below(values.size())];
      return text.replace(value.first, value.second, nasty_values()[below(nasty_values().size())]);
    }
    case 10: {  // one value in the place of another
      const auto values = values_of(text);
      if (values.empty()) return text;
      const Span to = values[below(values.size())], from = values[below(values.size())];
      return text.replace(to.first, to.second, text.substr(from.first, from.second));
    }
    case 11: {  // enormous or deeply nested
      const auto values = values_of(text);
      if (values.empty()) return text;
      const Span value = values[below(values.size())];
      const std::size_t size = below(8) == 0 ? 100000 : 300;
      const std::string parts[] = {"x", "[", "{a=", "(", "-", "1+", "sin(", "t*", "9", "\"", "a."};
      return text.replace(value.first, value.second, repeated(parts[below(11)], size));
    }
    default: {  // a key or table header nested too deep, or a table from elsewhere
      const auto lines = lines_of(text);
      const std::size_t place = lines[below(lines.size())].first;
      const std::string parts[] = {"[" + repeated("a.", 20000) + "a]\n",
                                   "[[body]]\n",
                                   "[[pattern]]\ncount = 100000\naxis = \"z\"\n",
                                   "[motion]\n",
                                   "[[clearance]]\njoint = \"F2\"\njournal = \"rod2\"\n",
                                   "[[load]]\n",
                                   "[initial]\nrates = { B1 = \"1 rad/s\" }\n"};
      return text.insert(place, parts[below(7)]);
    }
  }
}

std::string Mutator::mutate(std::string text) {
  for (std::size_t n = 1 + below(4); n > 0; --n) text = once(std::move(text));
  return text;
}

}  // namespace boresight
