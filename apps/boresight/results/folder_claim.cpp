#include "results/folder_claim.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace boresight::app {
namespace {

enum class Attempt { taken, held, unsupported };

Attempt lock_folder(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Attempt::taken;
  return errno == EWOULDBLOCK ? Attempt::held : Attempt::unsupported;
}

Attempt lock_file(int descriptor) {
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (::fcntl(descriptor, F_OFD_SETLK, &whole) == 0) return Attempt::taken;
  return errno == EAGAIN || errno == EACCES ? Attempt::held : Attempt::unsupported;
}

// Between opening and locking, the one that held it may have removed the folder, and a third made it again.
bool still_there(int descriptor, const std::filesystem::path& folder) {
  struct stat opened = {}, named = {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(folder.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

std::optional<FolderClaim> FolderClaim::take(const std::filesystem::path& folder) {
  for (;;) {
    FolderClaim claim(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (claim.descriptor_ < 0) return FolderClaim(-1);  // what is wrong with it shows when it is written to
    const Attempt attempt = lock_folder(claim.descriptor_);
    if (attempt == Attempt::held) return std::nullopt;
    if (attempt == Attempt::taken) {
      if (!still_there(claim.descriptor_, folder)) continue;
      return claim;
    }
    FolderClaim in_file(::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (in_file.descriptor_ >= 0 && lock_file(in_file.descriptor_) == Attempt::held) return std::nullopt;
    return in_file;
  }
}

FolderClaim::FolderClaim(FolderClaim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderClaim& FolderClaim::operator=(FolderClaim&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FolderClaim::~FolderClaim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace boresight::app
