// SPDX-License-Identifier: Apache-2.0
#include "hal/j1939/address_claim.hpp"

#include "hal/j1939/ids.hpp"

namespace graben::j1939 {
namespace {

constexpr std::uint64_t kIdentityMask = 0x1FFFFF;
constexpr std::uint64_t kManufacturerMask = 0x7FF;
constexpr unsigned kManufacturerShift = 21;
constexpr unsigned kFunctionShift = 40;
constexpr unsigned kIndustryShift = 60;
constexpr std::uint64_t kNoFunction = 0xFF;
constexpr std::uint64_t kConstruction = 3;

constexpr std::size_t kRequestBytes = 3;
constexpr std::size_t kNameBytes = 8;
/// Two that cannot claim must not say so in the same bit: 0 to 153 ms, by the NAME (J1939-81).
constexpr TimeUs kDelayStepUs = 600;
constexpr std::uint64_t kDelaySteps = 255;

std::uint64_t name_in(const CanFrame& frame) {
  std::uint64_t name = 0;
  for (std::size_t i = 0; i < kNameBytes; ++i) {
    name |= static_cast<std::uint64_t>(frame.data[i]) << (8U * i);
  }
  return name;
}

TimeUs delay_of(std::uint64_t name) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kNameBytes; ++i) {
    sum += name >> (8U * i) & 0xFFU;
  }
  return static_cast<TimeUs>(sum % (kDelaySteps + 1)) * kDelayStepUs;
}

}  // namespace

std::uint64_t name_of(const NameFields& fields) {
  return (fields.identity & kIdentityMask) |
         (fields.manufacturer & kManufacturerMask) << kManufacturerShift |
         kNoFunction << kFunctionShift | kConstruction << kIndustryShift;
}

void AddressClaim::hear(const CanFrame& frame, TimeUs now) {
  if (!frame.extended || frame.remote || frame.error || frame.fd) {
    return;
  }
  const Address from = address_of(frame.id);
  if (from.receiver != kGlobalAddress && from.receiver != address_) {
    return;
  }
  if (from.pgn == kRequestPgn && frame.length >= kRequestBytes && frame.length <= 8) {
    const std::uint32_t pgn = frame.data[0] | static_cast<std::uint32_t>(frame.data[1]) << 8U |
                              static_cast<std::uint32_t>(frame.data[2]) << 16U;
    if (pgn == kAddressClaimedPgn && !owes_) {
      owes_ = true;
      from_us_ = now + (is_lost_ ? delay_of(name_) : 0);
    }
    return;
  }
  if (from.pgn != kAddressClaimedPgn || from.sender != address_ || frame.length != kNameBytes) {
    return;
  }
  rival_ = {name_in(frame), true};
  if (is_lost_) {
    return;
  }
  if (rival_.name > name_) {
    defended_ += defended_ < UINT32_MAX ? 1U : 0U;
    owes_ = true;
    from_us_ = now;
    return;
  }
  is_lost_ = true;
  owes_ = true;
  from_us_ = now + delay_of(name_);
}

bool AddressClaim::due(TimeUs now, CanFrame& frame) {
  const TimeUs fifth_us = tried_us_[count_ % tried_us_.size()];
  const bool is_full = count_ >= tried_us_.size() && now >= fifth_us && now - fifth_us < kSecondUs;
  if (!owes_ || now < from_us_ || is_full) {
    return false;
  }
  frame = {};
  frame.id = id_of(kDiagnosticPriority, kAddressClaimedPgn, kGlobalAddress,
                   is_lost_ ? kNullAddress : address_);
  frame.extended = true;
  frame.length = kNameBytes;
  frame.stamp_us = now;
  for (std::size_t i = 0; i < kNameBytes; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(name_ >> (8U * i));
  }
  return true;
}

void AddressClaim::tried(TimeUs now, bool taken) {
  owes_ = owes_ && !taken;
  tried_us_[count_++ % tried_us_.size()] = now;
}

}  // namespace graben::j1939
