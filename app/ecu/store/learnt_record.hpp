// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a controller has learnt of its machine, as it is stored: numbers, whatever the kind.

#include <array>
#include <cstddef>

#include "app/ecu/dozer_kind.hpp"
#include "app/ecu/excavator_kind.hpp"
#include "app/ecu/store/byte_order.hpp"

namespace graben::ecu {

struct LearntRecord {
  /// Edges of each drive of an excavator: boom, arm, bucket, swing; extend, retract.
  static constexpr std::size_t kMost = 2UL * kDriveCount;
  std::array<float, kMost> value{};
  std::size_t count = 0;  ///< 0: there is nothing learnt.
};

[[nodiscard]] LearntRecord record_of(const ExcavatorKind::Learnt& learnt);
[[nodiscard]] LearntRecord record_of(const DozerKind::Learnt& learnt);
/// False if the record has not just these numbers; `learnt` is as it was then.
[[nodiscard]] bool learnt_from(const LearntRecord& record, ExcavatorKind::Learnt& learnt);
[[nodiscard]] bool learnt_from(const LearntRecord& record, DozerKind::Learnt& learnt);

void write_learnt(const LearntRecord& record, ByteWriter& to);
/// Empty where the bytes end within it, which `from` then knows, or say more than fits.
[[nodiscard]] LearntRecord read_learnt(ByteReader& from);

}  // namespace graben::ecu
