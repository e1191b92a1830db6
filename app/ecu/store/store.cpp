// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/store.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace graben::ecu {

FileName file_name(RecordKey key, unsigned copy) {
  FileName name{};
  const char end = copy == 0 ? 'a' : 'b';
  if (key.kind == RecordKind::kFaults) {
    static_cast<void>(std::snprintf(name.data(), name.size(), "faults.%c", end));
  } else {
    const char* const kind = key.kind == RecordKind::kGround ? "ground" : "frame";
    static_cast<void>(std::snprintf(name.data(), name.size(), "%s-%03u.%c", kind,
                                    static_cast<unsigned>(key.index), end));
  }
  return name;
}

FoundRecord find_record(StoreFiles& files, RecordKey key, RecordBytes& record) {
  FoundRecord found;
  for (unsigned copy = 0; copy < 2; ++copy) {
    const long count = files.read(file_name(key, copy).data(), record.data(), record.size());
    RecordHead head;
    found.copy[copy] = count < 0 ? CopyState::kUnreadable
                                 : open_record(record, static_cast<std::size_t>(count), key, head);
    if (found.copy[copy] == CopyState::kValid) {
      found.sequence[copy] = head.sequence;
      if (found.newest < 0 || head.sequence > found.head.sequence) {
        found.newest = static_cast<int>(copy);
        found.head = head;
      }
    }
  }
  if (found.newest == 0 && found.copy[1] != CopyState::kAbsent) {
    // The other one was read over it; who has lost it since has not had a disk.
    const long count = files.read(file_name(key, 0).data(), record.data(), record.size());
    RecordHead head;
    if (count < 0 ||
        open_record(record, static_cast<std::size_t>(count), key, head) != CopyState::kValid) {
      found.copy[0] = CopyState::kDamaged;
      found.newest = -1;
    }
  }
  return found;
}

Place Store::look() {
  Place place = files_.look();
  if (place == Place::kSame && !is_there_) {
    place = Place::kAnother;
  }
  if (place != Place::kSame) {
    slot_count_ = 0;
  }
  is_there_ = place != Place::kNone;
  return place;
}

bool Store::is_reached() { return is_there_ || look() != Place::kNone; }

Store::Slot* Store::slot_of(RecordKey key) {
  for (std::size_t i = 0; i < slot_count_; ++i) {
    if (slots_[i].key == key) {
      return &slots_[i];
    }
  }
  if (slot_count_ == kMostSlots) {
    return nullptr;
  }
  Slot& slot = slots_[slot_count_++];
  slot = {};
  slot.key = key;
  const FoundRecord found = find_record(files_, key, record_);
  slot.newest = found.newest;
  slot.sequence = std::max(found.sequence[0], found.sequence[1]);
  return &slot;
}

Store::Read Store::read(RecordKey key) {
  if (!is_reached()) {
    return {};
  }
  static_cast<void>(slot_of(key));
  const FoundRecord found = find_record(files_, key, record_);
  const auto either = [&](CopyState state) {
    return found.copy[0] == state || found.copy[1] == state;
  };
  Read read;
  for (unsigned copy = 0; copy < 2; ++copy) {
    read.is_damaged[copy] =
        found.copy[copy] == CopyState::kDamaged || found.copy[copy] == CopyState::kUnreadable;
  }
  if (found.newest >= 0) {
    read.state =
        found.head.profile_hash == profile_hash_ ? ReadState::kRead : ReadState::kOtherProfile;
    read.payload = record_.data() + kHeadBytes;
    read.length = found.head.length;
  } else if (either(CopyState::kOtherVersion)) {
    read.state = ReadState::kOtherVersion;
  } else {
    read.state =
        read.is_damaged[0] || read.is_damaged[1] ? ReadState::kDamaged : ReadState::kNothing;
  }
  return read;
}

bool Store::make_safe(Slot& slot) {
  if (slot.newest < 0 || slot.newest_is_on_disk) {
    return true;
  }
  const auto copy = static_cast<unsigned>(slot.newest);
  slot.newest_is_on_disk = files_.sync(file_name(slot.key, copy).data()) && files_.sync_folder();
  slot.is_listed[copy] = slot.newest_is_on_disk;
  return slot.newest_is_on_disk;
}

bool Store::write(RecordKey key, const std::uint8_t* payload, std::size_t length) {
  if (!is_reached()) {
    return false;
  }
  Slot* const slot = slot_of(key);
  if (slot == nullptr || length > kMostPayloadBytes || !make_safe(*slot)) {
    return false;
  }
  const unsigned copy = slot->newest == 0 ? 1U : 0U;
  const FileName name = file_name(key, copy);
  std::memcpy(record_.data() + kHeadBytes, payload, length);
  // One that failed may be whole on the disk all the same: each try is newer than it.
  const RecordHead head{key, profile_hash_, ++slot->sequence, static_cast<std::uint32_t>(length)};
  const std::size_t count = seal_record(head, record_);
  if (!files_.write(name.data(), record_.data(), count) || !files_.sync(name.data())) {
    return false;
  }
  slot->is_listed[copy] = slot->is_listed[copy] || files_.sync_folder();
  if (!slot->is_listed[copy]) {
    return false;
  }
  slot->newest = static_cast<int>(copy);
  slot->newest_is_on_disk = true;
  return true;
}

}  // namespace graben::ecu
