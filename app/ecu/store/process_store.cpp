// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/process_store.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "platform/linux/cyclic_clock.hpp"

namespace graben::ecu {
namespace {

constexpr TimeUs kMostWaitUs = kSecondUs;

/// In one call of the system, whatever thread says it; from no heap.
void say_error(const char* line) {
  std::array<char, 400> text{};
  const int count = std::snprintf(text.data(), text.size(), "graben-ecu: %s\n", line);
  if (count > 0) {
    const auto length = std::min(static_cast<std::size_t>(count), text.size() - 1);
    // Nobody is left who could be told.
    static_cast<void>(!::write(STDERR_FILENO, text.data(), length));
  }
}

/// A line that is no error, which the journal is told by a number before it.
void say(const std::string& line) {
  const bool to_journal = std::getenv("JOURNAL_STREAM") != nullptr;
  std::fprintf(stderr, "%sgraben-ecu: %s\n", to_journal ? "<6>" : "", line.c_str());
}

}  // namespace

std::string store_folder(const std::string& told, const char* state_directory) {
  if (!told.empty() || state_directory == nullptr) {
    return told;
  }
  const std::string all = state_directory;
  return all.substr(0, all.find(':'));
}

ProcessStore::ProcessStore(const std::string& folder, std::uint32_t profile_hash, SampleKind kind,
                           bool keeps_ground)
    : files_(folder),
      fault_files_(files_, changes_),
      ground_files_(files_, changes_),
      store_(fault_files_, profile_hash),
      ground_store_(ground_files_, profile_hash),
      keeper_(store_, rings_, kind, &say_error),
      ground_(keeps_ground ? std::make_unique<KeptGround>(
                                 ground_store_, kind == SampleKind::kExcavator, &say_error)
                           : nullptr),
      works_(keeper_, ground_ ? &ground_->keeper : nullptr),
      thread_(works_) {
  const bool is_open = files_.open();
  const std::string found = keeper_.begin(monotonic_now_us(), boot_mark());
  found_ = keeper_.history();
  const std::string line = "store " + folder + ": " + found;
  if (!is_open) {
    say_error((std::string("store: ") + files_.error() +
               "; control goes on, nothing is stored until that has changed")
                  .c_str());
  } else if (found.find("damaged") != std::string::npos) {
    say_error(line.c_str());
  } else {
    say(line);
  }
  if (ground_) {
    ground_->keeper.begin(monotonic_now_us());
  }
  if (const ErrorText error = thread_.start(); !error.empty()) {
    say_error((std::string("store: ") + error.c_str() + "; nothing is stored").c_str());
  }
}

StoreCounters ProcessStore::counters() const {
  return {true,
          keeper_.is_failing(),
          keeper_.writes(),
          keeper_.failures(),
          keeper_.dropped(),
          ground_ ? ground_->keeper.counters() : ground::GroundCounters{}};
}

bool ProcessStore::end() { return thread_.end(kMostWaitUs); }

StoreCounters end_store(std::unique_ptr<ProcessStore> store) {
  if (store == nullptr) {
    return {};
  }
  const bool ended = store->end();
  const StoreCounters counters = store->counters();
  if (!ended) {
    say_error("store: the disk does not answer; what came last may be lost");
    // The thread still works with it.
    static_cast<void>(store.release());
  }
  return counters;
}

}  // namespace graben::ecu
