// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A recording's signals as drives on one even grid: command and motion in our units, cut at gaps
/// and thinned where it is long. What was guessed for it is said.

#include <cstddef>
#include <string>
#include <vector>

#include "app/identify/simple_models.hpp"
#include "app/identify/verdict/signal_log.hpp"

namespace graben::identify {

/// Shares of the looked-at time, 0 .. 1, unless told otherwise.
struct TrackFigures {
  double rate_hz = 0.0;    ///< Of the position, new values alone.
  double step_s = 0.0;     ///< Usual time between its values.
  double blind = 0.0;      ///< Nothing says where it is.
  double travel = 0.0;     ///< Between the ends that were seen, rad or m.
  double way = 0.0;        ///< Gone in all, rad or m.
  double fastest = 0.0;    ///< 99 % of the time it is slower, rad/s or m/s.
  double moves = 0.0;      ///< It does.
  double commanded = 0.0;  ///< Its command is not 0.
  double at_limit = 0.0;   ///< Its command is at its largest, where that is flat.
  double at_ends = 0.0;    ///< It stands within 1 % of an end while it is commanded.
  double unasked = 0.0;    ///< Of its way: went while no command had been there for a second.
  double least_command = 0.0;
  double most_command = 0.0;
  std::size_t steps = 0;  ///< Of the command by more than 0.2 at once.
};

struct DriveTrack {
  int drive = 0;        ///< Place in kDriveNames.
  bool length = false;  ///< m; else rad.
  bool has_command = false;
  bool from_spool = false;  ///< The command is what was measured of the spool.
  bool has_motion = false;
  bool only_velocity = false;
  std::vector<std::string> sources;  ///< Columns, with what each was taken for.
  TrackFigures figures;

  [[nodiscard]] const char* name() const;
  [[nodiscard]] const char* unit() const { return length ? "m" : "rad"; }
};

struct Tracks {
  std::vector<DriveTrack> drive;
  /// Rows of all drives alike: piece by piece, times, per drive command, position and velocity.
  struct Piece {
    std::vector<double> time_s;
    std::vector<std::vector<double>> command;
    std::vector<std::vector<double>> position;
    std::vector<std::vector<double>> velocity;
    std::vector<std::vector<char>> blind;  ///< Per drive: 1 where nothing says where it is.
    std::vector<std::size_t> since;
  };
  std::vector<Piece> pieces;
  double length_s = 0.0;    ///< Without gaps.
  double looked_s = 0.0;    ///< Of it that is in the pieces.
  double step_s = 0.0;      ///< Of the pieces' rows.
  double recorded_s = 0.0;  ///< Usual time between rows as they were recorded.
  std::size_t gaps = 0;
  double longest_gap_s = 0.0;
  std::vector<std::string> notes;
};

/// Throws std::runtime_error, one sentence with the log's name, where no drive is in it, nothing
/// says where any is, it is too short, or positions jump to and fro as if two machines spoke.
[[nodiscard]] Tracks tracks_of(const SignalLog& log);

/// The pieces as a drive's simple models want them; every fifth stretch of 20 s judges, shorter
/// ones where there are few.
[[nodiscard]] std::vector<SimpleRun> simple_runs(const Tracks& tracks, std::size_t drive);

}  // namespace graben::identify
