#include "boresight/io/text_lines.hpp"

#include <filesystem>

#include "boresight/mechanism/error.hpp"

namespace boresight {

TextLines::TextLines(const std::string& file) : file_(file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError({file, 0}, "", "no such file", "a file that exists");
  if (std::filesystem::is_directory(status)) throw InputError({file, 0}, "", "a folder", "a file");
  in_.open(file, std::ios::binary);
  if (!in_) throw InputError({file, 0}, "", "a file that cannot be opened", "a file that may be read");
}

bool TextLines::next(std::string& line) {
  line.clear();
  std::streambuf& bytes = *in_.rdbuf();
  int c = bytes.sbumpc();
  if (c == std::char_traits<char>::eof()) return false;
  ++number_;
  for (; c != std::char_traits<char>::eof() && c != '\n'; c = bytes.sbumpc()) {
    ++read_;
    if (c == 0) throw InputError({file_, number_}, "", "a character zero", "a table in plain text");
    if (line.size() == kLongestLine)
      throw InputError({file_, number_}, "", "a line of more than 1 MiB", "a table in plain text");
    line += static_cast<char>(c);
  }
  // The mark that Excel sets before what it writes in UTF-8.
  if (number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
  if (++read_ > kLargestFile) throw InputError({file_, 0}, "", "a file of more than 256 MiB", "a smaller file");
  return true;
}

}  // namespace boresight
