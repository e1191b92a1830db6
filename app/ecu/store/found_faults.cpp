// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/found_faults.hpp"

#include <cstdio>

namespace graben::ecu {
namespace {

const char* state_words(ReadState state) {
  switch (state) {
    case ReadState::kRead:
      return "read";
    case ReadState::kNothing:
      return "new, nothing was there";
    case ReadState::kOtherProfile:
      return "new, what was there is of another profile";
    case ReadState::kOtherVersion:
      return "new, what was there is of another format";
    case ReadState::kDamaged:
      break;
  }
  return "new, what was there is damaged";
}

RecordKey key_of(int number) {
  return number == 0 ? kHistoryKey : frame_key(static_cast<Fault>(number));
}

}  // namespace

void find_faults(Store& store, FoundFaults& found, StoredFrame& frame) {
  found = {};
  const Store::Read history = store.read(kHistoryKey);
  found.read[0] = history;
  found.state = history.state;
  if (history.payload != nullptr) {
    found.is_whole = read_history(history.payload, history.length, found.history);
    found.checksum = crc32(history.payload, history.length);
    found.state = found.is_whole ? found.state : ReadState::kDamaged;
  }
  for (int number = 1; number < kFaultCount; ++number) {
    const auto fault = static_cast<Fault>(number);
    const Store::Read one = store.read(frame_key(fault));
    found.read[static_cast<std::size_t>(number)] = one;
    found.foreign_frames += one.state == ReadState::kOtherProfile ? 1 : 0;
    if (one.state == ReadState::kRead && read_frame(one.payload, one.length, frame)) {
      found.framed.add(fault);
      found.framed_s[static_cast<std::size_t>(number)] = frame.operation_s;
    }
  }
}

int FoundFaults::frames(const FaultHistory& now) const {
  int count = 0;
  for (Fault fault = framed.first(); fault != Fault::kNone; fault = framed.after(fault)) {
    count += now.of(fault).covers(framed_s[static_cast<std::size_t>(fault)]) ? 1 : 0;
  }
  return count;
}

int FoundFaults::damaged() const {
  int count = 0;
  for (const Store::Read& one : read) {
    count += (one.is_damaged[0] ? 1 : 0) + (one.is_damaged[1] ? 1 : 0);
  }
  return count;
}

std::string FoundFaults::damaged_words() const {
  std::string words;
  for (int number = 0; number < kFaultCount; ++number) {
    const Store::Read& one = read[static_cast<std::size_t>(number)];
    for (unsigned copy = 0; copy < one.is_damaged.size(); ++copy) {
      if (one.is_damaged[copy]) {
        words += (words.empty() ? "; damaged: " : ", ") +
                 std::string(file_name(key_of(number), copy).data());
        words += one.payload != nullptr ? " (the other copy counts)" : "";
      }
    }
  }
  return words;
}

FoundLine found_words(const FoundFaults& found, const FaultHistory& now) {
  std::array<char, 48> foreign{};
  if (found.foreign_frames > 0) {
    static_cast<void>(std::snprintf(foreign.data(), foreign.size(),
                                    "; freeze frames of another profile: %d",
                                    found.foreign_frames));
  }
  FoundLine line{};
  static_cast<void>(std::snprintf(
      line.data(), line.size(),
      "%s; power cycle %u, %u h of operation, faults stored: %d, freeze frames: %d%s; "
      "what was learnt: %s",
      state_words(found.state), now.power_cycles, now.operation_s / 3600U, now.stored(),
      found.frames(now), foreign.data(), now.learnt.count > 0 ? "read" : "new"));
  return line;
}

}  // namespace graben::ecu
