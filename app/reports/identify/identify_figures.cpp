// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/identify/file/identified_file.hpp"
#include "app/machines/answer_section.hpp"
#include "app/reports/identify/identify_report.hpp"

namespace graben::reports {
namespace {

using identify::kAxisTexts;
using identify::PredictionScore;
using identify::SideScore;
using nlohmann::ordered_json;

constexpr double kPercent = 100.0;

/// To whole steps; what is shown as 0 is not shown as -0.
double without_sign_of_0(double value, double step) {
  return std::round(value / step) * step + 0.0;
}

/// Whether a row that is shown has a figure that is not there.
bool has_open(const std::vector<ScoreColumn>& columns) {
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    for (const bool extends : {true, false}) {
      for (const ScoreColumn& column : columns) {
        const SideScore& side = column.score->axis[k].side(extends);
        const bool is_shown = columns.front().score->axis[k].side(extends).moving_s > 0.0;
        if (is_shown && !(side.has_ratio && side.has_delay)) {
          return true;
        }
      }
    }
  }
  return false;
}

std::string side_row(const std::vector<ScoreColumn>& columns, std::size_t k, bool extends) {
  std::string row = fmt::format("{:<16}", machines::side_name(static_cast<int>(k), extends));
  for (const ScoreColumn& column : columns) {
    const SideScore& side = column.score->axis[k].side(extends);
    row += fmt::format("  {:>8.1f} {:>7.3f}", 1e3 * side.rms_mps, side.r2);
    row += side.has_ratio ? fmt::format(" {:>+7.1f}",
                                        without_sign_of_0(kPercent * (side.speed_ratio - 1.0), 0.1))
                          : fmt::format(" {:>7}", "-");
    row += side.has_delay ? fmt::format(" {:>+6.0f}", without_sign_of_0(1e3 * side.late_s, 1.0))
                          : fmt::format(" {:>6}", "-");
  }
  return row + "\n";
}

ordered_json side_json(const SideScore& side) {
  ordered_json json = {{"moving_s", side.moving_s}, {"rms_mps", side.rms_mps}, {"r2", side.r2}};
  json["speed_ratio"] = side.has_ratio ? ordered_json(side.speed_ratio) : ordered_json();
  json["late_s"] = side.has_delay ? ordered_json(side.late_s) : ordered_json();
  return json;
}

ordered_json score_json(const PredictionScore& score) {
  ordered_json axes;
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    if (k == kSwing && score.axis[k].speed_mps2 == 0.0) {
      continue;
    }
    axes[kAxisTexts[k]]["error_share"] = score.axis[k].share();
    for (const bool extends : {true, false}) {
      const SideScore& side = score.axis[k].side(extends);
      axes[kAxisTexts[k]][machines::side_word(static_cast<int>(k), extends)] =
          side.moving_s > 0.0 ? side_json(side) : ordered_json();
    }
  }
  return {{"error_share", score.share()}, {"axes", axes}};
}

ordered_json coast_json(const identify::SwingCoast& coast) {
  return coast.known ? ordered_json{{"from_radps", coast.from_radps},
                                    {"angle_rad", coast.angle_rad},
                                    {"time_s", coast.time_s},
                                    {"most_pa", coast.most_pa}}
                     : ordered_json();
}

ordered_json swing_json(const identify::SwingFigures& swing) {
  const auto value = [](const identify::Estimate& of) {
    return of.known ? ordered_json{{"value", of.value}, {"deviation", of.deviation}}
                    : ordered_json();
  };
  return {{"inertia_kgm2", value(swing.inertia_kgm2)},
          {"friction_nm", value(swing.friction_nm)},
          {"coasts_left", coast_json(swing.left)},
          {"coasts_right", coast_json(swing.right)}};
}

}  // namespace

std::string prediction_table(const std::vector<ScoreColumn>& columns) {
  std::string text = fmt::format("{:<16}", "speed");
  for (const ScoreColumn& column : columns) {
    text += fmt::format("  {:-^31}", " " + column.title + " ");
  }
  text += fmt::format("\n{:<16}", "");
  for (std::size_t n = 0; n < columns.size(); ++n) {
    text += fmt::format("  {:>8} {:>7} {:>7} {:>6}", "RMS mm/s", "R2", "speed %", "ms");
  }
  text += "\n";
  for (std::size_t k = 0; k < kDriveCount; ++k) {
    for (const bool extends : {true, false}) {
      if (columns.front().score->axis[k].side(extends).moving_s > 0.0) {
        text += side_row(columns, k, extends);
      }
    }
  }
  text += "(speed: measured over predicted, less 1; ms: later than predicted)\n";
  if (has_open(columns)) {
    text +=
        "(-: not to be judged: no steady speed above 40 mm/s for long enough, or of ms no start or "
        "stop that shows it)\n";
  }
  return text;
}

std::string prediction_json(const std::vector<ScoreColumn>& columns) {
  ordered_json json;
  for (const ScoreColumn& column : columns) {
    json[column.title] = score_json(*column.score);
  }
  return json.dump(2) + "\n";
}

std::string identify_json(const IdentifyReport& report) {
  ordered_json json;
  json["profile"] = report.machine.name;
  json["from"] = report.from;
  for (const identify::MachineLog& log : report.logs) {
    json["logs"].push_back({{"name", log.name},
                            {"sha256", log.sha256},
                            {"length_s", log.length_s()},
                            {"pieces", log.segments.size()},
                            {"frames", log.frames},
                            {"refused", log.refused}});
  }
  json["fitted_s"] = report.fit.fitted_s;
  json["judged_s"] = report.fit.judged_s;
  json["old"] = score_json(report.fit.before);
  json["new"] = score_json(report.fit.left_out);
  json["all"] = score_json(report.fit.after);
  json["values"] = ordered_json::array();
  for (const identify::ValueChange& change : identify::value_changes(report.machine, report.fit)) {
    json["values"].push_back({{"key", change.key},
                              {"before", change.before},
                              {"after", change.after},
                              {"deviation", change.deviation}});
  }
  if (report.machine.profile.has_swing()) {
    json["swing"] = swing_json(report.fit.machine.swing);
  }
  json["missing"] = report.fit.machine.missing;
  // A byte of a file's name that is no UTF-8 must not cost the figures.
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace graben::reports
