// SPDX-License-Identifier: Apache-2.0
// Frames and values that are not what they have to be.

#include "app/scope/sim/sim_faults.hpp"

namespace graben::scope {
namespace {

template <class Kind>
SimEffect wrong_length(SimRig<Kind>& /*rig*/) {
  constexpr std::uint8_t kShort = 5;
  return tampered(Kind::Stroke::kId, [](CanFrame& frame) {
    frame.length = kShort;
    return true;
  });
}

/// Beside the live ones, a frame that `make` has changed.
template <class Kind, class Make>
SimEffect one_beside(SimRig<Kind>& rig, Make make) {
  auto done = std::make_shared<bool>(false);
  SimEffect effect;
  effect.before_controller = [&rig, done, make] {
    CanFrame frame;
    frame.id = Kind::Stroke::kId;
    frame.length = Kind::Stroke::kLength;
    make(frame);
    rig.nodes().bus.inject(frame);
    *done = true;
  };
  effect.is_over = [done] { return *done; };
  return effect;
}

template <class Kind>
SimEffect remote_frame(SimRig<Kind>& rig) {
  return one_beside(rig, [](CanFrame& frame) { frame.remote = true; });
}

template <class Kind>
SimEffect short_id(SimRig<Kind>& rig) {
  constexpr std::uint32_t kShort = 0x7FF;
  return one_beside(rig, [](CanFrame& frame) {
    frame.extended = false;
    frame.id &= kShort;
  });
}

/// The stroke says a special value instead.
template <class Kind>
SimEffect special_value(std::uint32_t raw16) {
  return tampered(Kind::Stroke::kId, [raw16](CanFrame& frame) {
    runs::set_raw<Kind>(frame, Kind::kStroke, runs::special_raw(Kind::kStroke, raw16));
    return true;
  });
}

template <class Kind>
SimEffect not_available(SimRig<Kind>& /*rig*/) {
  return special_value<Kind>(0xFF00);
}

template <class Kind>
SimEffect error_value(SimRig<Kind>& /*rig*/) {
  return special_value<Kind>(0xFE00);
}

}  // namespace

template <class Kind>
SimFaultRows<Kind> sim_format_faults() {
  using R = SimReaction;
  const std::string stroke = Kind::kStrokeWords;
  return {{"length-wrong", 17, stroke + "'s frames have 5 bytes", R::kStops, wrong_length<Kind>},
          {"remote-frame", 18, "one remote frame with the id of " + stroke, R::kIgnored,
           remote_frame<Kind>, true},
          {"short-id", 19, "one 11-bit frame with the low bits of that id", R::kBridged,
           short_id<Kind>, true},
          {"not-available", 20, stroke + " is 'not available'", R::kStops, not_available<Kind>},
          {"error-value", 21, stroke + " is 'error'", R::kStops, error_value<Kind>}};
}

template SimFaultRows<SimExcavator> sim_format_faults();
template SimFaultRows<SimDozer> sim_format_faults();

}  // namespace graben::scope
