// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A disk in memory under a store, whose power can fail at any operation: what was written and not
/// synced is then lost, halved or there, sector by sector and in no order, and so is each file's
/// name.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "app/ecu/store/store_files.hpp"

namespace graben::test {

class MemoryDisk : public ecu::StoreFiles {
 public:
  using Bytes = std::vector<std::uint8_t>;
  static constexpr std::size_t kSector = 512;

  ecu::Place look() override {
    const bool was_there = was_there_;
    was_there_ = is_there;
    return !is_there ? ecu::Place::kNone : was_there ? ecu::Place::kSame : ecu::Place::kAnother;
  }
  long read(const char* name, std::uint8_t* out, std::size_t room) override {
    const auto found = is_there ? seen_.find(name) : seen_.end();
    if (found == seen_.end()) {
      return 0;
    }
    const std::size_t count = std::min(room, found->second.size());
    std::copy_n(found->second.begin(), count, out);
    return static_cast<long>(count);
  }
  bool write(const char* name, const std::uint8_t* bytes, std::size_t count) override {
    if (is_off() || is_full || !is_there || (takes_no_new && seen_.count(name) == 0)) {
      return false;
    }
    writes += 1;
    put(seen_[name], 0, {bytes, bytes + count});
    for (std::size_t at = 0; at < count; at += kSector) {
      pending_.push_back({name, at, {bytes + at, bytes + std::min(at + kSector, count)}});
    }
    return true;
  }
  bool sync(const char* name) override {
    if (is_off() || is_full || never_syncs) {
      return false;
    }
    std::vector<Pending> rest;
    for (const Pending& one : pending_) {
      if (one.name == name) {
        put(disk_[name], one.at, one.bytes);
      } else {
        rest.push_back(one);
      }
    }
    pending_ = rest;
    return true;
  }
  bool sync_folder() override {
    if (is_off()) {
      return false;
    }
    for (const auto& [name, bytes] : seen_) {
      listed_.insert(name);
    }
    return true;
  }
  const char* error() const override { return "memory: No space left on device"; }

  /// The power fails at the `operations`th one from now on.
  void fail_after(int operations) { left_ = operations; }
  /// What a disk has after that, in one of the ways that it can.
  void power_on(std::mt19937& random) {
    const auto drawn = [&](unsigned below) { return static_cast<unsigned>(random() % below); };
    std::shuffle(pending_.begin(), pending_.end(), random);
    for (Pending& one : pending_) {
      const unsigned fate = drawn(3);
      if (fate == 1) {
        one.bytes.resize(drawn(static_cast<unsigned>(one.bytes.size())));
      }
      if (fate != 0) {
        put(disk_[one.name], one.at, one.bytes);
      }
    }
    for (auto at = disk_.begin(); at != disk_.end();) {
      const bool kept = listed_.count(at->first) != 0 || drawn(2) == 0;
      at = kept ? std::next(at) : disk_.erase(at);
    }
    for (const auto& [name, bytes] : disk_) {
      listed_.insert(name);
    }
    pending_.clear();
    seen_ = disk_;
    left_ = -1;
  }

  /// A file as a process sees it.
  Bytes& file(const std::string& name) { return seen_[name]; }
  [[nodiscard]] std::size_t files() const { return seen_.size(); }
  bool is_full = false;
  bool is_there = true;
  bool takes_no_new = false;  ///< Files, for which there is no room.
  bool never_syncs = false;
  int writes = 0;

 private:
  struct Pending {
    std::string name;
    std::size_t at;
    Bytes bytes;
  };
  static void put(Bytes& to, std::size_t at, const Bytes& bytes) {
    to.resize(std::max(to.size(), at + bytes.size()));
    std::copy(bytes.begin(), bytes.end(), to.begin() + static_cast<std::ptrdiff_t>(at));
  }
  bool is_off() {
    left_ -= left_ > 0 ? 1 : 0;
    return left_ == 0;
  }

  std::map<std::string, Bytes> seen_;  ///< By processes: what the disk will have.
  std::map<std::string, Bytes> disk_;
  std::set<std::string> listed_;  ///< Names that are on the disk.
  std::vector<Pending> pending_;
  bool was_there_ = false;
  int left_ = -1;  ///< Operations until the power fails; negative: it does not.
};

}  // namespace graben::test
