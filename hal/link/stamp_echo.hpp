// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A station's answer to the controller's stamps (hal/link/challenge.hpp), for whatever plays one:
/// the operator's, and those of a simulated machine.

#include <cstdint>

#include "can_dbc/codec.hpp"
#include "hal/can_frame.hpp"

namespace graben {

/// What a station says as its Echo: the last stamp that it heard, 0 before the first.
template <class EcuIdentity>
class StampEcho {
 public:
  void hear(const CanFrame& frame) {
    if (frame.id != EcuIdentity::kId || !frame.extended || frame.remote || frame.error ||
        frame.length != EcuIdentity::kLength) {
      return;
    }
    const auto stamp = EcuIdentity::decode(frame.data).stamp;
    if (stamp.state == dbc::RawState::kValid) {
      stamp_ = stamp.value;
      is_new_ = true;
    }
  }
  /// True once for what was heard.
  [[nodiscard]] bool take_new() {
    const bool is_new = is_new_;
    is_new_ = false;
    return is_new && !mute_;
  }
  [[nodiscard]] dbc::Count said() const {
    return {mute_ ? 0U : stamp_, mute_ ? dbc::RawState::kNotAvailable : dbc::RawState::kValid};
  }
  /// It knows nothing of stamps.
  void set_mute(bool mute) { mute_ = mute; }

 private:
  std::uint32_t stamp_ = 0;
  bool is_new_ = false;
  bool mute_ = false;
};

}  // namespace graben
