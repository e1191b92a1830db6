#pragma once
/// The simulated machine on the bus: valve side, sensors, engine.

#include <array>
#include <cstdint>

#include "app/plant/excavator_plant.hpp"
#include "app/plant/frame_sender.hpp"
#include "app/plant/sensor_model.hpp"
#include "can_dbc/codec.hpp"
#include "hal/can_port.hpp"
#include "hal/e2e.hpp"

namespace graben::plant {

/// What became of the frames with the spool command's id.
struct CommandCounters {
  std::uint64_t accepted = 0;
  std::uint64_t wrong_format = 0;  ///< 11 bit, remote, error, FD or wrong length.
  std::uint64_t rejected = 0;      ///< By CRC or counter, or while synchronising.
  std::uint64_t timeouts = 0;      ///< Times that the spools went to neutral for lack of a command.
};

/// The bus port belongs to the caller, who opens it. Without a command for `kCommandTimeoutUs`,
/// with enable off or unusable, or with an unusable duty every spool is sent to neutral, which
/// takes its dead time.
class PlantNode {
 public:
  static constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
  static constexpr TimeUs kCommandTimeoutUs = 100 * kMillisecondUs;

  PlantNode(const PlantProfile& profile, const ExcavatorPlant::AxisArray& start_strokes_m,
            CanPort& port, std::uint32_t profile_hash);

  /// To be called every 10 ms: takes the commands that are pending, runs the plant on by 10 ms,
  /// then reports its state: strokes and pressures each time, pumps and engine every second time,
  /// identity every hundredth, all of them in the first. `now` is for stamps and timeouts only.
  void step(TimeUs now);

  [[nodiscard]] ExcavatorPlant& plant() { return plant_; }
  [[nodiscard]] const ExcavatorPlant& plant() const { return plant_; }
  [[nodiscard]] const CommandCounters& counters() const { return counters_; }
  [[nodiscard]] bool spools_enabled() const { return enabled_; }

  /// Fault switches. Silence stops one message by its 29-bit id.
  void set_silent(std::uint32_t id, bool silent) { sender_.set_silent(id, silent); }
  /// kValid sends the measured stroke, the others 'error' or 'not available'.
  void set_stroke_state(int axis, dbc::RawState state) {
    stroke_state_[static_cast<std::size_t>(axis)] = state;
  }

 private:
  void receive(TimeUs now);
  void take_command(const CanFrame& frame, TimeUs now);
  void go_neutral();
  void send_axes(TimeUs now);
  void send_pressures(TimeUs now);
  void send_pumps(TimeUs now);
  void send_identity(TimeUs now);
  [[nodiscard]] dbc::Physical stroke(std::size_t axis) const;

  ExcavatorPlant plant_;
  SensorModel sensors_;
  CanPort& port_;
  FrameSender sender_;
  std::uint32_t profile_hash_;
  std::array<dbc::RawState, kAxisCount> stroke_state_{};
  E2eState command_e2e_;
  bool enabled_ = false;
  bool command_alive_ = false;
  TimeUs last_command_us_ = 0;
  CommandCounters counters_;
  std::uint64_t cycle_ = 0;
};

}  // namespace graben::plant
