// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer, as the rows need a machine kind; what a member means stands in excavator_kind.hpp.

#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "app/plant/random.hpp"
#include "app/runs/dozer_rig.hpp"
#include "tests/faults/bus_record.hpp"
#include "tests/faults/frames.hpp"
#include "tests/faults/rolling_watch.hpp"

namespace graben::faults {

struct Dozer : runs::DozerSim {
  using Plant = plant::DozerPlant;
  static constexpr const char* kProfile = "dozer_9t";
  static constexpr Task kTask = Task::kGrade;

  static constexpr unsigned kAxes = 1;
  using AxisArray = std::array<double, kAxes>;
  /// Stroke of the blade, position of the body.
  static constexpr unsigned kPlaces = 2;
  using PlaceArray = std::array<double, kPlaces>;

  /// From the first acceleration to where it comes out of the trench's first part.
  static constexpr TimeUs kFirstInjection_us = 2500 * kMillisecondUs;
  static constexpr TimeUs kLastInjection_us = 20 * kSecondUs;
  static constexpr TimeUs kLongestBaseline_us = 24 * kSecondUs;
  static constexpr double kMoving_mps = 0.1;
  /// Of the body, most of all: two cycles' frames lost while it brakes were 4 mm (2026-11).
  static constexpr double kLittle_m = 0.010;
  /// From one slope of the design to the next.
  static constexpr TimeUs kOpensWithin_us = 15 * kSecondUs;
  /// It brakes for what slows it, and takes its time to get faster again.
  static constexpr TimeUs kSlows_us = 700 * kMillisecondUs;
  static constexpr TimeUs kBack_us = 1500 * kMillisecondUs;
  /// Its blade moves now and then, and a little at a time.
  static constexpr TimeUs kStuckStroke_us = 15 * kSecondUs;

  struct Scenery {
    Machine machine;
  };
  /// Of a seed: sensors wrong in all, in every second also mass, ground and transmission.
  [[nodiscard]] static Scenery scenery_of(std::uint64_t seed);
  /// The same, and it can hardly move: a rock in the way; a transmission too weak to roll.
  [[nodiscard]] static Scenery stall_scenery_of(std::uint64_t seed);
  [[nodiscard]] static Setup setup_of(const Machine& machine) { return machine.profile; }
  [[nodiscard]] static const BusTable* table(const Machine& /*machine*/) { return nullptr; }
  [[nodiscard]] static Node node(const Scenery& scenery, CanPort& port);
  [[nodiscard]] static std::vector<Defect> defects();
  /// Throws ProfileError as the loader does.
  static void load(const std::filesystem::path& file) {
    static_cast<void>(machines::load_dozer(file));
  }

  [[nodiscard]] static const std::vector<Sensor>& vital();
  [[nodiscard]] static const std::vector<Sensor>& slowing();
  [[nodiscard]] static std::vector<Sensor> strokes();
  [[nodiscard]] static const std::vector<std::uint32_t>& protected_ids();
  [[nodiscard]] static const std::vector<std::uint32_t>& command_ids();
  [[nodiscard]] static bool is_read(std::uint32_t id);
  [[nodiscard]] static const std::vector<Fault>& missing();

  /// Spool, pumps with brake, motors: neutral is all of them.
  [[nodiscard]] static bool read_command(const CanFrame& frame, BusRecord::Command& command);
  static constexpr int kCommandFrames = 3;
  /// v_c
  [[nodiscard]] static double wanted_mps(const CanFrame& motion);
  [[nodiscard]] static double slowed_mps(const Machine& machine, double before_mps,
                                         TimeUs after_us);
  [[nodiscard]] static bool is_back(double slow_mps, double wanted_mps, Limit limit);

  [[nodiscard]] static bool enabled(const Node& node) { return node.spools_enabled(); }
  [[nodiscard]] static AxisArray strokes_m(const Plant& plant) { return {plant.blade_stroke_m()}; }
  [[nodiscard]] static AxisArray longest_m(const Plant& plant);
  [[nodiscard]] static AxisArray spools(const Plant& plant) { return {plant.spool_travel_ratio()}; }
  [[nodiscard]] static double deadband(const Plant& plant) {
    return plant.profile().deadband_ratio;
  }
  [[nodiscard]] static double first_duty(const Machine& machine) {
    return machine.profile.implement.spool_to_duty.y_first();
  }
  [[nodiscard]] static PlaceArray places_m(const Plant& plant) {
    return {plant.blade_stroke_m(), plant.position_m()};
  }
  [[nodiscard]] static std::optional<Rolling> rolling(const Plant& plant);
  static void make_neutral_and_sound(Plant& plant);
  [[nodiscard]] static AxisArray duties(const DozerOutputs& outputs) {
    return {outputs.blade_duty_ratio};
  }
  /// Of its travel, dead band and all.
  [[nodiscard]] static AxisArray real_spools(const Plant& plant) {
    return {plant.spool_travel_ratio()};
  }
  [[nodiscard]] static double heard_stroke_m(const DozerInputs& inputs, unsigned) {
    return inputs.blade_stroke_m.value;
  }
  [[nodiscard]] static plant::DozerFaults& axis(Node& node, unsigned) { return node.faults(); }
  [[nodiscard]] static Reading any_reading(Node& node, plant::Random& random);
  /// All that the controller keeps from cycle to cycle, and its size in bytes.
  static std::pair<void*, std::size_t> memory(Ecu& ecu);
};

}  // namespace graben::faults
