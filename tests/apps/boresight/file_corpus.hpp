// Files that the program reads: the examples, the templates of `boresight new`, and those of every_key/, which together hold every key.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "boresight/io/document.hpp"

namespace boresight::app {

struct CorpusFile {
  std::filesystem::path path;
  std::string kind;  // "mechanism", "study", "posterior"
};
std::vector<CorpusFile> file_corpus();

// Of a file or a text, by what stands in it.
std::string kind_of(const Node& root);
nlohmann::json json_of(const Node& node);

// Reads a mechanism, or a study with the tables of all verbs that it has. Throws InputError.
void read_whole(const std::filesystem::path& file, const std::string& kind);

}  // namespace boresight::app
