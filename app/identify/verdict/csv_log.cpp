// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "app/identify/lines.hpp"
#include "app/identify/machine/median.hpp"
#include "app/identify/verdict/signal_log.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::identify {
namespace {

using Cells = std::vector<std::string_view>;

constexpr double kDay_s = 86400.0;
constexpr double kFastest_s = 2e-4;  // Rows follow each other no faster and no slower than this.
constexpr double kSlowest_s = 2.0;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", path, what));
}

/// A number with a point, or with a comma where cells are not parted by commas.
std::optional<double> number_of(std::string_view cell, bool decimal_comma) {
  if (decimal_comma && cell.find(',') != std::string_view::npos) {
    std::string text(cell);
    std::replace(text.begin(), text.end(), ',', '.');
    return machines::number_in(text);
  }
  return machines::number_in(cell);
}

/// "2026-03-01T07:30:00.250", "1.3.2026 07:30:00,25", "3/1/2026 7:30:00" or "07:30:00.25" as
/// seconds.
std::optional<double> clock_of(std::string_view cell) {
  std::string text(cell);
  std::replace(text.begin(), text.end(), ',', '.');
  int year = 1970;
  int month = 1;
  int day = 1;
  int hour = 0;
  int minute = 0;
  double second = 0.0;
  char between = ' ';
  constexpr int kAll = 7;
  const auto reads = [&](const char* format, int& first, int& next, int& last) {
    return std::sscanf(text.c_str(), format, &first, &next, &last, &between, &hour, &minute,
                       &second) == kAll;
  };
  if (!reads("%d-%d-%d%c%d:%d:%lf", year, month, day) &&
      !reads("%d.%d.%d%c%d:%d:%lf", day, month, year) &&
      !reads("%d/%d/%d%c%d:%d:%lf", month, day, year) &&
      std::sscanf(text.c_str(), "%d:%d:%lf", &hour, &minute, &second) != 3) {
    return std::nullopt;
  }
  // Days of the civil calendar, years beginning with March.
  const int y = month <= 2 ? year - 1 : year;
  const int m = month <= 2 ? month + 9 : month - 3;
  const double days = 365.0 * y + y / 4 - y / 100 + y / 400 + (153 * m + 2) / 5 + day;
  return kDay_s * days + 3600.0 * hour + 60.0 * minute + second;
}

/// A file's rows as columns of numbers; NaN: no value.
struct Table {
  std::vector<std::string> name;
  std::vector<std::string> unit;
  std::vector<std::vector<double>> column;
  std::vector<std::size_t> invalid;
  std::vector<std::string> notes;
};

class Reader {
 public:
  explicit Reader(const std::string& path)
      : path_(path), lines_(path, "a recording, CSV, or a log of frames") {}

  Table read() {
    read_header();
    std::string line;
    try {
      while (lines_.next(line)) {
        take(line);
      }
    } catch (const std::runtime_error& error) {
      // What is whole of a file that is cut counts.
      if (rows_ == 0) {
        throw;
      }
      table_.notes.push_back(fmt::format("{}; {} rows before that count", error.what(), rows_));
    }
    if (!lines_.is_whole() && rows_ > 1 && short_last_) {
      table_.notes.push_back("its last row is cut off and left out");
      drop_last();
    }
    if (rows_ == 0 && broken_ > 0) {
      refuse(path_,
             fmt::format("its header has {} cells, and line {} has more, as have all others: "
                         "decimal commas between cells that commas part?",
                         table_.name.size(), first_broken_));
    }
    if (rows_ == 0) {
      refuse(path_, "has a header and no rows: there is nothing in it");
    }
    if (broken_ > 0) {
      table_.notes.push_back(
          fmt::format("{} rows have more cells than the header, the first in line {}; "
                      "they are left out",
                      broken_, first_broken_));
    }
    if (decimal_comma_ && saw_comma_) {
      table_.notes.push_back("numbers have a decimal comma");
    }
    return std::move(table_);
  }

 private:
  void read_header() {
    std::string line;
    while (lines_.next(line)) {
      const Cells cells = machines::cells_of(line);
      if (cells.empty() || cells[0].substr(0, 1) == "#") {
        continue;
      }
      if (line.find('\r') != std::string::npos) {
        refuse(path_, "its lines end in CR alone; allowed: LF, or CR LF");
      }
      decimal_comma_ = line.find(';') != std::string::npos || line.find('\t') != std::string::npos;
      if (std::all_of(cells.begin(), cells.end(), [&](std::string_view cell) {
            return number_of(cell, decimal_comma_).has_value();
          })) {
        refuse(path_,
               "has no header: which column is what? A first line such as "
               "time_s,boom_command_permille,boom_angle_rad is needed");
      }
      if (cells.size() < 2) {
        refuse(path_, "is neither a log of frames nor a table with a header");
      }
      for (const std::string_view cell : cells) {
        table_.name.emplace_back(cell);
      }
      table_.unit.resize(cells.size());
      table_.column.resize(cells.size());
      table_.invalid.resize(cells.size());
      return;
    }
    refuse(path_, "is empty: there is nothing in it");
  }

  void take(const std::string& line) {
    const Cells cells = machines::cells_of(line);
    if (cells.empty()) {
      return;
    }
    if (cells.size() > table_.name.size()) {
      first_broken_ = broken_++ == 0 ? lines_.number() : first_broken_;
      return;
    }
    const bool any = std::any_of(cells.begin(), cells.end(), [&](std::string_view cell) {
      return number_of(cell, decimal_comma_).has_value() || clock_of(cell).has_value();
    });
    if (!any && rows_ == 0) {
      for (std::size_t at = 0; at < cells.size(); ++at) {
        table_.unit[at] = cells[at];
      }
      return;
    }
    short_last_ = cells.size() < table_.name.size();
    saw_comma_ = saw_comma_ || (decimal_comma_ && line.find(',') != std::string::npos);
    for (std::size_t at = 0; at < table_.name.size(); ++at) {
      std::optional<double> value;
      if (at < cells.size()) {
        value = number_of(cells[at], decimal_comma_);
        if (!value && cells[at].find(':') != std::string_view::npos) {
          value = clock_of(cells[at]);
        }
      }
      table_.invalid[at] += value ? 0 : 1;
      table_.column[at].push_back(value ? *value : kNoNumber);
    }
    ++rows_;
  }

  void drop_last() {
    for (std::vector<double>& column : table_.column) {
      column.pop_back();
    }
    --rows_;
  }

  std::string path_;
  Lines lines_;
  Table table_;
  bool decimal_comma_ = false;
  bool saw_comma_ = false;
  bool short_last_ = false;
  std::size_t rows_ = 0;
  std::size_t broken_ = 0;
  std::size_t first_broken_ = 0;
};

double usual_step(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t row = 1; row < time.size(); ++row) {
    const double step = time[row] - time[row - 1];
    if (step > 0.0) {
      steps.push_back(step);
    }
  }
  return steps.empty() ? 0.0 : median(steps);
}

/// How many seconds the unit of a time is, by what rows of a recording can be apart; a note says it
/// where the name does not.
double time_scale(const std::string& path, const std::string& name, Unit said, double step,
                  std::vector<std::string>& notes) {
  struct Row {
    Unit unit;
    double scale;
    const char* text;
  };
  constexpr std::array<Row, 5> kRows = {
      Row{Unit::kSecond, 1.0, "s"}, Row{Unit::kMillisecond, 1e-3, "ms"},
      Row{Unit::kMicrosecond, 1e-6, "us"}, Row{Unit::kOther, 1e-9, "ns"},
      Row{Unit::kMinute, 60.0, "min"}};
  const auto fits = [&](double scale) {
    return step * scale >= kFastest_s && step * scale <= kSlowest_s;
  };
  for (const Row& row : kRows) {
    if (row.unit == said && fits(row.scale)) {
      return row.scale;
    }
  }
  for (const Row& row : kRows) {
    if (row.unit != Unit::kMinute && fits(row.scale)) {
      notes.push_back(said == Unit::kUnknown
                          ? fmt::format("time: column {}, taken for {}", name, row.text)
                          : fmt::format("time: column {} says {}, but its steps of {:g} are {}",
                                        name, unit_text(said), step, row.text));
      return row.scale;
    }
  }
  refuse(path, fmt::format("rows are {:g} apart in {}: no time of a recording", step, name));
}

/// The column that goes on row by row, one called time first.
std::size_t time_column(const std::string& path, const Table& table,
                        const std::vector<Meaning>& meaning) {
  for (std::size_t at = 0; at < meaning.size(); ++at) {
    if (meaning[at].what == What::kTime && usual_step(table.column[at]) > 0.0) {
      return at;
    }
  }
  refuse(path, "has no column of time: one called time_s, or time with its unit, is needed");
}

/// Rows whose time is that of the row before, but whose values are others.
void judge_doubles(const std::string& path, const Table& table, std::size_t clock,
                   std::vector<std::string>& notes) {
  constexpr double kFew = 0.02;
  const std::vector<double>& time = table.column[clock];
  std::size_t others = 0;
  for (std::size_t row = 1; row < time.size(); ++row) {
    others += time[row] == time[row - 1] && std::any_of(table.column.begin(), table.column.end(),
                                                        [row](const std::vector<double>& column) {
                                                          return std::isfinite(column[row]) &&
                                                                 std::isfinite(column[row - 1]) &&
                                                                 column[row] != column[row - 1];
                                                        })
                  ? 1
                  : 0;
  }
  const std::string said = fmt::format(
      "{} of {} rows have the time of the row before and other "
      "values",
      others, time.size());
  if (static_cast<double>(others) > kFew * static_cast<double>(time.size())) {
    refuse(path, fmt::format("{}: its clock, {}, is too coarse, or two machines are in it", said,
                             table.name[clock]));
  }
  if (others > 0) {
    notes.push_back(said + ": left out");
  }
}

/// Columns of which nothing is taken, and drives' columns with holes.
void say_columns(const Table& table, const std::vector<Meaning>& meaning, std::size_t clock,
                 std::vector<std::string>& notes) {
  constexpr std::size_t kNamed = 8;
  constexpr double kSome = 0.01;
  std::vector<std::string> unused;
  for (std::size_t at = 0; at < table.name.size(); ++at) {
    if (at != clock && (meaning[at].what == What::kOther || meaning[at].what == What::kTime)) {
      unused.push_back(table.name[at]);
    }
    const std::size_t rows = table.column[at].size();
    if (meaning[at].drive >= 0 && meaning[at].what != What::kOther &&
        static_cast<double>(table.invalid[at]) > kSome * static_cast<double>(rows)) {
      notes.push_back(fmt::format("{}: {} of its {} cells are no number", table.name[at],
                                  table.invalid[at], rows));
    }
  }
  if (!unused.empty()) {
    const std::size_t more = unused.size() > kNamed ? unused.size() - kNamed : 0;
    unused.resize(unused.size() - more);
    notes.push_back(
        fmt::format("columns whose names say nothing of a drive's command or motion, "
                    "not used: {}{}",
                    fmt::join(unused, ", "), more == 0 ? "" : fmt::format(", and {} more", more)));
  }
}

/// Times in seconds that only go on: a new run, or a time that goes back, is a cut.
std::vector<double> times_of(const std::vector<double>& raw, double scale,
                             const std::vector<double>* run, std::size_t& back) {
  std::vector<double> time_s(raw.size(), kNoNumber);
  double offset_s = 0.0;
  double last_s = kNoNumber;
  double last_run = kNoNumber;
  for (std::size_t row = 0; row < raw.size(); ++row) {
    if (!std::isfinite(raw[row])) {
      continue;
    }
    const double now_s = raw[row] * scale;
    const bool other_run = run != nullptr && (*run)[row] != last_run && std::isfinite(last_run);
    if (std::isfinite(last_s) && (other_run || now_s + offset_s < last_s)) {
      back += other_run ? 0 : 1;
      offset_s = last_s + kCut_s - now_s;
    }
    if (!std::isfinite(last_s)) {
      offset_s = -now_s;
    }
    if (now_s + offset_s == last_s) {
      continue;  // A row that is there twice.
    }
    last_s = time_s[row] = now_s + offset_s;
    last_run = run == nullptr ? kNoNumber : (*run)[row];
  }
  return time_s;
}

}  // namespace

SignalLog read_csv_log(const std::string& path) {
  Table table = Reader(path).read();
  std::vector<Meaning> meaning;
  const std::vector<double>* run = nullptr;
  for (std::size_t at = 0; at < table.name.size(); ++at) {
    meaning.push_back(meaning_of(table.name[at], table.unit[at]));
    if (meaning.back().what == What::kRun && table.invalid[at] == 0) {
      run = &table.column[at];
    }
  }
  SignalLog log;
  log.name = path.substr(path.find_last_of('/') + 1);
  log.notes = std::move(table.notes);
  const std::size_t clock = time_column(path, table, meaning);
  const double scale = time_scale(path, table.name[clock], meaning[clock].unit,
                                  usual_step(table.column[clock]), log.notes);
  judge_doubles(path, table, clock, log.notes);
  say_columns(table, meaning, clock, log.notes);
  std::size_t back = 0;
  const std::vector<double> time_s = times_of(table.column[clock], scale, run, back);
  if (back > 0) {
    log.notes.push_back(fmt::format("its time goes back {} times: cut there", back));
  }
  log.kind = fmt::format("CSV, {} columns, {} rows", table.name.size(), time_s.size());
  for (std::size_t at = 0; at < table.name.size(); ++at) {
    if (at == clock || meaning[at].what == What::kRun) {
      continue;
    }
    Signal signal;
    signal.name = table.name[at];
    signal.meaning = meaning[at];
    signal.invalid = table.invalid[at];
    for (std::size_t row = 0; row < time_s.size(); ++row) {
      if (std::isfinite(time_s[row]) && std::isfinite(table.column[at][row])) {
        signal.time_s.push_back(time_s[row]);
        signal.value.push_back(table.column[at][row]);
      }
    }
    table.column[at].clear();
    table.column[at].shrink_to_fit();
    log.signals.push_back(std::move(signal));
  }
  return log;
}

}  // namespace graben::identify
