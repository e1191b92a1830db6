// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Machines, tasks and text for the page, before the first frame: `Setup` and `Machine` of
/// app/scope/page/src/model/api.ts. Lengths in m, angles in rad, in the ground frame where it says
/// so: an excavator's origin is where its swing axis meets the ground.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/task_file.hpp"

namespace graben::reports {

struct SetupOptions {
  /// A profile beside the shipped ones: file or shipped name. Comes first.
  std::optional<std::string> profile;
  /// Tasks that the controller was given, by their number: files or shipped names. None: what is
  /// shipped and can be planned on the machine, in the order of the names.
  std::vector<std::string> tasks;
  /// A bus profile beside the shipped ones, for machines that were put on it: a file or a shipped
  /// name.
  std::optional<std::string> bus = std::nullopt;
  /// A dozer with a design of its own, in the place of `profile`.
  std::optional<machines::SimulatedDozer> designed = std::nullopt;
};

/// {"machines": [...], "buses": [...], "words": {...}, "version": "..."}, the same whatever the
/// frames come from. Throws std::runtime_error with what is wrong with a profile or a task. Tasks
/// that are told must all fit one machine, with a profile that one.
[[nodiscard]] nlohmann::json shared_setup(const SetupOptions& options);

/// `Bus` without its name: what tells links, joints or strokes.
[[nodiscard]] nlohmann::json bus_json(const BusTable& bus);

/// `Words`.
[[nodiscard]] nlohmann::json text_json();

/// `tasks` by the number that they have on the bus, read for this machine. The ground is where the
/// tracks stand; a simulated machine's where its soil is: ground that is cut, or else that of its
/// experiment.
[[nodiscard]] nlohmann::json machine_json(const machines::ExcavatorMachine& machine,
                                          const std::vector<machines::TaskFile>& tasks);
[[nodiscard]] nlohmann::json machine_json(const machines::SimulatedExcavator& machine,
                                          const std::vector<machines::TaskFile>& tasks);
/// The grade is the design's whole length; a simulated machine's that of its experiment.
[[nodiscard]] nlohmann::json machine_json(const machines::DozerMachine& machine);
[[nodiscard]] nlohmann::json machine_json(const machines::SimulatedDozer& machine);

/// `Task`, with the fences as `task` has them planned.
[[nodiscard]] nlohmann::json task_json(const machines::TaskFile& task,
                                       const ExcavatorProfile& profile);

/// Rounded to a micrometre, or whatever a millionth of the unit is: a double that is written in
/// full costs three times as much to send.
[[nodiscard]] double rounded(double value);

}  // namespace graben::reports
