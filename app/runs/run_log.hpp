// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A run as its log tells it, whoever wrote the log: what the controller said of itself and how the
/// machine moved. Logs of two runs are compared by it.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/identify/machine/candump_reader.hpp"
#include "app/runs/code_text.hpp"

namespace graben::runs {

/// A signal over time, at the times of its frames; only what is valid.
struct Channel {
  std::vector<double> time_s;
  std::vector<double> value;  ///< SI.

  /// The last value at or before this time; not a number where it is older than 0.2 s.
  [[nodiscard]] double at(double time_s) const;
};

/// What of a channel is known beforehand.
struct ChannelInfo {
  const char* plot;   ///< Of the page (view/plots.ts), or one of its own.
  const char* title;  ///< Of that plot.
  const char* label;
  const char* unit;  ///< Shown in, and how many of them are one SI unit.
  double per_si;
  int decimals;
  bool is_on_page;  ///< The page plots it by itself, of the log that it has.
};

/// Lambda, then the error against path or grade, then spools and strokes of the drives.
[[nodiscard]] const std::vector<ChannelInfo>& channel_table(bool is_dozer);

/// A step of a task program, as TaskStatus says it.
struct RunStep {
  std::uint8_t number = 0;  ///< From 0.
  std::uint8_t kind = 0;    ///< dbc::excavator::TaskStatus::StepKind.
  double begun_s = 0.0;
};

struct RunLog {
  std::string name;        ///< Of the file, as it was told.
  identify::LogRead read;  ///< What else was in it.
  bool is_dozer = false;
  std::uint32_t profile_hash = 0;  ///< 0: not said.
  std::uint8_t task = 0;           ///< Last asked for while it was Active, but None.
  std::uint8_t task_number = 0;    ///< Of a task program among the controller's.
  std::vector<RunStep> step;       ///< Of a task program, in the order in which they began.
  std::vector<Channel> channel;    ///< In the order of channel_table().
  double from_s = 0.0;
  double until_s = 0.0;
  double start_s = 0.0;          ///< When the controller was first Active; else the first frame.
  double active_s = 0.0;         ///< How long it was Active, all together, in its pieces.
  LimitShares limit_share;       ///< While it was Active.
  std::vector<double> status_s;  ///< Times of EcuStatus.
  std::optional<double> first_fault_s;  ///< After it was ready.
  Fault first_fault = Fault::kNone;
};

/// Reads a log (read_candump). Throws std::runtime_error that names it where it cannot be read, has
/// no lines of one, no EcuStatus, or
/// another version of the DBC than is read (app/identify/machine/log_version.hpp).
[[nodiscard]] RunLog read_run_log(const std::filesystem::path& file);

/// What held lambda, or a dozer's speed: of the time up to each EcuStatus that says Active, the
/// share of each limit; by time, as frames may be lost or be there twice, and none across a gap.
/// The one rule of terminal, page and comparison: the page counts the same frames in its window
/// (view/limit_shares.ts). Throws as read_run_log(); none where the file is no regular one.
[[nodiscard]] LimitShares logged_limit_shares(const std::filesystem::path& file);

/// A figure of both runs; not a number where a run has none.
struct ComparedFigure {
  std::string text;
  std::string unit;
  double first = 0.0;
  double second = 0.0;
  int decimals = 1;
};

/// Both runs in figures: times, errors with their moments, lambda, each limit's share. Of error and
/// lambda counts what comes after the error was first below kArrived_m for kArrivedFor_s, as in a
/// run's own figures at full speed (PathProgress): a way to the path is no error, and its start
/// from rest no limit.
[[nodiscard]] std::vector<ComparedFigure> compared_figures(const RunLog& first,
                                                           const RunLog& second);
inline constexpr double kArrived_m = 0.02;
inline constexpr double kArrivedFor_s = 0.5;

/// What makes the two no runs of the same thing, a sentence each: another profile (named by
/// `profile_name`), another task, another task program by its steps and where they begin, a run
/// that hardly was one.
[[nodiscard]] std::vector<std::string> compared_notes(
    const RunLog& first, const RunLog& second,
    const std::function<std::string(std::uint32_t hash)>& profile_name);

/// A row for each figure: both and the difference.
[[nodiscard]] std::string compared_table(const RunLog& first, const RunLog& second,
                                         const std::vector<ComparedFigure>& figures);

}  // namespace graben::runs
