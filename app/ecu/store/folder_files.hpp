// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The files of a store in a folder of the system. No call allocates; each may wait for the disk,
/// so none is for a thread with deadlines.

#include <string>

#include "app/ecu/store/store_files.hpp"
#include "platform/linux/process.hpp"

namespace graben::ecu {

class FolderFiles : public StoreFiles {
 public:
  /// Where a folder that is not there is to be made: only its last part, and only for writing. Who
  /// writes holds the file "lock" in it, so that no other process does: open() fails while one has
  /// it. Where that file cannot be made, it goes without.
  enum class Missing : std::uint8_t { kIsAnError, kIsMade };

  explicit FolderFiles(std::string folder, Missing missing = Missing::kIsMade)
      : folder_(std::move(folder)), missing_(missing) {}
  ~FolderFiles() override;

  /// True if the folder is open; error() says why not. Each other call tries again.
  [[nodiscard]] bool open();
  [[nodiscard]] const std::string& folder() const { return folder_; }

  /// Opens another folder that is there by now: it may have been mounted over, or be gone with its
  /// disk.
  [[nodiscard]] Place look() override;
  [[nodiscard]] long read(const char* name, std::uint8_t* out, std::size_t room) override;
  /// Nothing but a regular file is written to: neither a link nor a pipe of that name.
  [[nodiscard]] bool write(const char* name, const std::uint8_t* bytes, std::size_t count) override;
  [[nodiscard]] bool sync(const char* name) override;
  [[nodiscard]] bool sync_folder() override;
  [[nodiscard]] const char* error() const override { return error_.c_str(); }

 private:
  bool failed(const char* name);
  bool failed(const char* name, const char* why);
  bool file_failed(const char* name);
  int open_file(const char* name, int flags);
  bool lock();

  std::string folder_;
  Missing missing_;
  int descriptor_ = -1;  ///< Of the folder.
  int lock_ = -1;        ///< Of the file that is locked in it.
  int written_ = -1;     ///< Of the file that was written last: it has the errors of that.
  char written_name_[32] = {};
  ErrorText error_;
};

}  // namespace graben::ecu
