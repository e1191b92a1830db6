// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/identify/verdict/verdict.hpp"

namespace graben::identify {
namespace {

constexpr double kBand = 1.96;

std::string duration(double seconds) {
  return seconds < 120.0 ? fmt::format("{:.1f} s", seconds)
                         : fmt::format("{:.1f} min", seconds / 60.0);
}

std::string table(const Verdict& verdict) {
  std::string text =
      "drive        R2: curve  ridge   dead time        lag     50, 90 %   edge +, -      "
      "fastest\n";
  for (std::size_t at = 0; at < verdict.drive.size(); ++at) {
    const DriveVerdict& of = verdict.drive[at];
    const DriveTrack& track = verdict.tracks.drive[at];
    if (!of.fitted) {
      continue;
    }
    if (!of.useful) {
      text += fmt::format("{:<12} {:>9.3f}  {:>5.3f}   does not follow its command\n", track.name(),
                          of.curve.judged_r2, of.ridge.judged_r2);
      continue;
    }
    const auto edge = [&](double side) {
      return of.curve.edge(side) == 0.0 ? std::string("-")
                                        : fmt::format("{:.0f}", 1e3 * of.curve.edge(side));
    };
    text += fmt::format(
        "{:<12} {:>9.3f}  {:>5.3f}   {:<15} {:>4.0f} ms  {:>4.0f}, {:<4.0f}  {:>4}, {:<4} "
        "of 1000  {:.3g} {}/s\n",
        track.name(), of.curve.judged_r2, of.ridge.judged_r2, dead_time_text(of.curve),
        1e3 * of.curve.lag_s, 1e3 * of.curve.half_s(), 1e3 * of.curve.most_s(), edge(1.0),
        edge(-1.0), track.figures.fastest, track.unit());
  }
  return text;
}

std::string listed(const std::string& title, const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) {
    text += fmt::format("{:<8} {}\n", text.empty() ? title : "", item);
  }
  return text;
}

nlohmann::ordered_json side_json(const CurveFit& fit, double side) {
  nlohmann::ordered_json json;
  const bool known = fit.fastest(side) != 0.0;
  json["driven"] = known;
  if (known) {
    json["edge_ratio"] = fit.edge(side) == 0.0 ? nlohmann::ordered_json(nullptr)
                                               : nlohmann::ordered_json(fit.edge(side));
    json["fastest"] = fit.fastest(side);
  }
  return json;
}

}  // namespace

std::string dead_time_text(const CurveFit& fit) {
  return fit.at_bound() ? fmt::format("{:.0f} ms, at bound", 1e3 * fit.dead_time_s)
                        : fmt::format("{:.0f} +- {:.0f} ms", 1e3 * fit.dead_time_s,
                                      kBand * 1e3 * fit.dead_time_deviation_s);
}

std::vector<std::string> content_sentences(const Verdict& verdict) {
  const Tracks& tracks = verdict.tracks;
  std::vector<std::string> all;
  all.push_back(fmt::format("{}; {} of motion, a row each {:.0f} ms{}", verdict.log.kind,
                            duration(tracks.length_s), 1e3 * tracks.recorded_s,
                            tracks.gaps == 0 ? std::string()
                                             : fmt::format("; {} gaps, the longest {}", tracks.gaps,
                                                           duration(tracks.longest_gap_s))));
  if (tracks.looked_s < 0.97 * tracks.length_s || tracks.step_s > 1.2 * tracks.recorded_s) {
    all.push_back(fmt::format("looked at: {}, a row each {:.0f} ms", duration(tracks.looked_s),
                              1e3 * tracks.step_s));
  }
  for (const std::string& note : verdict.log.notes) {
    all.push_back(note);
  }
  for (const std::string& note : tracks.notes) {
    all.push_back(note);
  }
  return all;
}

std::string tip_sentence(const Verdict& verdict) {
  if (!verdict.tip.known) {
    return "tip error: can't be said, as no boom, arm, bucket or blade follows its command here";
  }
  std::string parts;
  for (std::size_t at = 0; at < verdict.drive.size(); ++at) {
    if (verdict.drive[at].tip_m > 0.0) {
      parts += fmt::format("{}{} {:.0f}", parts.empty() ? "" : ", ",
                           verdict.tracks.drive[at].name(), 1e3 * verdict.drive[at].tip_m);
    }
  }
  return fmt::format(
      "tip error to be expected: {:.0f} mm RMS ({:.0f} .. {:.0f}), of which {} mm; {}",
      1e3 * verdict.tip.rms_m, 1e3 * verdict.tip.low_m, 1e3 * verdict.tip.high_m, parts,
      verdict.reach_told ? fmt::format("at a reach of {:.1f} m", verdict.reach_m)
                         : std::string("with the arms of a 22 t excavator, as none are in the log "
                                       "(--reach)"));
}

std::string verdict_text(const Verdict& verdict) {
  std::string text = listed("log", content_sentences(verdict));
  std::vector<std::string> known;
  std::vector<std::string> next;
  std::vector<std::string> columns;
  bool fitted = false;
  bool slow = false;
  for (std::size_t at = 0; at < verdict.drive.size(); ++at) {
    const DriveVerdict& of = verdict.drive[at];
    fitted = fitted || of.fitted;
    slow = slow || of.slow;
    known.insert(known.end(), of.known.begin(), of.known.end());
    next.insert(next.end(), of.next.begin(), of.next.end());
    const std::vector<std::string>& sources = verdict.tracks.drive[at].sources;
    columns.insert(columns.end(), sources.begin(), sources.end());
  }
  text += listed("columns", columns);
  text += fitted ? table(verdict)
                 : std::string(slow ? "no fit: rows are too far apart\n"
                                    : "no fit: no drive has a command and a speed that changes\n");
  text += listed("known", known);
  text += listed("next", next);
  std::vector<std::string> missing;
  for (const DraftValue& value : verdict.draft) {
    if (value.value.empty()) {
      missing.push_back(fmt::format("{}: {}", value.key, value.text));
    }
  }
  missing.insert(missing.end(), verdict.lacks.begin(), verdict.lacks.end());
  text += listed("lacks", missing);
  return text + tip_sentence(verdict) + "\n";
}

std::string verdict_json(const Verdict& verdict) {
  nlohmann::ordered_json json;
  json["log"] = verdict.log.name;
  json["kind"] = verdict.log.kind;
  json["length_s"] = verdict.tracks.length_s;
  json["looked_s"] = verdict.tracks.looked_s;
  json["row_s"] = verdict.tracks.recorded_s;
  json["gaps"] = verdict.tracks.gaps;
  json["notes"] = verdict.log.notes;
  for (const std::string& note : verdict.tracks.notes) {
    json["notes"].push_back(note);
  }
  for (std::size_t at = 0; at < verdict.drive.size(); ++at) {
    const DriveTrack& track = verdict.tracks.drive[at];
    const DriveVerdict& of = verdict.drive[at];
    const TrackFigures& figures = track.figures;
    nlohmann::ordered_json& drive = json["drives"][track.name()];
    drive["columns"] = track.sources;
    drive["unit"] = track.unit();
    drive["has_command"] = track.has_command;
    drive["has_motion"] = track.has_motion;
    drive["rate_hz"] = figures.rate_hz;
    drive["blind_share"] = figures.blind;
    drive["travel"] = figures.travel;
    drive["fastest"] = figures.fastest;
    drive["moves_share"] = figures.moves;
    drive["command_at_limit_share"] = figures.at_limit;
    drive["pressed_at_end_share"] = figures.at_ends;
    drive["way_without_command_share"] = figures.unasked;
    drive["known"] = of.known;
    drive["next"] = of.next;
    drive["useful"] = of.useful;
    if (of.fitted) {
      drive["r2"] = of.r2;
      drive["model"] = of.model;
      drive["curve_r2"] = of.curve.judged_r2;
      drive["ridge_r2"] = of.ridge.judged_r2;
    }
    if (of.useful) {
      drive["dead_time_s"] = of.curve.dead_time_s;
      if (of.curve.at_bound()) {
        drive["dead_time_deviation_s"] = nullptr;
      } else {
        drive["dead_time_deviation_s"] = of.curve.dead_time_deviation_s;
      }
      drive["lag_s"] = of.curve.lag_s;
      drive["lag_deviation_s"] = of.curve.lag_deviation_s;
      drive["delay_50_s"] = of.curve.half_s();
      drive["delay_90_s"] = of.curve.most_s();
      drive["positive"] = side_json(of.curve, 1.0);
      drive["negative"] = side_json(of.curve, -1.0);
      drive["tip_error_rms_m"] = of.tip_m;
    }
  }
  if (verdict.tip.known) {
    json["tip_error_m"] = {{"rms", verdict.tip.rms_m},
                           {"low", verdict.tip.low_m},
                           {"high", verdict.tip.high_m},
                           {"reach_m", verdict.reach_m},
                           {"reach_told", verdict.reach_told}};
  } else {
    json["tip_error_m"] = nullptr;
  }
  for (const DraftValue& value : verdict.draft) {
    json["draft"].push_back(
        {{"key", value.key},
         {"value", value.value.empty() ? nlohmann::json(nullptr) : nlohmann::json(value.value)},
         {"text", value.text}});
  }
  json["lacks"] = verdict.lacks;
  return json.dump(2) + "\n";
}

}  // namespace graben::identify
