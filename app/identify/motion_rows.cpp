// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/identify/motion_runs.hpp"

namespace graben::identify {
namespace {

constexpr double kPiece_s = 30.0;
constexpr double kLongRun_s = 60.0;       // A longer one is cut
constexpr double kRow_s = 0.045;          // Rows need not follow each other faster,
constexpr std::size_t kMostRows = 30000;  // and not be more, for a fit of a minute or two.
constexpr double kShortestPiece_s = 3.0;
constexpr double kNoCommand = 0.01;
constexpr double kAgo_s = 1.0;

std::size_t row_count(const std::vector<MotionRun>& runs) {
  std::size_t rows = 0;
  for (const MotionRun& run : runs) {
    rows += run.size();
  }
  return rows;
}

/// Every `every`th row; a command is the mean of those that it stands for.
MotionRun thinned(const MotionRun& run, std::size_t every) {
  MotionRun fewer;
  fewer.name = run.name;
  for (std::size_t row = 0; row < run.size(); row += every) {
    const std::size_t end = std::min(row + every, run.size() - 1);
    fewer.time_s.push_back(run.time_s[row]);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      double held = 0.0;
      for (std::size_t at = row; at < end; ++at) {
        held += run.command[joint][at] * (run.time_s[at + 1] - run.time_s[at]);
      }
      fewer.command[joint].push_back(row < end ? held / (run.time_s[end] - run.time_s[row])
                                               : run.command[joint][row]);
      fewer.angle_rad[joint].push_back(run.angle_rad[joint][row]);
      fewer.velocity_radps[joint].push_back(run.velocity_radps[joint][row]);
    }
  }
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    if (run.by_angle[joint]) {
      take_velocity_of_angle(fewer, joint);
    }
  }
  return fewer;
}

/// Rows `from` to before `until`.
MotionRun piece_of(const MotionRun& run, std::size_t from, std::size_t until, std::size_t number) {
  MotionRun piece;
  piece.name = fmt::format("{}, piece {}", run.name, number);
  const auto part = [&](const auto& all) {
    return std::decay_t<decltype(all)>(all.begin() + static_cast<std::ptrdiff_t>(from),
                                       all.begin() + static_cast<std::ptrdiff_t>(until));
  };
  piece.time_s = part(run.time_s);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    piece.command[joint] = part(run.command[joint]);
    piece.angle_rad[joint] = part(run.angle_rad[joint]);
    piece.velocity_radps[joint] = part(run.velocity_radps[joint]);
    if (run.by_angle[joint]) {
      take_velocity_of_angle(piece, joint);
    }
  }
  return piece;
}

std::vector<MotionRun> cut(std::vector<MotionRun> runs, std::vector<std::string>* notes) {
  std::vector<MotionRun> pieces;
  std::size_t long_runs = 0;
  for (MotionRun& run : runs) {
    if (run.time_s.back() - run.time_s.front() < kLongRun_s) {
      pieces.push_back(std::move(run));
      continue;
    }
    ++long_runs;
    std::size_t from = 0;
    std::size_t number = 0;
    for (std::size_t row = 1; row <= run.size(); ++row) {
      const bool ends = row == run.size();
      if (ends || run.time_s[row] - run.time_s[from] > kPiece_s) {
        if (run.time_s[row - 1] - run.time_s[from] > kShortestPiece_s) {
          pieces.push_back(piece_of(run, from, row, ++number));
        }
        from = row;
      }
    }
  }
  if (long_runs > 0 && notes != nullptr) {
    notes->push_back(fmt::format("{} runs are longer than {:.0f} s: cut into pieces of {:.0f} s",
                                 long_runs, kLongRun_s, kPiece_s));
  }
  return pieces;
}

}  // namespace

void take_velocity_of_angle(MotionRun& run, std::size_t joint) {
  if (run.since.empty()) {
    constexpr double kSame_s = 1e-6;
    std::size_t from = 0;
    for (std::size_t row = 0; row < run.size(); ++row) {
      while (from + 1 < row && run.time_s[row] - run.time_s[from + 1] > kTurnWindow_s - kSame_s) {
        ++from;
      }
      run.since.push_back(from);
    }
  }
  run.by_angle[joint] = true;
  run.velocity_radps[joint].assign(run.size(), 0.0);
  for (std::size_t row = 1; row < run.size(); ++row) {
    const std::size_t from = run.since[row];
    run.velocity_radps[joint][row] = (run.angle_rad[joint][row] - run.angle_rad[joint][from]) /
                                     (run.time_s[row] - run.time_s[from]);
  }
  if (run.size() > 1) {
    // What it moves with as the run begins, over as much as later.
    std::size_t row = 1;
    while (row + 1 < run.size() && run.time_s[row] - run.time_s[0] < kTurnWindow_s) {
      ++row;
    }
    run.velocity_radps[joint][0] = run.velocity_radps[joint][row];
  }
}

double unasked_share(const std::vector<MotionRun>& runs, std::size_t joint) {
  constexpr double kMoves_radps = 0.005;
  double way = 0.0;
  double unasked = 0.0;
  for (const MotionRun& run : runs) {
    double asked_s = run.time_s.front();
    for (std::size_t row = 1; row < run.size(); ++row) {
      if (std::abs(run.command[joint][row]) > kNoCommand) {
        asked_s = run.time_s[row];
      }
      if (std::abs(run.velocity_radps[joint][row]) > kMoves_radps) {
        const double went = std::abs(run.angle_rad[joint][row] - run.angle_rad[joint][row - 1]);
        way += went;
        unasked += run.time_s[row] - asked_s > kAgo_s ? went : 0.0;
      }
    }
  }
  return way > 0.0 ? unasked / way : 0.0;
}

std::vector<MotionRun> cut_and_thinned(std::vector<MotionRun> runs,
                                       std::vector<std::string>* notes) {
  std::vector<MotionRun> all = cut(std::move(runs), notes);
  const std::size_t before = row_count(all);
  for (MotionRun& run : all) {
    const double step_s = (run.time_s.back() - run.time_s.front()) / double(run.size() - 1);
    const auto every = static_cast<std::size_t>(std::max(1.0, std::floor(kRow_s / step_s)));
    if (every > 1) {
      run = thinned(run, every);
    }
  }
  const auto every = (row_count(all) + kMostRows - 1) / kMostRows;
  if (before > kMostRows && every > 1 && all.size() > 3 * every) {
    std::vector<MotionRun> some;
    for (std::size_t at = 0; at < all.size(); at += every) {
      some.push_back(std::move(all[at]));
    }
    all = std::move(some);
  }
  if (row_count(all) < before && notes != nullptr) {
    notes->push_back(
        fmt::format("{} of {} rows are fitted to: means of commands that follow each "
                    "other faster than {:.0f} ms, evenly spread pieces",
                    row_count(all), before, 1e3 * kRow_s));
  }
  return all;
}

}  // namespace graben::identify
