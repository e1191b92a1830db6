// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/track_figures.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/median.hpp"

namespace graben::identify {
namespace {

constexpr double kAgo_s = 1.0;
constexpr double kNoCommand = 0.02;
constexpr double kLongestStep_s = 5.0;
constexpr double kStands_radps = 0.005;
constexpr double kStands_mps = 0.002;

}  // namespace

double usual_step(const std::vector<double>& time_s) {
  std::vector<double> steps;
  for (std::size_t at = 1; at < time_s.size(); ++at) {
    if (time_s[at] - time_s[at - 1] < kLongestStep_s) {
      steps.push_back(time_s[at] - time_s[at - 1]);
    }
  }
  return steps.empty() ? kGap_s : median(steps);
}

double new_rate_hz(const Signal& signal, double moving_step) {
  std::size_t same = 0;
  std::size_t moving = 0;
  for (std::size_t at = 4; at + 4 < signal.value.size(); ++at) {
    if (std::abs(signal.value[at + 4] - signal.value[at - 4]) > moving_step) {
      ++moving;
      same += signal.value[at] == signal.value[at - 1] ? 1 : 0;
    }
  }
  const double share = moving == 0 ? 0.0 : static_cast<double>(same) / static_cast<double>(moving);
  return (1.0 - share) / usual_step(signal.time_s);
}

TrackFigures figures_of(const Tracks& tracks, std::size_t at) {
  const DriveTrack& track = tracks.drive[at];
  TrackFigures of;
  double least = INFINITY;
  double most = -INFINITY;
  double largest = 0.0;
  double all = 0.0;
  std::vector<double> speeds;
  for (const Tracks::Piece& piece : tracks.pieces) {
    for (std::size_t row = 0; row < piece.time_s.size(); ++row) {
      all += 1.0;
      if (piece.blind[at][row] != 0) {
        of.blind += 1.0;
        continue;
      }
      least = std::min(least, piece.position[at][row]);
      most = std::max(most, piece.position[at][row]);
      speeds.push_back(std::abs(piece.velocity[at][row]));
      of.least_command = std::min(of.least_command, piece.command[at][row]);
      of.most_command = std::max(of.most_command, piece.command[at][row]);
      largest = std::max(largest, std::abs(piece.command[at][row]));
    }
  }
  of.travel = most > least ? most - least : 0.0;
  of.blind = all > 0.0 ? of.blind / all : 0.0;
  if (!speeds.empty()) {
    const auto high =
        speeds.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(speeds.size() - 1));
    std::nth_element(speeds.begin(), high, speeds.end());
    of.fastest = *high;
  }
  const double stands = track.length ? kStands_mps : kStands_radps;
  double rows = 0.0;
  double unasked = 0.0;
  for (const Tracks::Piece& piece : tracks.pieces) {
    double asked_s = piece.time_s.front();
    for (std::size_t row = 0; row < piece.time_s.size(); ++row) {
      if (piece.blind[at][row] != 0 || (row > 0 && piece.blind[at][row - 1] != 0)) {
        asked_s = piece.time_s[row];
        continue;
      }
      const double command = piece.command[at][row];
      const double place = piece.position[at][row];
      const bool moves = std::abs(piece.velocity[at][row]) > stands;
      rows += 1.0;
      of.moves += moves ? 1.0 : 0.0;
      of.commanded += std::abs(command) > kNoCommand ? 1.0 : 0.0;
      of.at_limit += largest > 0.5 && std::abs(command) > 0.995 * largest ? 1.0 : 0.0;
      const bool at_end = std::min(place - least, most - place) < 0.01 * of.travel;
      of.at_ends += at_end && !moves && std::abs(command) > 0.3 ? 1.0 : 0.0;
      asked_s = std::abs(command) > kNoCommand ? piece.time_s[row] : asked_s;
      if (row > 0) {
        const double way = std::abs(place - piece.position[at][row - 1]);
        of.way += moves ? way : 0.0;
        unasked += moves && piece.time_s[row] - asked_s > kAgo_s ? way : 0.0;
        of.steps += std::abs(command - piece.command[at][row - 1]) > 0.2 ? 1 : 0;
      }
    }
  }
  if (rows > 0.0) {
    for (double* share : {&of.moves, &of.commanded, &of.at_limit, &of.at_ends}) {
      *share /= rows;
    }
  }
  of.unasked = of.way > 0.0 ? unasked / of.way : 0.0;
  return of;
}

std::vector<SimpleRun> simple_runs(const Tracks& tracks, std::size_t drive) {
  constexpr double kJudged_s = 20.0;
  constexpr std::size_t kFifth = 5;
  constexpr std::size_t kWhich = 2;
  const double stretch_s = std::clamp(tracks.looked_s / 25.0, 2.0, kJudged_s);
  std::vector<SimpleRun> runs;
  double gone_s = 0.0;
  for (const Tracks::Piece& piece : tracks.pieces) {
    SimpleRun run;
    run.time_s = piece.time_s;
    run.command = piece.command;
    run.velocity = piece.velocity[drive];
    run.since = piece.since;
    if (tracks.drive[drive].only_velocity) {
      for (std::size_t row = 0; row < run.since.size(); ++row) {
        run.since[row] = row;
      }
    }
    for (std::size_t of = 0; of < tracks.drive.size(); ++of) {
      if (tracks.drive[of].has_motion && !tracks.drive[of].only_velocity) {
        std::vector<double> one;
        std::vector<double> other;
        const double span = std::max(1e-6, tracks.drive[of].figures.travel);
        for (const double place : piece.position[of]) {
          const double turn = tracks.drive[of].length ? place / span : place;
          one.push_back(std::sin(turn));
          other.push_back(std::cos(turn));
        }
        run.pose.push_back(std::move(one));
        run.pose.push_back(std::move(other));
      }
    }
    double seen_s = run.time_s.front();
    for (std::size_t row = 0; row < run.time_s.size(); ++row) {
      const double time_s = run.time_s[row];
      seen_s = piece.blind[drive][row] != 0 ? time_s : seen_s;
      const double at_s = gone_s + time_s - run.time_s.front();
      const auto stretch = static_cast<std::size_t>(at_s / stretch_s);
      // What was commanded before a piece began is not known, nor what it did in a gap.
      const bool settled = time_s - seen_s > kAgo_s;
      run.judged.push_back(!settled ? kNeither : (stretch % kFifth == kWhich ? 1 : 0));
    }
    gone_s += run.time_s.back() - run.time_s.front();
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace graben::identify
