// Calls the program itself, as a user does, in a folder of the test's own.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace boresight::app {

struct Ended {
  int status = -1;  // 128 + signal where one ended it
  std::string out, err;
};

// A disk under one of the test's folders as played_disk.cpp plays it to the program: it needs no privilege and no mount.
struct PlayedDisk {
  std::string folder;
  std::optional<std::uintmax_t> room;  // bytes by which its files may grow, all together
  bool read_only = false;
};

class Program : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  // Starts it in the folder with its output going to files there. `limit`: the largest file it may write, 0
  // for any.
  pid_t start(const std::vector<std::string>& arguments, std::size_t limit = 0, const PlayedDisk& disk = {}) const;
  Ended wait_for(pid_t child) const;
  Ended call(const std::vector<std::string>& arguments, const PlayedDisk& disk) const {
    return wait_for(start(arguments, 0, disk));
  }
  Ended call(const std::vector<std::string>& arguments, std::size_t limit = 0) const {
    return wait_for(start(arguments, limit));
  }

  // A file in the folder.
  void write(const std::string& name, const std::string& content) const;
  std::string text(const std::string& name) const;
  nlohmann::json json(const std::string& name) const;
  // Everything in a folder below, hidden files included.
  std::vector<std::string> files(const std::string& folder) const;

  std::filesystem::path folder_;
  const std::string mechanism_ = BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml";
};

// One line, ended by its newline, and no more.
bool is_one_line(const std::string& text);

}  // namespace boresight::app
