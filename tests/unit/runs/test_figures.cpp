// SPDX-License-Identifier: Apache-2.0
/// Tables of figures: what every output takes from them.

#include "app/runs/figures.hpp"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "app/runs/autodig_run.hpp"
#include "app/runs/campaign_file.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/grade_run.hpp"
#include "app/runs/held_lately.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::runs;

template <class Summary>
void assert_sound(const FigureTable<Summary>& table) {
  std::set<std::string> names;
  std::set<std::string> texts;
  std::set<std::string> columns;
  std::size_t kept = 0;
  for (const Figure<Summary>& figure : table) {
    names.insert(figure.info.name);
    texts.insert(figure.info.text);
    assert_true(std::string(figure.info.text).size() < kFigureTextWidth);
    if (figure.info.column != nullptr) {
      columns.insert(figure.info.column);
      ++kept;
    }
  }
  assert_int_equal(names.size(), table.size());
  assert_int_equal(texts.size(), table.size());
  assert_int_equal(columns.size(), kept);
}

TEST(no_two_figures_have_one_name) {
  assert_sound(dig_figures());
  assert_sound(grade_figures());
  assert_sound(autodig_figures());
}

std::string header(const std::vector<const FigureInfo*>& columns) {
  std::string names;
  for (const FigureInfo* column : columns) {
    names += std::string(names.empty() ? "" : ",") + column->column;
  }
  return names;
}

/// Campaigns that were begun go on, and their files are read by others.
TEST(a_campaigns_columns_stay_as_they_are) {
  assert_string_equal(header(columns_of(dig_figures())).c_str(),
                      "max_error_true_m,rmse_error_true_m,max_error_measured_m,"
                      "rmse_error_measured_m,lambda_min,lambda_mean,lambda_below_1,regeneration,"
                      "loop_s,approach_s,peak_chamber_pressure_pa,lambda_held,off_field_max_rad,"
                      "ringing_max_rad,recovery_error_max_m,lambda_variation_ps,"
                      "spool_travel_boom_ps,spool_travel_arm_ps,spool_travel_bucket_ps,"
                      "spool_reversals_boom_ps,spool_reversals_arm_ps,spool_reversals_bucket_ps,"
                      "tip_jerk_rms_mps3,ringing_rms_m,energy_per_loop_j,energy_j,"
                      "energy_bypass_relief,swash_mean,duty_travel_boom_ps,duty_travel_arm_ps,"
                      "duty_sign_changes_boom_ps,duty_sign_changes_arm_ps");
  assert_string_equal(header(columns_of(grade_figures())).c_str(),
                      "max_error_true_m,rmse_error_true_m,max_error_measured_m,time_s,"
                      "flow_share_max,flow_above,flow_occasions,deceleration_wanted_mps2,"
                      "deceleration_true_mps2,sign_changes,lambda_variation_ps,spool_travel_ps,"
                      "spool_reversals_ps,edge_jerk_rms_mps3,"
                      "passes,ground_left_m,over_cut_m,halt_s");
}

struct Made {
  double error_m = 0.0;
  double lambda = 0.0;
  RunPace pace;
  LimitShares limit_share;
};

const FigureTable<Made>& made_figures() {
  static const FigureTable<Made> table = with_pace<Made>({
      {{"error_m", "error", kMillimetres, "error"}, [](const Made& m) { return m.error_m; }},
      {{"lambda", "lambda, min", kRatio, "lambda", BadEnd::kLow},
       [](const Made& m) { return m.lambda; }},
  });
  return table;
}

RunFigures made(double error_m, double lambda) {
  Made summary;
  summary.error_m = error_m;
  summary.lambda = lambda;
  summary.pace.cycles = 7;
  summary.limit_share = {{"none", 0.25}};
  return figures_of(made_figures(), summary, "share of time per limit");
}

TEST(a_text_has_each_figure_in_its_unit) {
  const std::string text = figures_text(made(0.0123, kAbsent));
  assert_non_null(
      strstr(text.c_str(), "error                                                   12.3 mm\n"));
  assert_null(strstr(text.c_str(), "lambda"));
  assert_non_null(
      strstr(text.c_str(), "control cycles                                             7\n"));
  assert_non_null(strstr(text.c_str(), "share of time per limit\n  none"));
  assert_non_null(strstr(text.c_str(), "25.0 %\n"));
}

TEST(a_row_has_what_has_a_column) {
  const CampaignRow done = campaign_row(0, made(0.5, 0.25));
  assert_int_equal(done.figure.size(), 2);
  assert_near(done.figure[0] + done.figure[1], 0.75, 0.0);
  const CampaignRow failed = campaign_row(1, made(0.5, 0.25));
  assert_int_equal(failed.figure.size(), 2);
  assert_true(std::isnan(failed.figure[0]) && std::isnan(failed.figure[1]));
}

TEST(a_campaign_tells_the_bad_end) {
  const CampaignKind kind = {"made", {"done", "fault"}, columns_of(made_figures())};
  CampaignData data;
  data.tried = "made";
  for (int i = 1; i <= 100; ++i) {
    data.rows[static_cast<std::uint64_t>(i)] = campaign_row(0, made(1e-3 * i, 1e-2 * i));
  }
  const std::string table = campaign_table(kind, data);
  assert_non_null(strstr(table.c_str(), "    50.000    95.000   100.000 mm\n"));
  assert_non_null(strstr(table.c_str(), "     0.500     0.050     0.010 (p5, min)\n"));
}

/// Of 20 s: pump flow first, then for the last 5 s before it stops the boom's back flow, a fifth of
/// it the bucket's.
TEST(a_stall_says_what_it_lacked) {
  std::vector<DigSample> samples;
  for (int n = 0; n < 2000; ++n) {
    DigSample sample;
    sample.time_s = 0.01 * n;
    const bool early = n < 1300;
    const bool over = n >= 1900;
    sample.limit = over    ? graben::Limit{}
                   : early ? graben::Limit{graben::LimitKind::kPumpFlow, 0}
                           : graben::Limit{graben::LimitKind::kBackFlow,
                                           static_cast<std::uint8_t>(n % 5 == 0 ? 2 : 0)};
    samples.push_back(sample);
  }
  const ActuatorNames& names = excavator_actuators();
  assert_string_equal(held_lately(graben::Fault::kStalled, samples, names).c_str(),
                      ", held by back flow: boom 80 %, back flow: bucket 20 %");
  assert_string_equal(held_lately(graben::Fault::kPathLeft, samples, names).c_str(), "");
  assert_string_equal(
      held_lately(graben::Fault::kStalled, std::vector<DigSample>(9), names).c_str(), "");
}
