// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A candump log of an excavator on our bus as series of what identification needs: duties that the
/// valves were sent, spools, strokes, chamber pressures, swash, engine speed. SI units; extension
/// is positive. The swing is the last drive where the machine has one: its angle as travel at the
/// profile's lever, extending to the left.

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/identify/machine/candump_reader.hpp"
#include "firmware/excavator/excavator_signals.hpp"

namespace graben::identify {

/// Period of the grid on which a log is sampled, s: that of the strokes.
inline constexpr double kGrid_s = 0.01;

/// A value and when its frame was on the bus.
struct Reading {
  double time_s = 0.0;
  double value = 0.0;
};

/// Of one cylinder, a value each grid point; what has not been received yet repeats the first.
struct CylinderSeries {
  std::vector<double> duty;   ///< -1 .. 1; 0 while the valves are not enabled.
  std::vector<double> spool;  ///< Measured, of the travel.
  std::vector<double> stroke_m;
  std::vector<double> cap_pa;
  std::vector<double> rod_pa;
  /// The frames' own times, for what is found more finely than the grid.
  std::vector<Reading> duties;
  std::vector<Reading> spools;
};

/// A stretch of a log without a gap.
struct LogSegment {
  double begin_s = 0.0;             ///< The log's own time of the first grid point.
  std::size_t drives = kAxisCount;  ///< Series of `axis` that there are.
  std::array<CylinderSeries, kDriveCount> axis;
  std::array<std::vector<double>, kPumpCount> swash;  ///< Of full swash.
  std::vector<double> engine_radps;
  bool senses_spools = false;  ///< Else `spool` is the duty.

  [[nodiscard]] std::size_t size() const { return engine_radps.size(); }
  [[nodiscard]] double length_s() const { return kGrid_s * static_cast<double>(size()); }
};

struct MachineLog {
  std::string name;                ///< Of the file.
  std::string sha256;              ///< Of its bytes, hexadecimal.
  std::uint32_t profile_hash = 0;  ///< That the machine said; 0: it said none.
  std::vector<LogSegment> segments;
  std::size_t frames = 0;          ///< Of our bus.
  std::size_t refused = 0;         ///< With a wrong length or checksum.
  std::size_t foreign = 0;         ///< Frames of other buses.
  std::vector<std::string> notes;  ///< LogRead's.

  [[nodiscard]] double length_s() const;
};

/// Makes a log of frames as they come.
class LogCollector {
 public:
  /// `name` is for errors.
  explicit LogCollector(std::string name);
  ~LogCollector();
  LogCollector(const LogCollector&) = delete;
  LogCollector& operator=(const LogCollector&) = delete;

  /// Frames of other buses are counted, those with a wrong length or checksum refused. Throws as
  /// read_machine_log().
  void take(const LoggedFrame& frame);
  /// Of a machine with so many pumps; its swing with that lever, without a swing 0. Pumps that set
  /// their own swash (`told` false) need not say it.
  [[nodiscard]] MachineLog log(int pump_count, double swing_lever_m = 0.0, bool told = true);

 private:
  class Frames;
  std::unique_ptr<Frames> frames_;
};

/// Reads a log, plain or gzip; `pump_count`, `swing_lever_m` (0: no swing) and `told` of the
/// machine, see LogCollector. A log without SwingState says nothing of a swing. Throws
/// std::runtime_error that names file, line and reason: unreadable, cut off, not candump, no frame
/// of an excavator, another DBC version, a dozer's bus, two machines on one bus, too many damaged
/// frames, a signal that is missing or often has no value, less than 5 s in one piece.
[[nodiscard]] MachineLog read_machine_log(const std::filesystem::path& file, int pump_count,
                                          double swing_lever_m = 0.0, bool told = true);

}  // namespace graben::identify
