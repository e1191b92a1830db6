// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/folder_files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace graben::ecu {
namespace {

constexpr mode_t kFolderMode = 0755;
constexpr mode_t kFileMode = 0644;
/// Whoever may open it may keep us from storing.
constexpr mode_t kLockMode = 0600;
constexpr const char* kLock = "lock";

/// Bytes until the end or an error, which is negative.
long read_all(int file, std::uint8_t* out, std::size_t room) {
  std::size_t count = 0;
  while (count < room) {
    const ssize_t got = ::pread(file, out + count, room - count, static_cast<off_t>(count));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      return got < 0 ? -1 : static_cast<long>(count);
    }
    count += static_cast<std::size_t>(got);
  }
  return static_cast<long>(count);
}

bool write_all(int file, const std::uint8_t* bytes, std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t put = ::pwrite(file, bytes + done, count - done, static_cast<off_t>(done));
    if (put < 0 && errno != EINTR) {
      return false;
    }
    done += put > 0 ? static_cast<std::size_t>(put) : 0;
  }
  return true;
}

/// What stands in a file's place; null if it is one, or nothing.
const char* other_kind(int folder, const char* name) {
  struct stat what {};
  if (::fstatat(folder, name, &what, AT_SYMLINK_NOFOLLOW) != 0 || S_ISREG(what.st_mode)) {
    return nullptr;
  }
  if (S_ISLNK(what.st_mode)) {
    return "is a link, no file";
  }
  if (S_ISDIR(what.st_mode)) {
    return "is a folder, no file";
  }
  return S_ISFIFO(what.st_mode) ? "is a pipe, no file" : "is no regular file";
}

void close_one(int& file) {
  if (file >= 0) {
    ::close(file);
    file = -1;
  }
}

}  // namespace

FolderFiles::~FolderFiles() {
  close_one(written_);
  close_one(lock_);
  close_one(descriptor_);
}

bool FolderFiles::failed(const char* name) { return failed(name, error_words(errno)); }

bool FolderFiles::failed(const char* name, const char* why) {
  error_.set("%s%s%s: %s", folder_.c_str(), name[0] == '\0' ? "" : "/", name, why);
  return false;
}

bool FolderFiles::lock() {
  if (missing_ == Missing::kIsAnError || lock_ >= 0) {
    return true;
  }
  lock_ = ::openat(descriptor_, kLock, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK,
                   kLockMode);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close_one(lock_);
    return failed(kLock, "another process stores there");
  }
  return true;
}

bool FolderFiles::open() {
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
  if (descriptor_ < 0) {
    descriptor_ = ::open(folder_.c_str(), kFlags);
  }
  if (descriptor_ < 0 && errno == ENOENT && missing_ == Missing::kIsMade &&
      ::mkdir(folder_.c_str(), kFolderMode) == 0) {
    descriptor_ = ::open(folder_.c_str(), kFlags);
  }
  if (descriptor_ < 0) {
    return failed("");
  }
  if (!lock()) {
    close_one(descriptor_);
    return false;
  }
  return true;
}

Place FolderFiles::look() {
  if (descriptor_ < 0) {
    return open() ? Place::kAnother : Place::kNone;
  }
  struct stat was {};
  struct stat is {};
  // As long as it is open, no other folder can have its number.
  if (::fstat(descriptor_, &was) == 0 && ::stat(folder_.c_str(), &is) == 0 &&
      was.st_dev == is.st_dev && was.st_ino == is.st_ino) {
    return Place::kSame;
  }
  close_one(written_);
  close_one(lock_);
  close_one(descriptor_);
  return open() ? Place::kAnother : Place::kNone;
}

bool FolderFiles::file_failed(const char* name) {
  const int error = errno;
  const char* const other = other_kind(descriptor_, name);
  return failed(name, other != nullptr ? other : error_words(error));
}

int FolderFiles::open_file(const char* name, int flags) {
  // A pipe would wait for its other end.
  const int file =
      ::openat(descriptor_, name, flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, kFileMode);
  struct stat what {};
  if (file >= 0 && (::fstat(file, &what) != 0 || !S_ISREG(what.st_mode))) {
    ::close(file);
    errno = EINVAL;
    return -1;
  }
  return file;
}

long FolderFiles::read(const char* name, std::uint8_t* out, std::size_t room) {
  if (!open()) {
    return errno == ENOENT ? 0 : -1;
  }
  const int file = open_file(name, O_RDONLY);
  if (file < 0) {
    const bool is_absent = errno == ENOENT;
    return is_absent || file_failed(name) ? 0 : -1;
  }
  const long count = read_all(file, out, room);
  if (count < 0) {
    static_cast<void>(file_failed(name));
  }
  ::close(file);
  return count;
}

bool FolderFiles::write(const char* name, const std::uint8_t* bytes, std::size_t count) {
  if (!open()) {
    return false;
  }
  close_one(written_);
  written_ = open_file(name, O_WRONLY | O_CREAT);
  if (written_ < 0 || !write_all(written_, bytes, count)) {
    const bool result = file_failed(name);
    close_one(written_);
    return result;
  }
  static_cast<void>(std::snprintf(written_name_, sizeof written_name_, "%s", name));
  return true;
}

bool FolderFiles::sync(const char* name) {
  if (!open()) {
    return false;
  }
  const bool is_open = written_ >= 0 && std::strcmp(written_name_, name) == 0;
  const int file = is_open ? written_ : open_file(name, O_RDONLY);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const bool result = done || file_failed(name);
  if (is_open) {
    close_one(written_);
  } else if (file >= 0) {
    ::close(file);
  }
  return result;
}

bool FolderFiles::sync_folder() { return open() && (::fsync(descriptor_) == 0 || failed("")); }

}  // namespace graben::ecu
