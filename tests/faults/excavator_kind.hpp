// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator, as the rows need a machine kind.

#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "app/plant/random.hpp"
#include "app/runs/excavator_rig.hpp"
#include "tests/faults/bus_record.hpp"
#include "tests/faults/frames.hpp"
#include "tests/faults/rolling_watch.hpp"

namespace graben::faults {

struct Excavator : runs::ExcavatorSim {
  using Plant = plant::ExcavatorPlant;
  static constexpr const char* kProfile = "excavator_22t";
  static constexpr Task kTask = Task::kDig;

  static constexpr unsigned kAxes = kAxisCount;
  using AxisArray = std::array<double, kAxes>;
  /// What is compared with the undisturbed run, m.
  static constexpr unsigned kPlaces = kAxisCount;
  using PlaceArray = std::array<double, kPlaces>;

  /// After the task has begun, within these the fault comes.
  static constexpr TimeUs kFirstInjection_us = 2 * kSecondUs;
  static constexpr TimeUs kLastInjection_us = 6 * kSecondUs;
  static constexpr TimeUs kLongestBaseline_us = 14 * kSecondUs;
  /// A field that wants less says nothing of whether it is slower.
  static constexpr double kMoving_mps = 0.08;
  /// What one lost frame may move the machine by, against the undisturbed run.
  static constexpr double kLittle_m = 0.015;
  /// Within this a spool is opened wide.
  static constexpr TimeUs kOpensWithin_us = 6 * kSecondUs;
  /// After the detection of what only slows: until it is slower; and from its end until it is not.
  static constexpr TimeUs kSlows_us = 30 * kMillisecondUs;
  static constexpr TimeUs kBack_us = 1300 * kMillisecondUs;
  static constexpr TimeUs kStuckStroke_us = 3 * kSecondUs;

  struct Scenery {
    Machine machine;
    Eigen::Vector3d start_strokes_m = Eigen::Vector3d::Zero();
    double start_swing_rad = 0.0;
  };
  /// Of a seed: sensors wrong in all, parameters too in every second, soil in half of them, a
  /// random pose near the path.
  [[nodiscard]] static Scenery scenery_of(std::uint64_t seed);
  /// The same, and it can hardly move: a rock in the way; a transmission too weak to roll.
  [[nodiscard]] static Scenery stall_scenery_of(std::uint64_t seed);
  /// The same with IMUs on its links instead of stroke sensors, all errors.
  [[nodiscard]] static Scenery imu_scenery_of(std::uint64_t seed);
  /// The same, all errors, on a shipped bus profile (empty: ours) and, if told, in soil, and with
  /// second sensors.
  [[nodiscard]] static Scenery found_scenery_of(std::uint64_t seed, const std::string& bus,
                                                bool soil = false, bool seconds = false);
  /// The 12 t machine, whose platform turns, where its program 0 begins.
  [[nodiscard]] static Scenery swinging_scenery_of(std::uint64_t seed, bool seconds = false);
  /// With program 0 where the platform turns.
  [[nodiscard]] static Setup setup_of(const Machine& machine);
  /// Of another bus than ours; empty: none.
  [[nodiscard]] static const BusTable* table(const Machine& machine) { return &machine.bus; }
  [[nodiscard]] static Node node(const Scenery& scenery, CanPort& port);
  [[nodiscard]] static std::vector<Defect> defects();
  /// Throws ProfileError as the loader does.
  static void load(const std::filesystem::path& file) {
    static_cast<void>(machines::load_excavator(file));
  }

  /// Frames that the machine cannot be run without, and those without which it is slower.
  [[nodiscard]] static const std::vector<Sensor>& vital();
  [[nodiscard]] static const std::vector<Sensor>& slowing();
  [[nodiscard]] static std::vector<Sensor> strokes();
  /// All that the controller receives with counter and CRC, and what it sends so.
  [[nodiscard]] static const std::vector<std::uint32_t>& protected_ids();
  [[nodiscard]] static const std::vector<std::uint32_t>& command_ids();
  /// Whether it shows another value each time that it is read.
  [[nodiscard]] static bool is_read(std::uint32_t id);
  [[nodiscard]] static const std::vector<Fault>& missing();

  /// Takes in one frame of a command; false if it is none.
  [[nodiscard]] static bool read_command(const CanFrame& frame, BusRecord::Command& command);
  static constexpr int kCommandFrames = 1;
  /// Of all cylinders together, as the field wants them.
  [[nodiscard]] static double wanted_mps(const CanFrame& motion);
  /// The most that may be wanted, so long after something that slows it was detected.
  [[nodiscard]] static double slowed_mps(const Machine& machine, double before_mps,
                                         TimeUs after_us);
  [[nodiscard]] static bool is_back(double slow_mps, double wanted_mps, Limit limit);

  [[nodiscard]] static bool enabled(const Node& node) { return node.spools_enabled(); }
  [[nodiscard]] static AxisArray strokes_m(const Plant& plant) { return plant.strokes_m(); }
  [[nodiscard]] static AxisArray longest_m(const Plant& plant);
  [[nodiscard]] static AxisArray spools(const Plant& plant) { return plant.spool_travels_ratio(); }
  /// Within which no spool opens, whichever way.
  [[nodiscard]] static double deadband(const Plant& plant);
  /// Duty at which the controller takes a spool to open.
  [[nodiscard]] static double first_duty(const Machine& machine) {
    return machine.profile.valve.spool_to_duty.y_first();
  }
  [[nodiscard]] static PlaceArray places_m(const Plant& plant) { return plant.strokes_m(); }
  [[nodiscard]] static std::optional<Rolling> rolling(const Plant&) { return std::nullopt; }
  /// Told to be neutral, nothing of it broken.
  static void make_neutral_and_sound(Plant& plant);
  [[nodiscard]] static AxisArray duties(const ExcavatorOutputs& outputs) {
    return {outputs.duty_ratio[kBoom], outputs.duty_ratio[kArm], outputs.duty_ratio[kBucket]};
  }
  /// Of their travel, dead bands and all.
  [[nodiscard]] static AxisArray real_spools(const Plant& plant) {
    return plant.spool_travels_ratio();
  }
  [[nodiscard]] static double heard_stroke_m(const ExcavatorInputs& inputs, unsigned axis) {
    return inputs.axis[axis].stroke_m.value;
  }
  [[nodiscard]] static plant::AxisFaults& axis(Node& node, unsigned axis) {
    return node.faults().axis[axis];
  }
  [[nodiscard]] static Reading any_reading(Node& node, plant::Random& random);
  /// All that the controller keeps from cycle to cycle, and its size in bytes.
  static std::pair<void*, std::size_t> memory(Ecu& ecu);
};

}  // namespace graben::faults
