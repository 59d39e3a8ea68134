#include "documented_commands.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace boresight::app {
namespace {

namespace fs = std::filesystem;
const fs::path kSource = BORESIGHT_SOURCE;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + " cannot be read");
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Without comment, blanks made one.
std::string plain(const std::string& line) {
  std::string text = line.substr(0, line.find(" #"));
  text = std::regex_replace(text, std::regex(" +"), " ");
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

// Lines of code of a page: fenced, or indented by four.
std::vector<std::string> code_of(const fs::path& page) {
  std::vector<std::string> code;
  bool fenced = false;
  for (const std::string& line : lines_of(page)) {
    if (line.starts_with("```")) {
      fenced = !fenced;
    } else if (fenced || line.starts_with("    ")) {
      code.push_back(plain(line));
    }
  }
  return code;
}

// Comments at the head of a file, continued lines joined.
std::vector<std::string> comments_of(const fs::path& file) {
  std::vector<std::string> comments;
  bool open = false;
  for (std::string line : lines_of(file)) {
    if (!line.starts_with('#')) break;
    line.erase(0, 1);
    const bool continues = line.ends_with('\\');
    if (continues) line.pop_back();
    line = plain(line);
    if (open) {
      comments.back() += " " + line;
    } else {
      comments.push_back(line);
    }
    open = continues;
  }
  return comments;
}

}  // namespace

std::vector<DocumentedCommand> documented_commands() {
  std::vector<DocumentedCommand> commands;
  const auto take = [&](const fs::path& document, const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
      if (line.starts_with("boresight ") && !std::regex_search(line, std::regex(" [A-Z]{4,}( |$)")))
        commands.push_back({fs::relative(document, kSource), line});
  };
  for (const char* page : {"README.md", "lib/README.md", "tests/README.md"})
    take(kSource / page, code_of(kSource / page));
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "examples")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    if (file.extension() == ".md") take(file, code_of(file));
    if (file.extension() == ".toml") take(file, comments_of(file));
  }
  std::vector<std::string> start;
  for (const std::string& line : lines_of(kSource / ".ci/start"))
    if (line.starts_with("\"$boresight\" ")) start.push_back("boresight " + line.substr(13));
  take(kSource / ".ci/start", start);
  return commands;
}

std::set<std::string> other_documented_commands() {
  std::set<std::string> commands;
  for (const std::string& line : code_of(kSource / "README.md"))
    if (std::regex_search(line, std::regex("^(bash|cmake|ninja|ctest|build/|mpirun|python3) *"))) commands.insert(line);
  return commands;
}

std::vector<std::string> shell_words(const std::string& command) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  bool inside = false;
  for (const char c : command) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '"' || c == '\'') {
      quote = c;
      inside = true;
    } else if (c == ' ') {
      if (inside) words.push_back(word);
      word.clear();
      inside = false;
    } else {
      word += c;
      inside = true;
    }
  }
  if (inside) words.push_back(word);
  return words;
}

}  // namespace boresight::app
