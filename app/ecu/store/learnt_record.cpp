// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/learnt_record.hpp"

namespace graben::ecu {

LearntRecord record_of(const ExcavatorKind::Learnt& learnt) {
  LearntRecord record;
  for (const LearntDeadBand& edge : learnt) {
    record.value[record.count++] = static_cast<float>(edge.extend);
    record.value[record.count++] = static_cast<float>(edge.retract);
  }
  return record;
}

LearntRecord record_of(const DozerKind::Learnt& /*learnt*/) { return {}; }

bool learnt_from(const LearntRecord& record, ExcavatorKind::Learnt& learnt) {
  if (record.count != LearntRecord::kMost) {
    return false;
  }
  std::size_t next = 0;
  for (LearntDeadBand& edge : learnt) {
    edge.extend = record.value[next++];
    edge.retract = record.value[next++];
  }
  return true;
}

bool learnt_from(const LearntRecord& /*record*/, DozerKind::Learnt& /*learnt*/) { return false; }

void write_learnt(const LearntRecord& record, ByteWriter& to) {
  to.u16(static_cast<std::uint16_t>(record.count));
  for (std::size_t i = 0; i < record.count; ++i) {
    to.f32(record.value[i]);
  }
}

LearntRecord read_learnt(ByteReader& from) {
  LearntRecord record;
  record.count = from.u16();
  if (record.count > LearntRecord::kMost) {
    return {};
  }
  for (std::size_t i = 0; i < record.count; ++i) {
    record.value[i] = from.f32();
  }
  return from.good() ? record : LearntRecord{};
}

}  // namespace graben::ecu
