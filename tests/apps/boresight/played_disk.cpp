// A disk that is full or may not be written, played to the program under test (LD_PRELOAD): no privilege, no mount, so that the
// tests of it run wherever the others do. $BORESIGHT_DISK is a folder. $BORESIGHT_DISK_ROOM: the bytes by which files in it may
// still grow, all together; then writes end short, and ENOSPC. $BORESIGHT_DISK_READ_ONLY: whatever would change anything in it is
// EROFS. What is unlinked gives no room back. Writes that the C library makes within itself (fwrite) are not seen.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

const std::string& folder() {
  static const char* given = std::getenv("BORESIGHT_DISK");
  static const std::string found = given != nullptr ? given : "";
  return found;
}
bool read_only() {
  static const bool found = std::getenv("BORESIGHT_DISK_READ_ONLY") != nullptr;
  return found;
}
bool has_an_end() {
  static const bool found = std::getenv("BORESIGHT_DISK_ROOM") != nullptr;
  return found;
}
std::atomic<long long>& room() {
  static std::atomic<long long> left = has_an_end() ? std::atoll(std::getenv("BORESIGHT_DISK_ROOM")) : 0;
  return left;
}

bool is_within(const std::string& path) {
  const std::string& f = folder();
  return !f.empty() && path.compare(0, f.size(), f) == 0 && (path.size() == f.size() || path[f.size()] == '/');
}
std::string path_of(int descriptor) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = ::readlink(link, path, sizeof path);
  return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : "";
}
std::string whole(int at, const char* path) {
  if (path[0] == '/') return path;
  if (at != AT_FDCWD) return path_of(at) + "/" + path;
  char here[4096];
  std::string full = ::getcwd(here, sizeof here) != nullptr ? here : "";
  while (std::strncmp(path, "./", 2) == 0) path += 2;
  return std::strcmp(path, ".") == 0 || *path == '\0' ? full : full + "/" + path;
}
bool is_shut(const char* path, int at = AT_FDCWD) {
  if (!read_only() || !is_within(whole(at, path))) return false;
  errno = EROFS;
  return true;
}

template <typename F>
F next(const char* name) {
  return reinterpret_cast<F>(::dlsym(RTLD_NEXT, name));
}

// How many of the bytes [begin, begin + size) of a file there is room for; what the file already holds needs none.
size_t granted(int descriptor, long long begin, size_t size) {
  struct stat now;
  if (!has_an_end() || ::fstat(descriptor, &now) != 0 || !S_ISREG(now.st_mode) || !is_within(path_of(descriptor)))
    return size;
  const long long end = begin + static_cast<long long>(size), grows = end - (now.st_size > begin ? now.st_size : begin);
  if (grows <= 0) return size;
  long long left = room().load();
  for (;;) {
    const long long taken = grows < left ? grows : left;
    if (room().compare_exchange_weak(left, left - taken)) return size - static_cast<size_t>(grows - taken);
  }
}
long long place_of(int descriptor) {
  if ((::fcntl(descriptor, F_GETFL) & O_APPEND) != 0) {
    struct stat now;
    return ::fstat(descriptor, &now) == 0 ? static_cast<long long>(now.st_size) : 0;
  }
  const off_t place = ::lseek(descriptor, 0, SEEK_CUR);
  return place < 0 ? 0 : static_cast<long long>(place);
}
// -1 and ENOSPC where nothing is granted of something.
bool is_full(size_t granted, size_t asked) {
  if (granted > 0 || asked == 0) return false;
  errno = ENOSPC;
  return true;
}
bool changes(int flags) { return (flags & O_ACCMODE) != O_RDONLY || (flags & (O_CREAT | O_TRUNC)) != 0; }

int opened(const char* function, const char* path, int flags, mode_t mode) {
  if (changes(flags) && is_shut(path)) return -1;
  return next<int (*)(const char*, int, ...)>(function)(path, flags, mode);
}
int opened_at(const char* function, int at, const char* path, int flags, mode_t mode) {
  if (changes(flags) && is_shut(path, at)) return -1;
  return next<int (*)(int, const char*, int, ...)>(function)(at, path, flags, mode);
}
mode_t mode_of(int flags, va_list& more) { return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0; }
FILE* opened_stream(const char* function, const char* path, const char* mode) {
  if (std::strpbrk(mode, "wa+") != nullptr && is_shut(path)) return nullptr;
  return next<FILE* (*)(const char*, const char*)>(function)(path, mode);
}
ssize_t written_at(const char* function, int descriptor, const void* bytes, size_t size, off_t place) {
  const size_t some = granted(descriptor, place, size);
  if (is_full(some, size)) return -1;
  return next<ssize_t (*)(int, const void*, size_t, off_t)>(function)(descriptor, bytes, some, place);
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const size_t some = has_an_end() ? granted(descriptor, place_of(descriptor), size) : size;
  if (is_full(some, size)) return -1;
  return next<ssize_t (*)(int, const void*, size_t)>("write")(descriptor, bytes, some);
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t place) {
  return written_at("pwrite", descriptor, bytes, size, place);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off_t place) {
  return written_at("pwrite64", descriptor, bytes, size, place);
}
ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  if (!has_an_end()) return next<ssize_t (*)(int, const struct iovec*, int)>("writev")(descriptor, parts, count);
  ssize_t sum = 0;
  for (int k = 0; k < count; ++k) {  // one after the other: a file has one writer here
    const ssize_t some = write(descriptor, parts[k].iov_base, parts[k].iov_len);
    if (some < 0) return sum > 0 ? sum : -1;
    sum += some;
    if (static_cast<size_t>(some) < parts[k].iov_len) break;
  }
  return sum;
}
ssize_t sendfile(int to, int from, off_t* place, size_t size) {
  struct stat source;
  size_t some = size;
  if (has_an_end() && ::fstat(from, &source) == 0) {
    const size_t rest = static_cast<size_t>(source.st_size - (place != nullptr ? *place : ::lseek(from, 0, SEEK_CUR)));
    some = rest < size ? rest : size;
    const size_t asked = some;
    some = granted(to, place_of(to), some);
    if (is_full(some, asked)) return -1;
  }
  return next<ssize_t (*)(int, int, off_t*, size_t)>("sendfile")(to, from, place, some);
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return opened("open", path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return opened("open64", path, flags, mode);
}
int openat(int at, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return opened_at("openat", at, path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) { return opened_stream("fopen", path, mode); }
FILE* fopen64(const char* path, const char* mode) { return opened_stream("fopen64", path, mode); }

int access(const char* path, int how) noexcept {
  if ((how & W_OK) != 0 && is_shut(path)) return -1;
  return next<int (*)(const char*, int)>("access")(path, how);
}
int mkdir(const char* path, mode_t mode) noexcept {
  struct stat there;
  if (::stat(path, &there) != 0 && is_shut(path)) return -1;  // what is there is EEXIST on a disk of any kind
  return next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}
int rename(const char* from, const char* to) noexcept {
  if (is_shut(from) || is_shut(to)) return -1;
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}
int link(const char* from, const char* to) noexcept {
  if (is_shut(to)) return -1;
  return next<int (*)(const char*, const char*)>("link")(from, to);
}
int symlink(const char* from, const char* to) noexcept {
  if (is_shut(to)) return -1;
  return next<int (*)(const char*, const char*)>("symlink")(from, to);
}
int unlink(const char* path) noexcept {
  struct stat there;
  if (::lstat(path, &there) == 0 && is_shut(path)) return -1;
  return next<int (*)(const char*)>("unlink")(path);
}
int unlinkat(int at, const char* path, int flags) noexcept {
  if (is_shut(path, at)) return -1;
  return next<int (*)(int, const char*, int)>("unlinkat")(at, path, flags);
}
int remove(const char* path) noexcept {
  struct stat there;
  if (::lstat(path, &there) == 0 && is_shut(path)) return -1;
  return next<int (*)(const char*)>("remove")(path);
}
int truncate(const char* path, off_t size) noexcept {
  if (is_shut(path)) return -1;
  return next<int (*)(const char*, off_t)>("truncate")(path, size);
}

}  // extern "C"
