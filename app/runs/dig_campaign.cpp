#include "app/runs/dig_campaign.hpp"

#include "app/runs/campaign_figures.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

constexpr double kMega = 1e-6;

const std::vector<CampaignFigure<DigSummary>>& dig_figures() {
  using S = DigSummary;
  static const std::vector<CampaignFigure<S>> all = {
      {{"max_error_true_m", "path error of the true tip, max", "mm", kMilli},
       [](const S& s) { return s.max_error_true_m; }},
      {{"rmse_error_true_m", "path error of the true tip, RMSE", "mm", kMilli},
       [](const S& s) { return s.rmse_error_true_m; }},
      {{"max_error_measured_m", "path error of the measured tip, max", "mm", kMilli},
       [](const S& s) { return s.max_error_measured_m; }},
      {{"rmse_error_measured_m", "path error of the measured tip, RMSE", "mm", kMilli},
       [](const S& s) { return s.rmse_error_measured_m; }},
      {{"lambda_min", "lambda, min", "", 1.0}, [](const S& s) { return s.lambda_min; }},
      {{"lambda_mean", "lambda, mean", "", 1.0}, [](const S& s) { return s.lambda_mean; }},
      {{"lambda_below_1", "time with lambda below 1", "%", kPercent},
       [](const S& s) { return s.lambda_below_1_share; }},
      {{"regeneration", "time with a regeneration check open", "%", kPercent},
       [](const S& s) { return s.regeneration_share; }},
      {{"loop_s", "time round the path", "s", 1.0}, [](const S& s) { return s.loop_s; }},
      {{"approach_s", "time to reach the path", "s", 1.0}, [](const S& s) { return s.approach_s; }},
      {{"peak_chamber_pressure_pa", "highest chamber pressure", "MPa", kMega},
       [](const S& s) { return s.peak_chamber_pressure_pa; }},
      {{"lambda_held", "lambda while the obstacle holds, min", "", 1.0},
       [](const S& s) { return s.recovery ? s.recovery->lambda_held : kAbsent; }},
      {{"off_field_max_rad", "mean direction off the field afterwards, max", "deg", kDegreesPerRad},
       [](const S& s) { return s.recovery ? s.recovery->off_field_max_rad : kAbsent; }},
      {{"ringing_max_rad", "the same from cycle to cycle", "deg", kDegreesPerRad},
       [](const S& s) { return s.recovery ? s.recovery->ringing_max_rad : kAbsent; }},
      {{"recovery_error_max_m", "path error of the true tip afterwards, max", "mm", kMilli},
       [](const S& s) { return s.recovery ? s.recovery->error_max_m : kAbsent; }},

  };
  return all;
}

}  // namespace

const CampaignKind& dig_campaign() {
  // In the order of DigEnd.
  static const CampaignKind kind = {
      "dig", {"done", "path-not-reached", "loop-not-closed", "fault"}, columns_of(dig_figures())};
  return kind;
}

CampaignRow dig_campaign_row(const DigResult& result) {
  return campaign_row(dig_figures(), static_cast<std::size_t>(result.end), summarise(result));
}

}  // namespace graben::runs
