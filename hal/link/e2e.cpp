// SPDX-License-Identifier: Apache-2.0
#include "hal/link/e2e.hpp"

#include <algorithm>

namespace graben {
namespace {

constexpr std::uint8_t kPolynomial = 0x1D;
constexpr std::uint8_t kCounterMask = 0x0F;
constexpr unsigned kLateFrames = 2;  ///< So many places behind, a frame is late, no jump.

constexpr std::array<std::uint8_t, 256> make_crc_table() {
  std::array<std::uint8_t, 256> table{};
  for (unsigned i = 0; i < table.size(); ++i) {
    unsigned crc = i;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x80U) != 0U ? (crc << 1U) ^ kPolynomial : crc << 1U;
    }
    table[i] = static_cast<std::uint8_t>(crc);
  }
  return table;
}

constexpr std::array<std::uint8_t, 256> kCrcTable = make_crc_table();

std::uint8_t crc_of(const E2ePayload& payload, std::uint16_t data_id) {
  const std::array<std::uint8_t, 2> id{static_cast<std::uint8_t>(data_id & 0xFFU),
                                       static_cast<std::uint8_t>(data_id >> 8U)};
  return crc8(crc8(0, id.data(), id.size()), payload.data() + 1, payload.size() - 1);
}

bool is_silent(const E2eConfig& config, const E2eState& state, TimeUs now) {
  return !state.any_good || now - state.last_good_us > config.max_silence_us;
}

void lose_synchronisation(E2eState& state, std::uint8_t run) {
  state.synchronised = false;
  state.run = run;
}

E2eCheck synchronise(E2eState& state, unsigned delta) {
  if (state.run == 0) {
    state.run = 1;
    return E2eCheck::kSynchronising;
  }
  if (delta != 1) {
    state.run = 1;
    return E2eCheck::kWrongSequence;
  }
  ++state.run;
  state.synchronised = state.run == kE2eSyncFrames;
  return state.synchronised ? E2eCheck::kOk : E2eCheck::kSynchronising;
}

E2eCheck follow(const E2eConfig& config, E2eState& state, unsigned delta) {
  if (delta == 1) {
    return E2eCheck::kOk;
  }
  if (delta <= config.max_delta_counter) {
    return E2eCheck::kSomeLost;
  }
  lose_synchronisation(state, 1);
  return E2eCheck::kWrongSequence;
}

bool is_late(const E2eConfig& config, const E2eState& state, unsigned delta) {
  return state.synchronised && delta > config.max_delta_counter &&
         delta >= kE2eCounterCount - kLateFrames;
}

/// Whether the sender cannot have sent this frame too; if it can, the next one's time moves on.
bool comes_too_early(const E2eConfig& config, E2eState& state, TimeUs now) {
  if (now < state.batch_us) {  // the clock went back
    state.due_us = now;
  } else if (now > state.batch_us) {
    state.due_us = std::max({state.due_us, state.batch_us, now - config.max_silence_us});
  }
  state.batch_us = now;
  if (state.due_us > now) {
    return true;
  }
  state.due_us += config.cycle_us * 4 / 5;
  return false;
}

E2eCheck judge(const E2eConfig& config, E2eState& state, const E2ePayload& payload, TimeUs now) {
  if (is_silent(config, state, now)) {
    lose_synchronisation(state, 0);
  }
  if (!e2e_crc_fits(payload, config.data_id)) {
    state.run = 0;
    return E2eCheck::kWrongCrc;
  }
  const auto counter = static_cast<std::uint8_t>(payload[1] & kCounterMask);
  if (counter >= kE2eCounterCount) {
    lose_synchronisation(state, 0);
    return E2eCheck::kWrongSequence;
  }
  const unsigned delta =
      (static_cast<unsigned>(counter) + kE2eCounterCount - state.last_counter) % kE2eCounterCount;
  const bool same_counter = delta == 0 && (state.synchronised || state.run > 0);
  if (same_counter && payload[0] == state.last_crc) {
    state.run = 1;  // means nothing while synchronised
    return E2eCheck::kRepeated;
  }
  if (comes_too_early(config, state, now)) {
    return E2eCheck::kTooMany;
  }
  if (same_counter) {
    state.run = 1;
    return E2eCheck::kConflict;
  }
  if (is_late(config, state, delta)) {
    return E2eCheck::kWrongSequence;
  }
  state.last_counter = counter;
  state.last_crc = payload[0];
  state.any_good = true;
  state.last_good_us = now;
  return state.synchronised ? follow(config, state, delta) : synchronise(state, delta);
}

}  // namespace

std::uint8_t crc8(std::uint8_t crc, const std::uint8_t* data, std::size_t length) {
  for (std::size_t i = 0; i < length; ++i) {
    crc = kCrcTable[static_cast<std::uint8_t>(crc ^ data[i])];
  }
  return crc;
}

void e2e_protect(E2ePayload& payload, std::uint16_t data_id, std::uint8_t counter) {
  payload[1] = static_cast<std::uint8_t>((payload[1] & 0xF0U) | (counter & kCounterMask));
  payload[0] = crc_of(payload, data_id);
}

std::uint8_t e2e_signature(std::uint16_t data_id) { return crc_of({}, data_id); }

std::uint8_t e2e_fitting_signature(const E2ePayload& payload) {
  return static_cast<std::uint8_t>(payload[0] ^ crc_of(payload, 0));
}

bool e2e_crc_fits(const E2ePayload& payload, std::uint16_t data_id) {
  return payload[0] == crc_of(payload, data_id);
}

E2eCheck e2e_check(const E2eConfig& config, E2eState& state, const E2ePayload& payload,
                   TimeUs now) {
  state.last_check = judge(config, state, payload, now);
  return state.last_check;
}

E2eCheck e2e_status(const E2eConfig& config, const E2eState& state, TimeUs now) {
  return is_silent(config, state, now) ? E2eCheck::kNoNewData : state.last_check;
}

}  // namespace graben
