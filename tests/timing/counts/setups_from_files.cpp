// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "app/machines/dozer_file.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/machines/task_file.hpp"
#include "tests/timing/counts/setups.hpp"

namespace graben::timing {
namespace {

ExcavatorSetup without_tasks() {
  return machines::load_excavator(machines::find_profile("excavator_22t")).profile;
}

ExcavatorSetup with_tasks() {
  const ExcavatorProfile profile =
      machines::load_excavator(machines::find_profile("excavator_12t")).profile;
  const std::filesystem::path folder = machines::find_task("flatten").parent_path();
  return {profile, machines::load_tasks({"truck_by_steps", "flatten"}, {folder}, profile)};
}

/// Down and up by turns, as steep as the 9 t machine still takes.
DozerProfile with_bumps(DozerProfile profile) {
  constexpr double kApart_m = 1.2;
  constexpr double kDeep_m = 0.12;
  GradeDesign& grade = profile.grade;
  grade.count = GradeDesign::kMostPoints;
  for (int i = 0; i < grade.count; ++i) {
    grade.point[static_cast<unsigned>(i)] = {kApart_m * i, i % 2 == 0 ? 0.0 : -kDeep_m};
  }
  return profile;
}

}  // namespace

const ExcavatorSetup& excavator_setup(Setup setup) {
  static const ExcavatorSetup plain = without_tasks();
  static const ExcavatorSetup swinging = with_tasks();
  return setup == Setup::kExcavator12t ? swinging : plain;
}

const DozerProfile& dozer_setup(Setup setup) {
  static const DozerProfile shipped =
      machines::load_dozer(machines::find_profile("dozer_9t")).profile;
  static const DozerProfile bumps = with_bumps(shipped);
  return setup == Setup::kDozerBumps ? bumps : shipped;
}

}  // namespace graben::timing
