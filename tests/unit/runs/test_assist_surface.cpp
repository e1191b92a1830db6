// SPDX-License-Identifier: Apache-2.0
/// Task Assist on grounds of heights on a grid, against the true ground.

#include "app/machines/profile_file.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/assist_run.hpp"
#include "tests/unit/cmocka_cpp.hpp"

const machines::SimulatedExcavator& machine() {
  static const machines::SimulatedExcavator of =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  return of;
}

runs::AssistSummary summary_on(const runs::AssistOptions& options) {
  const runs::AssistResult result = runs::run_assist(machine(), options);
  assert_int_equal(result.end, runs::AssistEnd::kDone);
  assert_near(result.summary.unsaid_s, 0.0, 0.0);
  return result.summary;
}

/// As heights, level ground is followed as its plane is; a V ditch, which the edge enters on one
/// side and leaves on the other, within 25 mm, at a third of the lever within 20.
TEST(a_ditch_is_followed_as_a_plane_is) {
  const auto grounds = runs::assist_grounds(machine().profile);
  assert_int_equal(grounds.size(), 3);
  runs::AssistOptions options;
  const runs::AssistSummary plane = summary_on(options);
  options.ground = grounds[0];
  const runs::AssistSummary level = summary_on(options);
  assert_near(level.rmse_m, plane.rmse_m, 1e-3);
  assert_near(level.time_ratio, plane.time_ratio, 0.02);
  options.ground = grounds[2];
  for (const auto& [record, most_m] :
       {std::pair(runs::LeverRecord::kFull, 0.025), std::pair(runs::LeverRecord::kThird, 0.02)}) {
    options.record = record;
    const runs::AssistSummary ditch = summary_on(options);
    print_message("%.1f mm RMSE, %.1f mm max, %.1f mm deep\n", 1e3 * ditch.rmse_m,
                  1e3 * ditch.most_off_m, 1e3 * ditch.over_cut_m);
    assert_true(ditch.rmse_m < 0.012 && ditch.rmse_m > 1e-4);
    assert_true(ditch.most_off_m < most_m);
    assert_true(ditch.over_cut_m < 0.02);
  }
}
