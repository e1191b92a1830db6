#include "hal/e2e.hpp"

namespace graben {
namespace {

constexpr std::uint8_t kPolynomial = 0x1D;
constexpr std::uint8_t kCounterMask = 0x0F;

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
  if (delta == 1) {
    ++state.run;
    state.synchronised = state.run == kE2eSyncFrames;
    return state.synchronised ? E2eCheck::kOk : E2eCheck::kSynchronising;
  }
  const bool first = state.run == 0;
  state.run = 1;
  if (first) {
    return E2eCheck::kSynchronising;
  }
  return delta == 0 ? E2eCheck::kRepeated : E2eCheck::kWrongSequence;
}

E2eCheck follow(const E2eConfig& config, E2eState& state, unsigned delta) {
  if (delta == 0) {
    return E2eCheck::kRepeated;
  }
  if (delta == 1) {
    return E2eCheck::kOk;
  }
  if (delta <= config.max_delta_counter) {
    return E2eCheck::kSomeLost;
  }
  lose_synchronisation(state, 1);
  return E2eCheck::kWrongSequence;
}

E2eCheck judge(const E2eConfig& config, E2eState& state, const E2ePayload& payload, TimeUs now) {
  if (is_silent(config, state, now)) {
    lose_synchronisation(state, 0);
  }
  if (payload[0] != crc_of(payload, config.data_id)) {
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
  const E2eCheck check =
      state.synchronised ? follow(config, state, delta) : synchronise(state, delta);
  state.last_counter = counter;
  if (check != E2eCheck::kRepeated) {
    state.any_good = true;
    state.last_good_us = now;
  }
  return check;
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

E2eCheck e2e_check(const E2eConfig& config, E2eState& state, const E2ePayload& payload,
                   TimeUs now) {
  state.last_check = judge(config, state, payload, now);
  return state.last_check;
}

E2eCheck e2e_status(const E2eConfig& config, const E2eState& state, TimeUs now) {
  return is_silent(config, state, now) ? E2eCheck::kNoNewData : state.last_check;
}

}  // namespace graben
