// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a recording of any machine is good for: what is in it, how each drive answers its command,
/// what a profile of that machine would still lack, what to drive next, and how far off its path a
/// tip would be that is led by what is known.

#include <functional>
#include <string>
#include <vector>

#include "app/identify/verdict/tracks.hpp"

namespace graben::identify {

/// A value of a draft profile.
struct DraftValue {
  std::string key;    ///< As app/machines/KEYS.md has it.
  std::string value;  ///< With its unit; empty: the log does not say it.
  std::string text;   ///< Its 95 % band, or why it is missing.
};

struct DriveVerdict {
  CurveFit curve;
  RidgeFit ridge;
  bool fitted = false;             ///< Command and motion are there, and it moved.
  bool slow = false;               ///< Its values are too far apart for a fit.
  bool useful = false;             ///< The curve explains more than kUseful.
  double r2 = 0.0;                 ///< Of the better one, of motion that was left out.
  const char* model = "";          ///< Which that is.
  double ahead = 0.0;              ///< Turn that is unexplained within its delay, RMS, rad or m.
  double tip_m = 0.0;              ///< What that is at the tip.
  std::vector<std::string> known;  ///< Sentences.
  std::vector<std::string> next;
};

struct TipError {
  bool known = false;
  double rms_m = 0.0;
  double low_m = 0.0;  ///< Band: 80 % of stretches, and arms a third shorter and longer.
  double high_m = 0.0;
};

struct Verdict {
  SignalLog log;  ///< Without its values.
  Tracks tracks;
  std::vector<DriveVerdict> drive;  ///< Beside tracks.drive.
  TipError tip;
  std::vector<DraftValue> draft;
  std::vector<std::string> lacks;  ///< Of a whole profile, beside the draft's gaps.
  double reach_m = 0.0;            ///< By which the tip's error was reckoned.
  bool reach_told = false;
};

/// Where the curve explains less of the velocity's variance, its figures say nothing.
inline constexpr double kUseful = 0.4;
/// Boom, arm and bucket in a line, of a 22 t excavator, m.
inline constexpr double kUsualReach_m = 9.9;

struct VerdictAsk {
  double reach_m = 0.0;  ///< 0: not told.
  std::function<void(double, const std::string&)> progress = [](double, const std::string&) {};
};

/// Throws as tracks_of() does, and where no drive moves.
[[nodiscard]] Verdict judge_log(SignalLog log, const VerdictAsk& ask);

/// For a terminal, at most 100 columns, and for programs.
[[nodiscard]] std::string verdict_text(const Verdict& verdict);
[[nodiscard]] std::string verdict_json(const Verdict& verdict);

/// Parts of the text, which the page has too.
[[nodiscard]] std::vector<std::string> content_sentences(const Verdict& verdict);
[[nodiscard]] std::string tip_sentence(const Verdict& verdict);
/// "95 +- 4 ms", or why it has no band.
[[nodiscard]] std::string dead_time_text(const CurveFit& fit);

}  // namespace graben::identify
