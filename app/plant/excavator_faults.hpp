// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faults of the simulated excavator, beside those of every machine.

#include <array>
#include <cstdint>
#include <optional>

#include "app/plant/node_faults.hpp"
#include "firmware/excavator/excavator_signals.hpp"

namespace graben::plant {

/// What a pressure sensor shows.
struct PressureFault {
  bool stuck = false;             ///< What it showed when this began.
  double scale = 1.0;             ///< So many times what it measures.
  std::optional<double> rail_pa;  ///< This.
};

struct SpoolFaults {
  /// The pilot valve is stuck and holds the spool here, -1 .. 1. Only the pilot cut centres it.
  std::optional<double> spool_held_ratio;
  /// The spool opens that much beyond its command, neutral or not.
  double spool_offset_ratio = 0.0;
  /// Hoses or valve are reversed: its oil goes the other way, its sensor shows what was commanded.
  bool reversed = false;
  bool echoes = false;  ///< Its sensor shows what it is sent.
};

struct AxisFaults : SpoolFaults {
  StrokeFault stroke;
  StrokeFault second;  ///< Of its second sensor, where it has one.
  PressureFault cap;
  PressureFault rod;
  bool pressures_swapped = false;  ///< Each is connected to the other's port.
};

/// Of no effect on a machine without a swing drive.
struct SwingFaults : SpoolFaults {
  AngleFault angle;
  AngleFault second;  ///< Of its second sensor, where it has one.
  PressureFault left;
  PressureFault right;
};

struct PumpFaults {
  std::optional<double> shown_swash_ratio;   ///< What the feedback says.
  std::optional<double> actual_swash_ratio;  ///< Where the pump goes, whatever is commanded.
};

/// Of the automation controller of a machine of the ZX200 class; a stroke's fault is then its
/// joint's, in rad.
struct Zx200Faults {
  bool locked = false;   ///< The operator locks the machine.
  bool stopped = false;  ///< The emergency stop is pressed.
  bool frozen = false;   ///< Its alive counter stands still.
  bool lost = false;     ///< It says nothing any more, and hears nothing.
};

/// Of sensors off the shelf.
struct SoldFaults {
  std::uint32_t reboots = 0;  ///< Counted up, `reboots_node` boots anew.
  std::uint8_t reboots_node = 0;
  std::uint16_t emergency = 0;  ///< Code that `emergency_node` has; told once, as it changes.
  std::uint8_t emergency_node = 0;
};

struct ExcavatorFaults : NodeFaults {
  std::array<AxisFaults, kAxisCount> axis;
  SwingFaults swing;
  std::array<PumpFaults, kPumpCount> pump;
  /// Whose stroke each axis shows: its plug may be in another sensor.
  std::array<std::size_t, kAxisCount> stroke_from = {0, 1, 2};

  Zx200Faults zx200;
  SoldFaults sold;

  void set_stroke_state(int axis_index, dbc::RawState state) {
    axis[static_cast<std::size_t>(axis_index)].stroke.state = state;
  }
};

}  // namespace graben::plant
