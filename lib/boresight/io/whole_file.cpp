#include "boresight/io/whole_file.hpp"

#include <filesystem>
#include <fstream>

#include "boresight/mechanism/error.hpp"

namespace boresight {

std::string read_whole_file(const std::string& path) {
  std::error_code error;
  const Origin origin{path, 0};
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(origin, "", "no such file", "a file that exists");
  if (std::filesystem::is_directory(status)) throw InputError(origin, "", "a folder", "a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(origin, "", "a file that cannot be opened", "a file that may be read");
  std::string bytes;
  std::string block(1u << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    bytes.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kLargestText) throw InputError(origin, "", "a file of more than 16 MiB", "a smaller file");
  }
  return bytes;
}

}  // namespace boresight
