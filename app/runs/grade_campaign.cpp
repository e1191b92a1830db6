#include "app/runs/grade_campaign.hpp"

#include "app/runs/campaign_figures.hpp"

namespace graben::runs {
namespace {

const std::vector<CampaignFigure<GradeSummary>>& grade_figures() {
  using S = GradeSummary;
  static const std::vector<CampaignFigure<S>> all = {
      {{"max_error_true_m", "true edge over the grade, max", "mm", kMilli},
       [](const S& s) { return s.max_error_true_m; }},
      {{"rmse_error_true_m", "true edge over the grade, RMSE", "mm", kMilli},
       [](const S& s) { return s.rmse_error_true_m; }},
      {{"max_error_measured_m", "measured edge over the grade, max", "mm", kMilli},
       [](const S& s) { return s.max_error_measured_m; }},
      {{"time_s", "time for the grade", "s", 1.0}, [](const S& s) { return s.time_s; }},
      {{"flow_share_max", "required flow over the available, max", "%", kPercent},
       [](const S& s) { return s.flow_share_max; }},
      {{"flow_above", "time with more than 102 % of it", "%", kPercent},
       [](const S& s) { return s.flow_above_share; }},
      {{"flow_occasions", "occasions of that", "", 1.0},
       [](const S& s) { return static_cast<double>(s.flow_occasions); }},
      {{"deceleration_wanted_mps2", "deceleration of the wanted speed, max", "m/s2", 1.0},
       [](const S& s) { return s.deceleration_wanted_mps2; }},
      {{"deceleration_true_mps2", "deceleration of the machine, max", "m/s2", 1.0},
       [](const S& s) { return s.deceleration_true_mps2; }},
      {{"sign_changes", "turns of the wanted speed", "", 1.0},
       [](const S& s) { return static_cast<double>(s.sign_changes); }},
  };
  return all;
}

}  // namespace

const CampaignKind& grade_campaign() {
  // In the order of GradeEnd.
  static const CampaignKind kind = {
      "grade", {"done", "not-finished", "fault"}, columns_of(grade_figures())};
  return kind;
}

CampaignRow grade_campaign_row(const machines::SimulatedDozer& machine, const GradeResult& result) {
  return campaign_row(grade_figures(), static_cast<std::size_t>(result.end),
                      summarise(machine, result));
}

}  // namespace graben::runs
