// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/learnt_record.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/drives/learnt/tuning.hpp"

namespace graben::ecu {
namespace {
constexpr double kRounding = 1e-6;
}  // namespace

LearntRecord record_of(const ExcavatorKind::Learnt& learnt) {
  LearntRecord record;
  for (const LearntDeadBand& edge : learnt) {
    record.value[record.count++] = static_cast<float>(edge.extend);
    record.value[record.count++] = static_cast<float>(edge.retract);
  }
  // Nothing is no news: what an earlier run has stored stands.
  const bool is_any = std::any_of(record.value.begin(), record.value.end(),
                                  [](float value) { return value != 0.0F; });
  return is_any ? record : LearntRecord{};
}

LearntRecord record_of(const DozerKind::Learnt& /*learnt*/) { return {}; }

bool learnt_from(const LearntRecord& record, ExcavatorKind::Learnt& learnt) {
  if (record.count != LearntRecord::kMost) {
    return false;
  }
  std::size_t next = 0;
  // A bound that a run has come to is not beyond it for what a float makes of it.
  const auto value = [&] {
    const double stored = record.value[next++];
    const double within = std::clamp(stored, -kLearntEdgeMost, kLearntEdgeMost);
    return std::abs(stored - within) < kRounding ? within : stored;
  };
  for (LearntDeadBand& edge : learnt) {
    edge.extend = value();
    edge.retract = value();
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
