// SPDX-License-Identifier: Apache-2.0
/// Task Assist on grounds of heights on a grid, against the true ground.

#include "app/machines/profile_file.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/runs/assist_run.hpp"
#include "app/runs/assist_way.hpp"
#include "app/runs/scenarios.hpp"
#include "firmware/excavator/motion/program/drive_plan.hpp"
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

/// Let go, the edge is within 15 mm of where it comes to rest in 0.2 s, and off its design by no
/// more; ringing goes on longer.
TEST(let_go_the_edge_stands) {
  runs::AssistOptions options;
  options.record = runs::LeverRecord::kReleases;
  const runs::AssistSummary summary = summary_on(options);
  print_message("%.2f s, %.2f s with ringing, %.1f mm off\n", summary.halt_s, summary.stop_s,
                1e3 * summary.stop_off_m);
  assert_true(summary.halt_s > 0.05 && summary.halt_s <= 0.2);
  assert_true(summary.stop_s > summary.halt_s && summary.stop_s < 1.0);
  assert_true(summary.stop_off_m < 0.015);
}

/// A 12 t machine whose boom's pressure rings, which lambda followed and so fed: 14 mm of wave with
/// the profile's own reserve.
TEST(lambda_does_not_feed_a_ringing_boom) {
  const machines::SimulatedExcavator small =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  runs::TaskScenario scenario;
  scenario.errors = "all";
  scenario.seed = 3;
  runs::AssistOptions options;
  options.seed = 3;
  options.ground = runs::assist_grounds(small.profile)[0];
  const runs::AssistResult result = runs::run_assist(runs::arranged(small, scenario), options);
  assert_int_equal(result.end, runs::AssistEnd::kDone);
  print_message("%.1f mm of wave\n", 1e3 * result.summary.wave_rms_m);
  assert_true(result.summary.wave_rms_m > 1e-4 && result.summary.wave_rms_m < 0.006);
}

/// Never faster than the arm's lever alone, in proportion to it where flow suffices; where boom and
/// bucket share a pump that lifts, less.
TEST(flow_bounds_the_edge) {
  const machines::SimulatedExcavator small =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  for (const machines::SimulatedExcavator* of : {&machine(), &small}) {
    const ExcavatorKinematics kinematics(of->profile.geometry);
    const runs::Way way = runs::way_of(of->profile, {});
    const runs::FastestByFlow full(*of, way, 1.0);
    const runs::FastestByFlow third(*of, way, 1.0 / 3.0);
    double least = 1.0;
    for (double out_m = 0.0; out_m <= way.length_m(); out_m += way.length_m() / 24.0) {
      const double arm = std::abs(
          kinematics.motion_from_pose(way.at(out_m), {way.along().x(), way.along().y(), 0.0}, {})
              .strokes_rate[kArm]);
      const double alone_mps = drive_limits(of->profile).speed_out[kArm] / arm;
      for (const bool inwards : {false, true}) {
        const double share = full.mps(out_m, inwards) / alone_mps;
        assert_true(share > 0.5 && share < 1.0 + 1e-9);
        assert_near(third.mps(out_m, inwards), alone_mps / 3.0, 1e-9);
        least = std::min(least, share);
      }
    }
    assert_true(of == &small ? least < 0.9 : least > 0.9);
  }
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
