// SPDX-License-Identifier: Apache-2.0
// Frames that do not come, and frames whose protection says that something is wrong.

#include <fmt/format.h>

#include "app/scope/sim/sim_faults.hpp"

namespace graben::scope {
namespace {

using runs::alter;
using runs::corrupt;
using runs::counter_of;
using runs::protect;

template <class Kind>
SimEffect command_lost(SimRig<Kind>& /*rig*/) {
  return tampered_once(Kind::Dbc::SpoolCommand::kId, [](CanFrame&) { return false; });
}

template <class Kind>
SimEffect operator_silent(SimRig<Kind>& rig) {
  return switched<Kind>(rig,
                        [](typename Kind::Rig& nodes, bool on) { nodes.driver.set_silent(on); });
}

template <class Kind>
SimEffect enable_released(SimRig<Kind>& /*rig*/) {
  SimEffect effect;
  effect.operator_does = [](plant::OperatorRequest& request) {
    request.enable = false;
    request.task = Task::kNone;
  };
  return effect;
}

template <class Kind>
SimEffect stroke_silent(SimRig<Kind>& rig) {
  return silent(rig, Kind::Stroke::kId);
}

template <class Kind>
SimEffect engine_silent(SimRig<Kind>& rig) {
  return silent(rig, Kind::Dbc::EEC1::kId);
}

template <class Kind>
SimEffect one_wrong_crc(SimRig<Kind>& /*rig*/) {
  return tampered_once(Kind::Stroke::kId, [](CanFrame& frame) {
    corrupt(frame);
    return true;
  });
}

/// Every fifth frame: three wrong ones within eleven, never two in a row.
template <class Kind>
SimEffect many_wrong_crcs(SimRig<Kind>& /*rig*/) {
  return tampered(Kind::Stroke::kId, [number = 0](CanFrame& frame) mutable {
    if (number++ % 5 == 0) {
      corrupt(frame);
    }
    return true;
  });
}

template <class Kind>
SimEffect frozen_counter(SimRig<Kind>& rig) {
  return switched<Kind>(rig, [](typename Kind::Rig& nodes, bool on) {
    nodes.plant.faults().set_frozen_counter(Kind::Stroke::kId, on);
  });
}

/// Each frame's counter is five ahead of the last one's.
template <class Kind>
SimEffect counter_jumps(SimRig<Kind>& /*rig*/) {
  return tampered(Kind::Stroke::kId, [ahead = 0U](CanFrame& frame) mutable {
    ahead += 4;
    protect<Kind>(frame, static_cast<std::uint8_t>((counter_of(frame) + ahead) % kE2eCounterCount));
    return true;
  });
}

/// Every frame once more, but for the controller's: its own ids from elsewhere are another fault.
template <class Kind>
SimEffect duplicates(SimRig<Kind>& rig) {
  auto frames = std::make_shared<std::vector<CanFrame>>();
  SimEffect effect;
  effect.tamper = [frames, &rig](CanFrame& frame, const LoopbackPort* from) {
    if (from != nullptr && from != &rig.nodes().ecu_port) {
      frames->push_back(frame);
    }
    return true;
  };
  effect.before_controller = [frames, &rig] {
    const std::vector<CanFrame> again = std::move(*frames);
    frames->clear();
    for (const CanFrame& frame : again) {
      rig.nodes().bus.inject(frame);
    }
  };
  return effect;
}

template <class Kind>
SimEffect stream_late(SimRig<Kind>& rig) {
  constexpr TimeUs kLate_us = 200 * kMillisecondUs;
  return switched<Kind>(rig, [](typename Kind::Rig& nodes, bool on) {
    nodes.plant.faults().frames.delay_us = on ? kLate_us : 0;
  });
}

template <class Kind>
SimEffect swapped_data_ids(SimRig<Kind>& rig) {
  return switched<Kind>(rig, [](typename Kind::Rig& nodes, bool on) {
    auto& swapped = nodes.plant.faults().frames.swapped_data_ids;
    swapped.reset();
    if (on) {
      swapped.emplace(Kind::Stroke::kId, Kind::Other::kId);
    }
  });
}

/// Another node sends the stroke too, with a counter of its own and another value.
template <class Kind>
SimEffect second_sender(SimRig<Kind>& rig) {
  struct Other {
    CanFrame frame;
    bool due = false;
    std::uint8_t counter = 0;
  };
  auto other = std::make_shared<Other>();
  SimEffect effect = tampered(Kind::Stroke::kId, [other](CanFrame& frame) {
    other->frame = frame;
    other->due = true;
    return true;
  });
  effect.before_controller = [other, &rig] {
    if (std::exchange(other->due, false)) {
      alter(other->frame);
      protect<Kind>(other->frame, other->counter);
      other->counter = e2e_next_counter(other->counter);
      rig.nodes().bus.inject(other->frame);
    }
  };
  return effect;
}

}  // namespace

template <class Kind>
SimFaultRows<Kind> sim_message_faults() {
  using R = SimReaction;
  const std::string stroke = Kind::kStrokeWords;
  return {
      {"command-lost", 1, "one command frame is lost", R::kBridged, command_lost<Kind>, true},
      {"operator-silent", 2, "the operator's frames stop", R::kStops, operator_silent<Kind>},
      {"enable-released", 3, "the operator lets go of enable", R::kLetsGo, enable_released<Kind>},
      {"stroke-silent", 4, stroke + "'s frames stop", R::kStops, stroke_silent<Kind>},
      {"engine-silent", 6, "the engine speed's frames stop", R::kSlower, engine_silent<Kind>},
      {"crc-wrong", 7, "one frame of " + stroke + " has a wrong CRC", R::kIgnored,
       one_wrong_crc<Kind>, true},
      {"crcs-wrong", 8, "every fifth frame of " + stroke + " has a wrong CRC", R::kStops,
       many_wrong_crcs<Kind>},
      {"counter-frozen", 9, stroke + "'s counter is frozen", R::kStops, frozen_counter<Kind>},
      {"counter-jumps", 10, stroke + "'s counter jumps", R::kStops, counter_jumps<Kind>},
      {"duplicates", 13, "every frame comes twice", R::kIgnored, duplicates<Kind>},
      {"stream-late", 14, "all of the machine's frames come 200 ms late", R::kStops,
       stream_late<Kind>},
      {"data-ids-swapped", 15,
       fmt::format("{} and {} are sent under each other's data id", stroke, Kind::kOtherWords),
       R::kStops, swapped_data_ids<Kind>},
      {"second-sender", 16, "a second node sends " + stroke, R::kStops, second_sender<Kind>}};
}

template SimFaultRows<SimExcavator> sim_message_faults();
template SimFaultRows<SimDozer> sim_message_faults();

}  // namespace graben::scope
