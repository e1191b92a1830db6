#pragma once
/// What is broken on the simulated machine. The default is nothing; each switch acts from the next
/// cycle on and can be taken back.

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/excavator_signals.hpp"

namespace graben::plant {

/// Of a node's frames, by their messages' 29-bit ids.
struct FrameFaults {
  std::set<std::uint32_t> silent;          ///< Not sent; the counter stands still meanwhile.
  std::set<std::uint32_t> frozen_counter;  ///< Sent with the same counter again and again.
  /// Each is protected with the other's data id.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> swapped_data_ids;
  /// Every frame goes out that much later. What is still on its way when it becomes 0 is lost.
  TimeUs delay_us = 0;
};

/// What a stroke sensor shows.
struct StrokeFault {
  bool stuck = false;      ///< What it showed when this began.
  double jump_m = 0.0;     ///< Added.
  double drift_mps = 0.0;  ///< Added, growing from 0 on; 0 takes it back.
  dbc::RawState state{};   ///< kValid shows the stroke; else 'error' or 'not available'.
};

/// What a pressure sensor shows.
struct PressureFault {
  bool stuck = false;             ///< What it showed when this began.
  std::optional<double> rail_pa;  ///< This.
};

struct AxisFaults {
  /// The pilot valve is stuck and holds the spool here, -1 .. 1. Only the pilot cut centres it.
  std::optional<double> spool_held_ratio;
  /// The spool opens that much beyond its command, neutral or not.
  double spool_offset_ratio = 0.0;
  StrokeFault stroke;
  PressureFault cap;
  PressureFault rod;
};

struct PumpFaults {
  std::optional<double> shown_swash_ratio;   ///< What the feedback says.
  std::optional<double> actual_swash_ratio;  ///< Where the pump goes, whatever is commanded.
};

struct PlantFaults {
  std::array<AxisFaults, kAxisCount> axis;
  std::array<PumpFaults, kPumpCount> pump;
  bool wrong_identity = false;        ///< The machine names another profile.
  bool loses_spool_commands = false;  ///< SpoolCommand does not reach the valve side.
  FrameFaults frames;

  void set_silent(std::uint32_t id, bool silent) { set(frames.silent, id, silent); }
  void set_frozen_counter(std::uint32_t id, bool frozen) { set(frames.frozen_counter, id, frozen); }
  void set_stroke_state(int axis_index, dbc::RawState state) {
    axis[static_cast<std::size_t>(axis_index)].stroke.state = state;
  }

 private:
  static void set(std::set<std::uint32_t>& ids, std::uint32_t id, bool in) {
    if (in) {
      ids.insert(id);
    } else {
      ids.erase(id);
    }
  }
};

}  // namespace graben::plant
