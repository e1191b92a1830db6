// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/stored_faults.hpp"

#include "app/ecu/store/store.hpp"

namespace graben::ecu {
namespace {

FoundRecord find(StoreFiles& files, RecordKey key, RecordBytes& record, StoredFaults& result) {
  const FoundRecord found = find_record(files, key, record);
  for (unsigned copy = 0; copy < 2; ++copy) {
    const CopyState state = found.copy[copy];
    if (state == CopyState::kDamaged) {
      result.damaged.emplace_back(file_name(key, copy).data());
    } else if (state == CopyState::kOtherVersion) {
      result.other_format.emplace_back(file_name(key, copy).data());
    } else if (state == CopyState::kUnreadable) {
      // Once more: the error is that of the last file.
      std::uint8_t byte = 0;
      const FileName name = file_name(key, copy);
      result.unreadable.emplace_back(files.read(name.data(), &byte, 1) < 0 ? files.error()
                                                                           : name.data());
    }
  }
  return found;
}

void not_of_use(RecordKey key, int copy, StoredFaults& result) {
  result.damaged.emplace_back(file_name(key, static_cast<unsigned>(copy)).data());
}

}  // namespace

StoredFaults read_stored_faults(StoreFiles& files) {
  StoredFaults result;
  RecordBytes record{};
  constexpr RecordKey kHistory{RecordKind::kFaults, 0};
  const FoundRecord history = find(files, kHistory, record, result);
  if (history.newest >= 0) {
    result.profile_hash = history.head.profile_hash;
    result.has_history =
        read_history(record.data() + kHeadBytes, history.head.length, result.history);
    if (!result.has_history) {
      not_of_use(kHistory, history.newest, result);
    }
  }
  for (int number = 1; number < kFaultCount; ++number) {
    const RecordKey key{RecordKind::kFreezeFrame, static_cast<std::uint16_t>(number)};
    const FoundRecord found = find(files, key, record, result);
    if (found.newest < 0 || !result.has_history || found.head.profile_hash != result.profile_hash ||
        result.history.entry[static_cast<std::size_t>(number)].occurrences == 0) {
      continue;
    }
    StoredFrame frame;
    if (read_frame(record.data() + kHeadBytes, found.head.length, frame)) {
      // Another one is of occurrences that have been cleared, or of another time of this profile.
      if (result.history.of(static_cast<Fault>(number)).covers(frame.operation_s)) {
        result.frames.push_back(frame);
      }
    } else {
      not_of_use(key, found.newest, result);
    }
  }
  return result;
}

}  // namespace graben::ecu
