// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The store of a running controller: its folder, what it keeps, its thread.

#include <cstdint>
#include <memory>
#include <string>

#include "app/ecu/ground/ground_keeper.hpp"
#include "app/ecu/store/fault_keeper.hpp"
#include "app/ecu/store/fault_recorder.hpp"
#include "app/ecu/store/folder_files.hpp"
#include "app/ecu/store/shared_files.hpp"
#include "app/ecu/store/store.hpp"
#include "app/ecu/store/store_thread.hpp"

namespace graben::ecu {

/// For the statistics.
struct StoreCounters {
  bool is_there = false;       ///< The process has a store.
  bool failed = false;         ///< What was to be written last was not.
  std::uint32_t writes = 0;    ///< Records.
  std::uint32_t failures = 0;  ///< Writes that failed.
  std::uint32_t dropped = 0;   ///< Events and freeze frames for which the queue had no room.
  ground::GroundCounters ground;
};

/// The ground as the edge has left it, and the way to its keeper: 1.6 MB, all of it locked.
struct KeptGround {
  /// `store` outlives it.
  KeptGround(Store& store, bool by_force, ground::GroundKeeper::Say say)
      : keeper(store, edges, by_force, say) {}

  ground::EdgeRing edges;
  ground::GroundKeeper keeper;
};

/// A store's rows of work: faults first.
class StoreWorks : public StoreWork {
 public:
  /// Both outlive it. Null: no ground is kept.
  StoreWorks(StoreWork& first, StoreWork* second) : first_(first), second_(second) {}
  void work(TimeUs now_us, std::uint32_t unix_s) override {
    first_.work(now_us, unix_s);
    if (second_ != nullptr) {
      second_->work(now_us, unix_s);
    }
  }
  void finish(TimeUs now_us, std::uint32_t unix_s) override {
    first_.finish(now_us, unix_s);
    if (second_ != nullptr) {
      second_->finish(now_us, unix_s);
    }
  }

 private:
  StoreWork& first_;
  StoreWork* second_;
};

/// The folder of `--store`; else that of $STATE_DIRECTORY, the first if it has several; else "".
[[nodiscard]] std::string store_folder(const std::string& told, const char* state_directory);

class ProcessStore {
 public:
  /// Reads what is there and says it in one line on standard error; begins the thread. To be called
  /// before memory is locked. Whatever is wrong with folder or disk is said, and is no reason not
  /// to start. `keeps_ground`: see KeptGround.
  ProcessStore(const std::string& folder, std::uint32_t profile_hash, SampleKind kind,
               bool keeps_ground);

  /// To the store's thread, for the recorder.
  [[nodiscard]] FaultRings& rings() { return rings_; }
  /// To the store's thread, where the edge has been; null where no ground is kept.
  [[nodiscard]] ground::EdgeRing* edges() { return ground_ ? &ground_->edges : nullptr; }
  /// As it was read.
  [[nodiscard]] const FaultHistory& found() const { return found_; }

  [[nodiscard]] StoreCounters counters() const;

  /// Writes what is left and ends the thread.
  [[nodiscard]] bool end();

 private:
  FolderFiles files_;
  SharedFiles::Changes changes_;
  SharedFiles fault_files_;
  SharedFiles ground_files_;
  Store store_;
  Store ground_store_;
  FaultRings rings_;
  FaultKeeper keeper_;
  std::unique_ptr<KeptGround> ground_;
  StoreWorks works_;
  FaultHistory found_;
  StoreThread thread_;
};

/// Ends a store, null if there is none, and returns its counters. Where a disk keeps its thread for
/// longer than a second, that is said, and the thread left to the end of the process.
[[nodiscard]] StoreCounters end_store(std::unique_ptr<ProcessStore> store);

}  // namespace graben::ecu
