// The lines of a file of data, whatever the file is: a table, an endless device, a picture. Nothing is read whole, and what is larger
// than data can be is refused.
//
//   TextLines lines(file);
//   for (std::string line; lines.next(line);) use(line, lines.number());
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace boresight {

class TextLines {
 public:
  static constexpr std::uintmax_t kLargestFile = 256u << 20;  // bytes
  static constexpr std::size_t kLongestLine = 1u << 20;       // bytes

  // Throws InputError, with no line: no such file, a folder, a file that cannot be opened.
  explicit TextLines(const std::string& file);
  // The next line without its end; false at the end of the file. Throws InputError: a line or a file that is too long, a
  // character zero.
  bool next(std::string& line);
  int number() const { return number_; }  // of the line read last, from 1

 private:
  std::string file_;
  std::ifstream in_;
  std::uintmax_t read_ = 0;
  int number_ = 0;
};

}  // namespace boresight
