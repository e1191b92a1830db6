// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A recording of any machine as named series of numbers: of a CSV table, or of frames on a bus
/// with a DBC, a bus profile or our own DBCs to read them by.

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/identify/verdict/meaning.hpp"

namespace graben::identify {

/// Its own times, increasing. Values are in the unit that is said, or as they were recorded.
struct Signal {
  std::string name;
  Meaning meaning;
  std::vector<double> time_s;
  std::vector<double> value;
  std::size_t invalid = 0;  ///< Rows or frames without a value.
};

struct SignalLog {
  std::string name;  ///< Of the file.
  std::string kind;  ///< In words: "CSV, 12 columns, 36000 rows".
  std::vector<Signal> signals;
  std::vector<std::string> notes;  ///< Sentences: what was guessed, left out or broken.
  bool has_full_bus = false;       ///< Pressures, swash and engine speed of our own excavator bus.
};

/// What was cut out of a log is a step of its time by this, s.
inline constexpr double kCut_s = 10.0;

/// Reads a table, plain or gzip. What its columns are is guessed (meaning.hpp) and said in the
/// notes, as is the unit of its time. Throws std::runtime_error, one sentence with the file's name,
/// where there is no header, no time or no row.
[[nodiscard]] SignalLog read_csv_log(const std::string& path);

/// By which layouts frames are read.
struct BusAsk {
  std::string dbc;  ///< A DBC file or a bus profile, its name or file; empty: our own DBCs.
  int source = -1;  ///< Address of the one machine that counts, 0 .. 255; below 0: any.
};

/// Nothing says how the frames are to be read: no DBC was named, and ours have none of them.
class UnknownBus : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads candump, ASC, TRC or BLF, plain or gzip. Throws std::runtime_error, one sentence with the
/// file's name: no frame, none that the DBC has, two machines; and UnknownBus.
[[nodiscard]] SignalLog read_bus_log(const std::filesystem::path& file, const BusAsk& ask);

/// By what a file contains: frames, else a table.
[[nodiscard]] bool is_bus_log(const std::filesystem::path& file);

}  // namespace graben::identify
