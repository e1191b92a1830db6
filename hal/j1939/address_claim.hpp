// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A controller's claim of its address (SAE J1939-81): said at the start, defended against a name
/// that is higher, given up to one that is lower or the same.
///
/// The address is fixed: the machine's end knows our commands by it, so there is no other one to
/// move to. Lost, it stays lost until the process begins anew: a bus on which two send commands
/// under one address is to be mended, not waited out.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben::j1939 {

/// Who has nothing to say before others had this time to object (J1939-81, for 128 to 247).
inline constexpr TimeUs kClaimWaitUs = 250 * kMillisecondUs;

/// Fields of a 64-bit NAME that this project sets; the others are 'not specific' or 'none'.
struct NameFields {
  std::uint32_t identity = 0;      ///< Which of the manufacturer's ECUs, 21 bit.
  std::uint16_t manufacturer = 0;  ///< SAE's number for it, 11 bit.
};

/// The NAME of a controller of construction equipment (industry group 3) with a fixed address and
/// no function of the standard's list. Fields are cut to their bits.
[[nodiscard]] std::uint64_t name_of(const NameFields& fields);

/// Another station's claim of our address.
struct RivalName {
  std::uint64_t name = 0;
  bool any = false;
};

class AddressClaim {
 public:
  AddressClaim(std::uint8_t address, std::uint64_t name) : address_(address), name_(name) {}

  /// Says the claim once more, as at the start: a bus has come back on which others may not have
  /// heard it.
  void begin() { owes_ = true; }

  /// Any frame; takes claims of our address and requests for claims.
  void hear(const CanFrame& frame, TimeUs now);

  /// True if a frame of ours is to go now: the claim, or that we cannot claim. It stays due until
  /// tried() says that all buses have taken it, and each try counts: one of several may have.
  [[nodiscard]] bool due(TimeUs now, CanFrame& frame);
  void tried(TimeUs now, bool taken);

  [[nodiscard]] std::uint64_t name() const { return name_; }
  /// Another one has our address: nothing else may be sent under it.
  [[nodiscard]] bool is_lost() const { return is_lost_; }
  /// Who claimed it last.
  [[nodiscard]] const RivalName& rival() const { return rival_; }
  /// Claims of our address by others, of which we kept it.
  [[nodiscard]] std::uint32_t defended() const { return defended_; }

 private:
  std::uint8_t address_;
  std::uint64_t name_;
  RivalName rival_;
  std::uint32_t defended_ = 0;
  bool is_lost_ = false;
  bool owes_ = true;
  TimeUs from_us_ = 0;  ///< What is owed does not go before.
  /// When the last ones were tried, in a ring: a storm of claims is answered so often in a second.
  std::array<TimeUs, 5> tried_us_{};
  std::size_t count_ = 0;
};

}  // namespace graben::j1939
