#include "boresight/mechanism/error.hpp"

#include <algorithm>
#include <vector>

namespace boresight {
namespace {

// One line, whatever the file held: control characters are shown as blanks, long texts are cut in the middle.
std::string on_one_line(const std::string& text, std::size_t longest) {
  std::string line = text;
  if (line.size() > longest) line = line.substr(0, longest - 23) + " ... " + line.substr(line.size() - 18);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return line;
}

std::string compose(const Origin& origin, const std::string& key, const std::string& found, const std::string& expected,
                    const std::string& nearest) {
  std::string line = on_one_line(origin.file, 400);
  if (origin.line > 0) line += ":" + std::to_string(origin.line);
  if (!line.empty()) line += ": ";
  if (!key.empty()) line += on_one_line(key, 200) + ": ";
  line += "found " + on_one_line(found, 200) + ", expected " + on_one_line(expected, 400);
  if (!nearest.empty()) line += "; did you mean " + on_one_line(nearest, 200) + "?";
  return line;
}

}  // namespace

InputError::InputError(const Origin& where, const std::string& which, const std::string& what_was_found,
                       const std::string& what_was_expected, const std::string& nearest_known)
    : std::runtime_error(compose(where, which, what_was_found, what_was_expected, nearest_known)),
      origin(where),
      key(which),
      found(what_was_found),
      expected(what_was_expected),
      nearest(nearest_known) {}

bool same_but_for_capitals(const std::string& a, const std::string& b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return small(x) == small(y); });
}

// Optimal string alignment: characters inserted, removed or replaced, and neighbours swapped, one each; two rows are kept.
// Names longer than 200 characters are compared by their beginnings.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  const std::size_t rows = std::min<std::size_t>(a.size(), 200), columns = std::min<std::size_t>(b.size(), 200);
  std::vector<std::size_t> before(columns + 1), above(columns + 1), row(columns + 1);
  for (std::size_t j = 0; j <= columns; ++j) row[j] = j;
  for (std::size_t i = 1; i <= rows; ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= columns; ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[columns];
}

}  // namespace boresight
