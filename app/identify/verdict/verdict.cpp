// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "app/identify/verdict/mended_signals.hpp"

namespace graben::identify {
namespace {

constexpr double kBand = 1.96;
constexpr double kFull = 0.95;
constexpr double kMuchUnasked = 0.1;
constexpr double kAtLimit = 0.35;
constexpr double kAtEnds = 0.02;
constexpr std::size_t kFewSteps = 10;
constexpr double kGood = 0.8;
constexpr double kArms = 1.35;  // By which the arms of an unknown machine are longer or shorter.
constexpr double kSlow_hz = 15.0;
constexpr double kSlowest_s = 0.25;  // Rows further apart say nothing of a drive's answer.
constexpr double kUsual_s = 0.02;    // What a dead time's band allows for by itself.

/// Tip's way for a drive's, at kUsualReach_m: per rad of its joint, and per m of its stroke.
struct Lever {
  double per_rad;
  double per_m;
};
constexpr std::array<Lever, 9> kLevers = {Lever{9.0, 11.0}, Lever{4.3, 6.0}, Lever{1.5, 3.0},
                                          Lever{0.0, 0.0},  Lever{3.0, 2.2}, Lever{0.0, 0.0},
                                          Lever{0.0, 0.0},  Lever{0.0, 0.0}, Lever{0.0, 0.0}};

double lever_of(const DriveTrack& track, double reach_m) {
  const Lever& lever = kLevers[static_cast<std::size_t>(track.drive)];
  const double scale = track.drive == 4 ? 1.0 : reach_m / kUsualReach_m;
  return track.length ? lever.per_m : lever.per_rad * scale;
}

/// Ways that the curve does not explain, each over the drive's whole delay, of judged rows, per
/// piece: within it no controller that waits for its sensors can make an error good.
std::vector<std::vector<double>> unexplained_ways(const std::vector<SimpleRun>& runs,
                                                  std::size_t drive, const CurveFit& fit) {
  std::vector<std::vector<double>> all;
  const std::vector<std::vector<double>> predicted = curve_velocities(runs, drive, fit);
  const double delay_s = fit.most_s();
  for (std::size_t n = 0; n < runs.size(); ++n) {
    const SimpleRun& run = runs[n];
    std::vector<double> ways;
    std::vector<double> sum(run.time_s.size(), 0.0);
    std::size_t from = 0;
    for (std::size_t row = 1; row < run.time_s.size(); ++row) {
      sum[row] = sum[row - 1] +
                 (run.velocity[row] - predicted[n][row]) * (run.time_s[row] - run.time_s[row - 1]);
      while (run.time_s[row] - run.time_s[from] > delay_s && from + 1 < row) {
        ++from;
      }
      if (run.judged[row] != 0 && run.time_s[row] - run.time_s.front() > delay_s) {
        ways.push_back(sum[row] - sum[from]);
      }
    }
    if (!ways.empty()) {
      all.push_back(std::move(ways));
    }
  }
  return all;
}

double rms_of(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) {
    squares += value * value;
  }
  return values.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(values.size()));
}

const char* side_name(double side) { return side > 0.0 ? "positive" : "negative"; }

double driven(const TrackFigures& of, double side) {
  return side > 0.0 ? of.most_command : -of.least_command;
}

void say_motion(const DriveTrack& track, DriveVerdict& of) {
  const std::string name = track.name();
  const TrackFigures& figures = track.figures;
  if (!track.has_motion) {
    of.known.push_back(
        fmt::format("{}: commands, but nothing says where it is or how fast: nothing "
                    "is known of its answer",
                    name));
    of.next.push_back(fmt::format("{}: record its angle or stroke beside the command", name));
    return;
  }
  if (!track.has_command) {
    of.known.push_back(
        fmt::format("{}: no command is in the log: of its answer nothing is known; it "
                    "went over {:.3g} {}, at up to {:.3g} {}/s",
                    name, figures.travel, track.unit(), figures.fastest, track.unit()));
    of.next.push_back(fmt::format("{}: record its command (duty, pilot pressure or lever)", name));
    return;
  }
  if (figures.most_command - figures.least_command < 0.02) {
    of.known.push_back(fmt::format("{}: was not driven: its command is 0 throughout", name));
    of.next.push_back(fmt::format("{}: drive it both ways", name));
  } else if (figures.moves < 1e-3) {
    of.known.push_back(
        fmt::format("{}: stood, though it was commanded {:.0f} % of the time: locked, "
                    "at an end, or another's command",
                    name, 100.0 * figures.commanded));
  }
}

void say_holes(const Tracks& tracks, const DriveTrack& track, DriveVerdict& of) {
  constexpr double kSome = 0.03;
  if (track.has_motion && track.figures.blind > kSome) {
    of.known.push_back(fmt::format("{}: {:.0f} % of the time nothing says where it is: left out",
                                   track.name(), 100.0 * track.figures.blind));
  }
  if (of.slow && track.has_command && track.has_motion) {
    of.known.push_back(fmt::format(
        "{}: a value each {:.0f} ms: slower than a drive answers, so no dead time, lag or edge",
        track.name(), 1e3 * std::max(tracks.recorded_s, track.figures.step_s)));
    of.next.push_back(fmt::format("{}: record it 20 times a second or more", track.name()));
  }
}

void say_limits(const DriveTrack& track, DriveVerdict& of) {
  const std::string name = track.name();
  const TrackFigures& figures = track.figures;
  if (figures.unasked > kMuchUnasked) {
    of.known.push_back(
        fmt::format("{}: {:.0f} % of its way it went with no command for a second: "
                    "commands of one direction cut off, of another source, or it sinks",
                    name, 100.0 * figures.unasked));
    of.next.push_back(fmt::format("{}: record both directions of its command", name));
  }
  if (figures.at_limit > kAtLimit) {
    of.known.push_back(
        fmt::format("{}: its command is saturated {:.0f} % of the time: between 0 and "
                    "full little is known",
                    name, 100.0 * figures.at_limit));
    of.next.push_back(fmt::format("{}: hold 30, 50 and 70 % for 2 s each, both ways", name));
  }
  if (figures.at_ends > kAtEnds) {
    of.known.push_back(fmt::format("{}: {:.0f} % of the time it was pressed against an end", name,
                                   100.0 * figures.at_ends));
  }
  if (figures.rate_hz > 0.0 && figures.rate_hz < kSlow_hz) {
    of.known.push_back(
        fmt::format("{}: its position is new only {:.0f} times a second", name, figures.rate_hz));
  }
}

void say_answer(const DriveTrack& track, DriveVerdict& of) {
  const std::string name = track.name();
  const TrackFigures& figures = track.figures;
  for (const double side : {1.0, -1.0}) {
    const double most = driven(figures, side);
    if (most < 0.02) {
      of.known.push_back(fmt::format("{}: {} commands: none was driven", name, side_name(side)));
      of.next.push_back(fmt::format("{}: drive it with {} commands", name, side_name(side)));
    } else if (most < kFull) {
      of.next.push_back(fmt::format("{}: {} commands beyond {:.0f} %: nothing is known there", name,
                                    side_name(side), 100.0 * most));
    }
  }
  if (figures.steps < kFewSteps) {
    of.next.push_back(
        fmt::format("{}: {} steps of its command are in the log: ten from rest, to 30, 60 "
                    "and 100 %, make dead time and lag sure",
                    name, figures.steps));
  }
  constexpr double kOthers = 0.7;
  if (!of.useful && of.ridge.judged_r2 > kOthers) {
    of.known.push_back(
        fmt::format("{}: its command does not explain its motion (R2 {:.2f}), those of all drives "
                    "do (R2 {:.2f}): columns of two drives changed about?",
                    name, of.curve.judged_r2, of.ridge.judged_r2));
  } else if (!of.useful) {
    of.known.push_back(
        fmt::format("{}: its command does not explain its motion (R2 {:.2f}): another "
                    "drive's command, or somebody else drives",
                    name, of.r2));
  } else if (of.curve.at_bound()) {
    of.known.push_back(
        fmt::format("{}: dead time at the bound of what is looked for: no deviation; "
                    "clocks of command and motion may differ",
                    name));
  }
  if (of.useful && of.r2 < kGood) {
    of.next.push_back(
        fmt::format("{}: R2 {:.2f}: drive it alone, from rest: others share its pump, or "
                    "loads move it",
                    name, of.r2));
  }
}

bool too_slow(const Tracks& tracks, const DriveTrack& track) {
  return std::max(tracks.recorded_s, track.figures.step_s) > kSlowest_s;
}

void take_fit(const Tracks& tracks, std::size_t at, DriveVerdict& of) {
  const DriveTrack& track = tracks.drive[at];
  const bool driven_at_all = track.figures.most_command - track.figures.least_command >= 0.02;
  if (!track.has_command || !track.has_motion || !driven_at_all || track.figures.moves < 1e-3 ||
      too_slow(tracks, track)) {
    return;
  }
  const std::vector<SimpleRun> runs = simple_runs(tracks, at);
  of.curve = fit_curve(runs, at);
  of.ridge = fit_ridge(runs, at);
  of.fitted = of.curve.known && of.ridge.known;
  // When a command changed between two rows nobody knows: a bias of half a step, and its spread.
  const double apart_s = std::max(0.0, tracks.recorded_s - kUsual_s) / std::sqrt(3.0);
  of.curve.dead_time_deviation_s = std::hypot(of.curve.dead_time_deviation_s, apart_s);
  if (!of.fitted) {
    return;
  }
  const bool ridge = of.ridge.judged_r2 > of.curve.judged_r2;
  of.r2 = std::max(of.ridge.judged_r2, of.curve.judged_r2);
  of.model = ridge ? "ridge regression" : "curve, dead time, lag";
  of.useful = of.curve.judged_r2 > kUseful;
}

void take_draft(const DriveTrack& track, const DriveVerdict& of, std::vector<DraftValue>& draft) {
  const std::string name = track.name();
  for (const double side : {1.0, -1.0}) {
    const std::string key =
        track.drive < 4 ? fmt::format("valve.answer.{}.{}", name, side > 0.0 ? "extend" : "retract")
                        : fmt::format("{}, {}", name, side_name(side));
    const std::string sign =
        of.curve.known && of.curve.fastest(side) * side < 0.0 ? ", turns against its command" : "";
    if (!of.useful || of.curve.fastest(side) == 0.0) {
      draft.push_back({key, "",
                       !track.has_command  ? "no command is in the log"
                       : !track.has_motion ? "no position is in the log"
                       : of.fitted         ? "was not driven, or does not follow its command"
                       : of.slow           ? "rows are too far apart"
                                           : "was not driven"});
      continue;
    }
    draft.push_back({key + ".dead_time", fmt::format("{:.3f} s", of.curve.dead_time_s),
                     of.curve.at_bound()
                         ? "at its bound: no deviation"
                         : fmt::format("+- {:.3f} s", kBand * of.curve.dead_time_deviation_s)});
    draft.push_back({key + ".lag", fmt::format("{:.3f} s", of.curve.lag_s),
                     fmt::format("+- {:.3f} s", kBand * of.curve.lag_deviation_s)});
    draft.push_back({key + ".spool_to_duty",
                     of.curve.edge(side) == 0.0
                         ? std::string("edge not known")
                         : fmt::format("from {:.0f} per mille", 1e3 * of.curve.edge(side)),
                     fmt::format("driven to {:.0f} per mille; there {:.3g} {}/s{}",
                                 1e3 * driven(track.figures, side),
                                 std::abs(of.curve.fastest(side)), track.unit(), sign)});
  }
}

std::vector<std::string> lacks_of(const Verdict& verdict) {
  std::vector<std::string> lacks = {
      "linkage: lengths of the links, pins of the cylinders (new-machine asks for them)",
      "cylinders: bores, rods, strokes",
      "masses and their centres",
      "pumps: displacement, regulator, "
      "limit of power",
      "valve: areas; which pump feeds which drive",
      "reliefs"};
  if (verdict.log.has_full_bus) {
    lacks.push_back(
        "of these, areas, pumps' displacement and zeros of sensors are in this log: `graben "
        "identify --log` finds them with a profile of the machine's measures");
  }
  return lacks;
}

void take_tip(Verdict& verdict, const std::vector<std::vector<std::vector<double>>>& ways) {
  double squares = 0.0;
  std::vector<double> shares;  // Per stretch and drive, of the drive's mean.
  for (std::size_t at = 0; at < verdict.drive.size(); ++at) {
    DriveVerdict& of = verdict.drive[at];
    const double lever = lever_of(verdict.tracks.drive[at], verdict.reach_m);
    of.tip_m = lever * of.ahead;
    squares += of.tip_m * of.tip_m;
    if (of.tip_m > 0.0) {
      for (const std::vector<double>& stretch : ways[at]) {
        shares.push_back(rms_of(stretch) / of.ahead);
      }
      verdict.tip.known = true;
    }
  }
  if (!verdict.tip.known) {
    return;
  }
  std::sort(shares.begin(), shares.end());
  const auto at_share = [&](double share) {
    return shares[static_cast<std::size_t>(share * static_cast<double>(shares.size() - 1) + 0.5)];
  };
  const double arms = verdict.reach_told ? 1.1 : kArms;
  verdict.tip.rms_m = std::sqrt(squares);
  verdict.tip.low_m = verdict.tip.rms_m * std::min(1.0, at_share(0.1)) / arms;
  verdict.tip.high_m = verdict.tip.rms_m * std::max(1.0, at_share(0.9)) * arms;
}

}  // namespace

Verdict judge_log(SignalLog log, const VerdictAsk& ask) {
  Verdict verdict;
  mend_signals(log);
  verdict.tracks = tracks_of(log);
  verdict.reach_told = ask.reach_m > 0.0;
  verdict.reach_m = verdict.reach_told ? ask.reach_m : kUsualReach_m;
  const Tracks& tracks = verdict.tracks;
  if (std::none_of(tracks.drive.begin(), tracks.drive.end(), [](const DriveTrack& track) {
        return track.has_motion && track.figures.moves >= 1e-3;
      })) {
    throw std::runtime_error(
        fmt::format("{}: no drive moves in its {:.0f} s: there is nothing to be "
                    "known from it",
                    log.name, tracks.length_s));
  }
  for (Signal& signal : log.signals) {
    signal.time_s = {};
    signal.value = {};
  }
  verdict.log = std::move(log);
  std::vector<std::vector<std::vector<double>>> ways(tracks.drive.size());
  for (std::size_t at = 0; at < tracks.drive.size(); ++at) {
    const DriveTrack& track = tracks.drive[at];
    ask.progress(static_cast<double>(at) / static_cast<double>(tracks.drive.size()), track.name());
    verdict.drive.emplace_back();
    DriveVerdict& of = verdict.drive.back();
    take_fit(tracks, at, of);
    say_motion(track, of);
    of.slow = too_slow(tracks, track);
    say_holes(tracks, track, of);
    if (of.fitted) {
      say_limits(track, of);
      say_answer(track, of);
    }
    if (of.useful) {
      ways[at] = unexplained_ways(simple_runs(tracks, at), at, of.curve);
      std::vector<double> all;
      for (const std::vector<double>& stretch : ways[at]) {
        all.insert(all.end(), stretch.begin(), stretch.end());
      }
      of.ahead = rms_of(all);
    }
    take_draft(track, of, verdict.draft);
  }
  take_tip(verdict, ways);
  verdict.lacks = lacks_of(verdict);
  return verdict;
}

}  // namespace graben::identify
