// SPDX-License-Identifier: Apache-2.0
#include "hal/link/signal_rows.hpp"

#include <limits>

namespace graben {
namespace {

using dbc::RawState;

bool is_within(const SignalScale& scale, std::uint32_t raw) {
  return raw >= scale.raw_min && raw <= scale.raw_max;
}

/// Of a raw value that is not within [min|max], where no special value lies (rows::fits).
RawState state_beyond(const SignalScale& scale, std::uint32_t raw) {
  const std::uint32_t top = raw >> scale.top_shift;
  if (top < scale.error_top) {
    return RawState::kOutOfRange;
  }
  return top == scale.error_top ? RawState::kError : RawState::kNotAvailable;
}

/// 'Error', or the start value where the signal can't say it: 0 (rows::fits).
std::uint32_t refused_raw(const SignalScale& scale) {
  return scale.error_top == SignalScale::kNoSpecials
             ? 0U
             : scale.mask - (std::uint32_t{1} << scale.top_shift);
}

std::uint32_t special_raw(const SignalScale& scale, RawState state) {
  return state == RawState::kNotAvailable && scale.error_top != SignalScale::kNoSpecials
             ? scale.mask
             : refused_raw(scale);
}

/// Rounds to the nearest raw value and saturates; what is not finite is refused.
std::uint32_t physical_raw(const SignalScale& scale, double value) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  if (!(value >= -kLargest && value <= kLargest)) {
    return refused_raw(scale);
  }
  const double raw =
      value / scale.numerator * scale.denominator - static_cast<double>(scale.raw_offset);
  if (raw <= static_cast<double>(scale.raw_min)) {
    return scale.raw_min;
  }
  if (raw >= static_cast<double>(scale.raw_max)) {
    return scale.raw_max;
  }
  // As the codec has it.
  return static_cast<std::uint32_t>(raw + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

std::uint32_t count_raw(const SignalScale& scale, std::uint32_t value) {
  return value < scale.raw_min ? scale.raw_min : value > scale.raw_max ? scale.raw_max : value;
}

std::uint32_t coded_raw(const SignalScale& scale, std::uint32_t value) {
  return is_within(scale, value) ? value : refused_raw(scale);
}

std::uint32_t raw_of(const SignalRow& row, const void* member) {
  const SignalScale& scale = *row.scale;
  if (row.kind == SignalKind::kPhysical) {
    const auto& signal = *static_cast<const dbc::Physical*>(member);
    return signal.state == RawState::kValid ? physical_raw(scale, signal.value)
                                            : special_raw(scale, signal.state);
  }
  if (row.kind == SignalKind::kCount) {
    const auto& signal = *static_cast<const dbc::Count*>(member);
    return signal.state == RawState::kValid ? count_raw(scale, signal.value)
                                            : special_raw(scale, signal.state);
  }
  // Of whatever enumeration: its two bytes.
  const auto* const bytes = static_cast<const unsigned char*>(member);
  const auto state = static_cast<RawState>(bytes[rows::kCodedState]);
  return state == RawState::kValid ? coded_raw(scale, bytes[0]) : special_raw(scale, state);
}

}  // namespace

bool unpack(const SignalRow* rows, std::size_t count, const dbc::Payload& payload, void* message) {
  const std::uint64_t word = dbc::word_of(payload);
  bool all = true;
  for (std::size_t n = 0; n < count; ++n) {
    const SignalRow& row = rows[n];
    const SignalScale& scale = *row.scale;
    std::uint32_t raw = static_cast<std::uint32_t>(word >> row.start_bit) & scale.mask;
    RawState state = RawState::kValid;
    if (!is_within(scale, raw)) {
      state = state_beyond(scale, raw);
      all = all && state != RawState::kOutOfRange;
      raw = 0;
    }
    auto* const member = static_cast<unsigned char*>(message) + row.offset;
    if (row.kind == SignalKind::kCoded) {
      member[0] = static_cast<unsigned char>(raw);
      member[rows::kCodedState] = static_cast<unsigned char>(state);
    } else if (row.kind == SignalKind::kCount) {
      *reinterpret_cast<dbc::Count*>(member) = {raw, state};
    } else {
      // Within [min|max] the counts fit 32 bits (rows::fits).
      const auto counts = static_cast<double>(static_cast<std::int32_t>(raw) + scale.raw_offset);
      *reinterpret_cast<dbc::Physical*>(member) = {
          state == RawState::kValid ? counts * scale.numerator / scale.denominator : 0.0, state};
    }
  }
  return all;
}

dbc::Payload pack(const SignalRow* rows, std::size_t count, const void* message) {
  std::uint64_t word = ~std::uint64_t{0};
  for (std::size_t n = 0; n < count; ++n) {
    const SignalRow& row = rows[n];
    const void* const member = static_cast<const unsigned char*>(message) + row.offset;
    // Its bits are 1 until here: those that are to be 0 change.
    word ^= std::uint64_t{~raw_of(row, member) & row.scale->mask} << row.start_bit;
  }
  return dbc::payload_of(word);
}

}  // namespace graben
