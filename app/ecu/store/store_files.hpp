// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The few things that a store does with the files of one folder. On a machine it is FolderFiles;
/// in a test, a disk whose power fails.

#include <cstddef>
#include <cstdint>

namespace graben::ecu {

/// What has become of the place where files are.
enum class Place : std::uint8_t {
  kNone = 0,     ///< It cannot be reached: error() says why.
  kSame = 1,     ///< It is that of the last time.
  kAnother = 2,  ///< It is there for the first time, or another one, with what files it may have.
};

class StoreFiles {
 public:
  StoreFiles() = default;
  virtual ~StoreFiles() = default;
  StoreFiles(const StoreFiles&) = delete;
  StoreFiles& operator=(const StoreFiles&) = delete;

  /// Where the files are now: a disk may come later, or go. To be asked before each row of reads
  /// and writes, which are then all of that place.
  [[nodiscard]] virtual Place look() = 0;
  /// The first bytes of a file, up to `room`. How many; 0: there is no such file; negative: it is
  /// there and cannot be read.
  [[nodiscard]] virtual long read(const char* name, std::uint8_t* out, std::size_t room) = 0;
  /// Writes from the file's begin on, in place, and makes the file where there is none. Until
  /// sync() has returned true, any part of it may be lost with the power.
  [[nodiscard]] virtual bool write(const char* name, const std::uint8_t* bytes,
                                   std::size_t count) = 0;
  /// Waits until what the file holds is on the disk.
  [[nodiscard]] virtual bool sync(const char* name) = 0;
  /// The same of the folder's list of files.
  [[nodiscard]] virtual bool sync_folder() = 0;
  /// Of the last of these that was false: in words.
  [[nodiscard]] virtual const char* error() const = 0;
};

}  // namespace graben::ecu
