// A folder that one process at a time writes results in.
//
// The claim is a lock that the system holds for the process: it ends with the process, however that ends, so that nothing
// is left to clear away after a kill. It stands on the folder itself; where a file system locks no folders (NFS), on a
// hidden file in it; where it knows no locks at all, nothing is claimed.
#pragma once

#include <filesystem>
#include <optional>

namespace boresight::app {

class FolderClaim {
 public:
  // The folder must exist. Returns nothing where another process, or another claim of this one, holds it.
  static std::optional<FolderClaim> take(const std::filesystem::path& folder);

  FolderClaim(FolderClaim&& other) noexcept;
  FolderClaim& operator=(FolderClaim&& other) noexcept;
  ~FolderClaim();

 private:
  explicit FolderClaim(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace boresight::app
