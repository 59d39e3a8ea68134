// Files that others wrote, as Debian's packages bring them: each is imported, checked and run for a moment, or refused in one line.
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "apps/boresight/program.hpp"

namespace boresight::app {
namespace others_files_test {

namespace fs = std::filesystem;

std::string unpacked(const fs::path& file) {  // zlib reads what is not packed as it is
  std::string bytes, block(1 << 16, '\0');
  const gzFile in = gzopen(file.c_str(), "rb");
  for (int n; in != nullptr && (n = gzread(in, block.data(), static_cast<unsigned>(block.size()))) > 0;)
    bytes.append(block, 0, n);
  if (in != nullptr) gzclose(in);
  return bytes;
}

class OthersFiles : public Program {
 protected:
  // The files below a folder whose text holds one of these roots; of packed ones, copies.
  std::vector<fs::path> found(const fs::path& from, const std::vector<std::string>& roots) const {
    std::vector<fs::path> files;
    if (!fs::exists(from)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(from)) {
      fs::path name = entry.path();
      if (!entry.is_regular_file()) continue;
      if (name.extension() == ".gz") name = name.parent_path() / name.stem();
      static const std::set<std::string> kKinds = {".urdf", ".sdf", ".world", ".xml"};
      if (kKinds.count(name.extension().string()) == 0) continue;
      const std::string text = unpacked(entry.path());
      if (std::none_of(roots.begin(), roots.end(),
                       [&](const std::string& root) { return text.find(root) != std::string::npos; }))
        continue;
      if (name == entry.path()) {
        files.push_back(name);
        continue;
      }
      files.push_back(folder_ / (std::to_string(files.size()) + "-" + name.filename().string()));
      std::ofstream(files.back(), std::ios::binary) << text;
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  // Whether this machine's packages come without their documentation, of which such files are a part.
  static bool keeps_no_documentation() {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator("/etc/dpkg/dpkg.cfg.d", none)) {
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);)
        if (line.starts_with("path-exclude") && line.find("/usr/share/doc") != std::string::npos) return true;
    }
    return false;
  }

  void expect_imported_or_refused(const std::vector<fs::path>& files, std::size_t least_imported) {
    std::size_t imported = 0;
    for (const fs::path& file : files) {
      SCOPED_TRACE(file.string());
      const std::string to = std::to_string(imported) + ".toml";
      const Ended import = call({"import", file.string(), "--to", to, "--quiet"});
      if (import.status != 0) {
        EXPECT_EQ(import.status, 2) << import.err;
        EXPECT_TRUE(is_one_line(import.err)) << import.err;
        std::cout << "refused: " << import.err;
        continue;
      }
      ++imported;
      const Ended check = call({"check", to, "--out", "check-" + to, "--set", "motion.duration=2ms"});
      EXPECT_TRUE(check.status == 0 || check.status == 1) << check.status << check.err;
      const Ended run = call({"run", to, "--out", "run-" + to, "--set", "motion.duration=2ms"});
      EXPECT_TRUE(run.status == 0 || (run.status == 2 && is_one_line(run.err))) << run.status << run.err;
      std::cout << "imported: " << file.filename().string() << ", run: " << (run.status == 0 ? "done\n" : run.err);
    }
    std::cout << imported << " of " << files.size() << " imported\n";
    EXPECT_GE(imported, least_imported);
  }
};

// How many there are is what the packages of Debian 12 hold: what stands still, has no mass in it or lacks a part is refused.
TEST_F(OthersFiles, LongOfDartsExamples) {
  const auto files = found("/usr/share/doc/dart/data", {"<robot", "<sdf"});
  if (files.empty() && keeps_no_documentation()) return;
  ASSERT_FALSE(files.empty()) << "Debian's dart-doc is not installed";
  expect_imported_or_refused(files, 15);
}

#ifdef BORESIGHT_HAS_MUJOCO
TEST_F(OthersFiles, LongOfMuJoCosModels) {
  const auto files = found("/usr/share/mujoco/model", {"<mujoco"});
  ASSERT_FALSE(files.empty()) << "Debian's libmujoco-samples is not installed";
  expect_imported_or_refused(files, 12);
}
#endif

TEST_F(OthersFiles, LongOfSimbodysExamples) {
  const auto files = found("/usr/share/doc/simbody/examples", {"<robot", "<sdf"});
  if (files.empty() && keeps_no_documentation()) return;
  ASSERT_FALSE(files.empty()) << "Debian's libsimbody-dev is not installed";
  expect_imported_or_refused(files, 5);
}

}  // namespace others_files_test
}  // namespace boresight::app
