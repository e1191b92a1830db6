// SPDX-License-Identifier: Apache-2.0
#include "hal/buses/link_imus.hpp"

#include <algorithm>

#include "hal/link/message_decode.hpp"

namespace graben {
namespace {

namespace bus = dbc::j1939;
using Rows = SignalRows<dbc::MessageList<bus::ARI, bus::ACS>>;

static_assert(ImuAddresses{}.size() == kImuCount, "an address for each");

constexpr std::uint32_t kAddressBits = 0xFFU;
/// Page, format and group extension: the message, whatever its priority and sender.
constexpr std::uint32_t kGroupBits = 0x03FFFF00U;

/// A sender's clock differs.
constexpr TimeUs kLeast_us = 8 * kMillisecondUs;

template <class Message>
constexpr bool is(std::uint32_t id) {
  return (id & kGroupBits) == (Message::kId & kGroupBits);
}

void increment(std::uint32_t& counter) {
  if (counter < UINT32_MAX) {
    ++counter;
  }
}

/// Of a value and its figure of merit. A sensor that gives no merit is taken at its value.
template <class Merit>
Validity validity_of(const dbc::Physical& value, const dbc::Coded<Merit>& merit) {
  const bool works = merit.state == dbc::RawState::kNotAvailable ||
                     (merit.state == dbc::RawState::kValid && merit.value == Merit::kFunctional);
  return works ? graben::validity_of(value.state) : Validity::kError;
}

Signal<ImuRates> rates_of(const bus::ARI& message, TimeUs now) {
  const bool says_age = message.latency_s.state == dbc::RawState::kValid;
  // Roll and yaw are 0 where they are not measured: they show the swing alone.
  return {{message.pitch_rate_radps.value, message.roll_rate_radps.value,
           message.yaw_rate_radps.value, says_age ? message.latency_s.value : -1.0},
          validity_of(message.pitch_rate_radps, message.pitch_rate_merit),
          now};
}

Signal<ImuForces> forces_of(const bus::ACS& message, TimeUs now) {
  return {{message.longitudinal_mps2.value, message.vertical_mps2.value},
          std::min(validity_of(message.longitudinal_mps2, message.longitudinal_merit),
                   validity_of(message.vertical_mps2, message.vertical_merit)),
          now};
}

}  // namespace

bool LinkImus::take_extended(const CanFrame& frame, TimeUs now,
                             std::array<ImuInputs, kImuCount>& to) {
  const bool rates = is<bus::ARI>(frame.id);
  if (!rates && !is<bus::ACS>(frame.id)) {
    return false;
  }
  const auto address = static_cast<std::uint8_t>(frame.id & kAddressBits);
  std::size_t imu = 0;
  while (imu < address_.size() && address_[imu] != address) {
    ++imu;
  }
  if (address == 0 || imu == address_.size()) {
    return false;
  }
  if (frame.remote || frame.fd) {
    increment(counters_.wrong_kind);
    return true;
  }
  if (frame.length != bus::ARI::kLength) {
    increment(counters_.wrong_length);
    return true;
  }
  if (is_early(now, kLeast_us, pace_[imu][rates ? 0 : 1])) {
    increment(counters_.surplus);
    (rates ? to[imu].rates.validity : to[imu].forces.validity) = Validity::kError;
    return true;
  }
  UnreadMessage<bus::ARI> ari;
  UnreadMessage<bus::ACS> acs;
  if (rates ? !Rows::decode(frame.data, ari.message) : !Rows::decode(frame.data, acs.message)) {
    increment(counters_.out_of_range);
    return true;
  }
  increment(counters_.accepted);
  if (rates) {
    to[imu].rates = rates_of(ari.message, now);
  } else {
    to[imu].forces = forces_of(acs.message, now);
  }
  return true;
}

std::array<std::uint32_t, kImuCount * LinkImus::kMessagesEach> imu_ids(
    const ImuAddresses& address) {
  std::array<std::uint32_t, kImuCount * LinkImus::kMessagesEach> ids{};
  for (std::size_t imu = 0; imu < address.size(); ++imu) {
    if (address[imu] != 0) {
      ids[2 * imu] = (bus::ARI::kId & ~kAddressBits) | address[imu];
      ids[2 * imu + 1] = (bus::ACS::kId & ~kAddressBits) | address[imu];
    }
  }
  return ids;
}

}  // namespace graben
