// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben check`: what a profile means, and what in it is allowed but implausible. SI units unless
/// a name says another; lengths in m over the ground, forward of the swing axis or of the mass
/// centre.

#include <cstdint>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"

namespace graben::reports {

struct FactTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::string note;
};

/// A value that is allowed and yet not what a machine has.
struct Warning {
  std::string key;
  std::string text;  ///< The value, what it makes, what is usual.
};

struct MachineCheck {
  std::string name;
  std::string kind;
  std::uint32_t hash = 0;
  std::vector<FactTable> tables;
  std::vector<Warning> warnings;
  std::string drawing;  ///< SVG: side view.
};

/// `simulated` where NAME.sim.toml is there: without it what hangs on masses and oil is left out,
/// and the table says so.
[[nodiscard]] MachineCheck check_machine(const machines::ExcavatorMachine& machine,
                                         const machines::SimulatedExcavator* simulated);
[[nodiscard]] MachineCheck check_machine(const machines::DozerMachine& machine,
                                         const machines::SimulatedDozer* simulated);

/// Each side of each spool.
[[nodiscard]] FactTable answer_table(const machines::ExcavatorMachine& machine);
/// Sensors and signals that it does without, what stands in, what is not seen, what it costs.
[[nodiscard]] FactTable capability_table(const ExcavatorProfile& profile);
/// How long a joint's sensor may lie, and how far the tool is off by then.
[[nodiscard]] FactTable lie_table(const ExcavatorProfile& profile);
/// What the check at the mark sees of each sensor; with no row where there is no mark.
[[nodiscard]] FactTable mark_table(const ExcavatorProfile& profile);
[[nodiscard]] FactTable provenance_table(const std::vector<machines::Provenance>& provenance);

/// Where the teeth can be, over the ground.
struct Reach {
  Eigen::Vector2d foot_m = Eigen::Vector2d::Zero();
  /// By direction from the boom foot, in steps of kReachStep_rad from -pi: nearest and farthest.
  std::vector<double> nearest_m;
  std::vector<double> farthest_m;
  double most_x_m = 0.0;
  double ground_x_m = 0.0;
  double least_y_m = 0.0;
  double most_y_m = 0.0;
};
[[nodiscard]] Reach reach_of(const ExcavatorGeometry& geometry);

/// Natural frequencies of the links on their oil at these strokes, valves shut; Hz, ascending.
[[nodiscard]] Eigen::Vector3d linkage_modes_hz(const plant::ExcavatorPlantProfile& plant,
                                               const Eigen::Vector3d& strokes_m);
/// The slowest of them along the digging path.
[[nodiscard]] double lowest_mode_hz(const machines::SimulatedExcavator& machine);

/// Flow of a pump at full swash and its speed at work; m3/s.
[[nodiscard]] double full_flow_m3ps(const PumpProfile& pump);

[[nodiscard]] std::vector<Warning> excavator_warnings(
    const machines::ExcavatorMachine& machine, const machines::SimulatedExcavator* simulated);
[[nodiscard]] std::vector<Warning> dozer_warnings(const machines::DozerMachine& machine,
                                                  const machines::SimulatedDozer* simulated);

[[nodiscard]] std::string excavator_drawing(const ExcavatorProfile& profile, const Reach& reach);
[[nodiscard]] std::string dozer_drawing(const DozerProfile& profile);

/// For a terminal.
[[nodiscard]] std::string check_text(const MachineCheck& check);
/// One page that needs no network.
[[nodiscard]] std::string check_page(const MachineCheck& check);

}  // namespace graben::reports
