// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <vector>

#include "app/machines/dozer_file.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/machines/task_file.hpp"
#include "firmware/dozer/grade_profile.hpp"
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
  return {profile, machines::load_tasks({"truck_by_steps", "flatten"}, {folder}, profile).book};
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

/// The same design, as the application hands it over from a surface however many triangles it has:
/// as many heights as there may be, which stay where they are.
DozerProfile with_heights(DozerProfile profile) {
  static const std::vector<double> heights = [&profile] {
    const GradeProfile design(profile.grade);
    std::vector<double> all(GradeHeights::kMost);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] = design.at(profile.grade.begin_m() + GradeHeights::kStep_m * static_cast<double>(i))
                   .height_m;
    }
    return all;
  }();
  GradeDesign& grade = profile.grade;
  grade.heights = {heights.data(), nullptr, GradeHeights::kMost, grade.begin_m()};
  grade.count = 0;
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
  static const DozerProfile surface = with_heights(shipped);
  return setup == Setup::kDozerBumps ? bumps : setup == Setup::kDozerSurface ? surface : shipped;
}

}  // namespace graben::timing
