// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A candump log of a dozer on our bus as series of what identification needs. SI units; extension
/// and forward are positive.

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/identify/machine/candump_reader.hpp"
#include "app/identify/machine/machine_log.hpp"
#include "firmware/dozer/dozer_signals.hpp"

namespace graben::identify {

/// Of lift or tilt, a value each kGrid_s.
struct BladeSeries {
  std::vector<double> duty;   ///< -1 .. 1; 0 while the valve is not enabled.
  std::vector<double> spool;  ///< Measured, of the travel, between its frames on a line.
  std::vector<double> stroke_m;
  std::vector<Reading> spools;  ///< By the frames' own times.
};

/// Of one path of the transmission.
struct TrackSeries {
  std::vector<double> pump_sent;  ///< Displacements, -1 .. 1 ...
  std::vector<double> motor_sent;
  std::vector<double> pump;  ///< ... and as they are measured.
  std::vector<double> motor;
  std::vector<double> speed_mps;
  std::vector<double> line_pa;
};

/// A stretch of a log without a gap.
struct DozerSegment {
  double begin_s = 0.0;  ///< The log's own time of the first grid point.
  std::array<BladeSeries, 2> blade;
  std::array<TrackSeries, kTrackCount> track;
  std::vector<double> velocity_mps;  ///< Of the body.
  std::vector<double> engine_radps;

  [[nodiscard]] std::size_t size() const { return engine_radps.size(); }
};

struct DozerLog {
  std::string name;                ///< Of the file.
  std::string sha256;              ///< Of its bytes, hexadecimal.
  std::uint32_t profile_hash = 0;  ///< That the machine said; 0: it said none.
  bool tilts = false;              ///< TiltState is in it.
  std::vector<DozerSegment> segments;
  std::size_t frames = 0;   ///< Of our bus.
  std::size_t refused = 0;  ///< With a wrong length or checksum.
  std::vector<std::string> notes;

  [[nodiscard]] double length_s() const;
};

/// Makes a log of frames as they come.
class DozerCollector {
 public:
  /// `name` is for errors.
  explicit DozerCollector(std::string name);
  ~DozerCollector();
  DozerCollector(const DozerCollector&) = delete;
  DozerCollector& operator=(const DozerCollector&) = delete;

  void take(const LoggedFrame& frame);
  /// Throws as read_dozer_log().
  [[nodiscard]] DozerLog log();

 private:
  class Frames;
  std::unique_ptr<Frames> frames_;
};

/// Reads a log, plain or gzip. Throws std::runtime_error that names file and reason: unreadable, no
/// frame of a dozer, two machines on one bus, another DBC version, too many damaged frames, a
/// signal that is missing, less than 5 s in one piece.
[[nodiscard]] DozerLog read_dozer_log(const std::filesystem::path& file);

}  // namespace graben::identify
