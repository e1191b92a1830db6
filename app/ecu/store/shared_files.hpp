// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One place for several stores of a thread: each is told once that it is another one.

#include <cstdint>

#include "app/ecu/store/store_files.hpp"

namespace graben::ecu {

class SharedFiles : public StoreFiles {
 public:
  /// How often the place has been another one; of all that share it.
  struct Changes {
    std::uint32_t count = 0;
  };

  /// Both outlive it.
  SharedFiles(StoreFiles& files, Changes& changes) : files_(files), changes_(changes) {}

  [[nodiscard]] Place look() override {
    const Place place = files_.look();
    changes_.count += place == Place::kAnother ? 1 : 0;
    if (place == Place::kNone) {
      return place;
    }
    const bool is_another = seen_ != changes_.count;
    seen_ = changes_.count;
    return is_another ? Place::kAnother : Place::kSame;
  }
  [[nodiscard]] long read(const char* name, std::uint8_t* out, std::size_t room) override {
    return files_.read(name, out, room);
  }
  [[nodiscard]] bool write(const char* name, const std::uint8_t* bytes,
                           std::size_t count) override {
    return files_.write(name, bytes, count);
  }
  [[nodiscard]] bool sync(const char* name) override { return files_.sync(name); }
  [[nodiscard]] bool sync_folder() override { return files_.sync_folder(); }
  [[nodiscard]] const char* error() const override { return files_.error(); }

 private:
  StoreFiles& files_;
  Changes& changes_;
  std::uint32_t seen_ = 0;
};

}  // namespace graben::ecu
