// SPDX-License-Identifier: Apache-2.0
#include "app/runs/campaign_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "app/machines/missing_file.hpp"

namespace graben::runs {
namespace {

std::string header(const CampaignKind& kind) {
  std::string line = "seed,end";
  for (const FigureInfo* figure : kind.columns) {
    line += fmt::format(",{}", figure->column);
  }
  return line;
}

std::string line_of(const CampaignKind& kind, std::uint64_t seed, const CampaignRow& row) {
  std::string line = fmt::format("{},{}", seed, kind.ends.at(row.end));
  for (const double figure : row.figure) {
    line += std::isfinite(figure) ? fmt::format(",{:.9g}", figure) : ",";
  }
  return line;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t from = 0;
  for (std::size_t comma = 0; comma != std::string::npos; from = comma + 1) {
    comma = line.find(',', from);
    cells.push_back(line.substr(from, comma == std::string::npos ? comma : comma - from));
  }
  return cells;
}

double number_of(const std::string& cell) {
  if (cell.empty()) {
    return kAbsent;
  }
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) {
    throw std::runtime_error(fmt::format("'{}' is no number", cell));
  }
  return value;
}

std::uint64_t seed_of(const std::string& cell) {
  if (cell.empty() || cell.size() > 18 ||
      cell.find_first_not_of("0123456789") != std::string::npos) {
    throw std::runtime_error(fmt::format("'{}' is no seed", cell));
  }
  return std::strtoull(cell.c_str(), nullptr, 10);
}

std::pair<std::uint64_t, CampaignRow> row_of(const CampaignKind& kind, const std::string& line) {
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() != 2 + kind.columns.size()) {
    throw std::runtime_error(
        fmt::format("{} cells instead of {}", cells.size(), 2 + kind.columns.size()));
  }
  CampaignRow row;
  const auto end = std::find(kind.ends.begin(), kind.ends.end(), cells[1]);
  if (end == kind.ends.end()) {
    throw std::runtime_error(fmt::format("'{}' is no end of a run", cells[1]));
  }
  row.end = static_cast<std::size_t>(end - kind.ends.begin());
  for (std::size_t i = 2; i < cells.size(); ++i) {
    row.figure.push_back(number_of(cells[i]));
  }
  return {seed_of(cells[0]), row};
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

/// The file's name, in a folder that is there.
std::filesystem::path in_its_folder(std::filesystem::path file) {
  std::filesystem::create_directories(std::filesystem::absolute(file).parent_path());
  return file;
}

/// Nearest rank of sorted values.
double rank(const std::vector<double>& sorted, double share) {
  const auto count = static_cast<double>(sorted.size());
  const auto index = static_cast<std::size_t>(std::max(0.0, std::ceil(share * count) - 1.0));
  return sorted[std::min(index, sorted.size() - 1)];
}

/// What the first line says was tried.
std::string tried_line(std::ifstream& stream, const std::filesystem::path& file) {
  if (!stream.is_open() || std::filesystem::is_directory(file)) {
    throw std::runtime_error(
        machines::unread_text(file, "a campaign's draws, as graben campaign ... --summary writes"));
  }
  std::string line;
  if (!std::getline(stream, line) || line.rfind("# ", 0) != 0) {
    refuse(file, "is no campaign: its first line does not say what was tried");
  }
  return line.substr(2);
}

}  // namespace

CampaignRow campaign_row(std::size_t end, const RunFigures& figures) {
  CampaignRow row;
  row.end = end;
  for (const FigureValue& figure : figures.values) {
    if (figure.info->column != nullptr) {
      row.figure.push_back(row.done() ? figure.value : kAbsent);
    }
  }
  return row;
}

std::string campaign_name(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const std::string tried = tried_line(stream, file);
  return tried.substr(0, tried.find(' '));
}

CampaignData read_campaign(const std::filesystem::path& file, const CampaignKind& kind) {
  std::ifstream stream(file);
  CampaignData data;
  data.tried = tried_line(stream, file);
  std::string line;
  if (!std::getline(stream, line) || line != header(kind)) {
    refuse(file, "line 2: other columns than this program's");
  }
  // Without its end the last line is cut: getline then meets the end of the file inside it.
  for (int number = 3; std::getline(stream, line) && !stream.eof(); ++number) {
    try {
      if (!data.rows.insert(row_of(kind, line)).second) {
        throw std::runtime_error("a seed for the second time");
      }
    } catch (const std::runtime_error& error) {
      refuse(file, fmt::format("line {}: {}", number, error.what()));
    }
  }
  return data;
}

void write_campaign(const std::filesystem::path& file, const CampaignKind& kind,
                    const CampaignData& data) {
  const std::filesystem::path beside = in_its_folder(file).string() + ".new";
  std::ofstream stream(beside);
  stream << "# " << data.tried << '\n' << header(kind) << '\n';
  for (const auto& [seed, row] : data.rows) {
    stream << line_of(kind, seed, row) << '\n';
  }
  stream.close();
  if (!stream) {
    refuse(beside, std::strerror(errno));
  }
  std::filesystem::rename(beside, file);
}

FileLock::FileLock(std::filesystem::path file) : file_(std::move(file)) {
  for (bool is_there = false; !is_there;) {
    descriptor_ = open(file_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (descriptor_ < 0) {
      refuse(file_, std::strerror(errno));
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor_);
      refuse(file_, "another campaign is writing its results here");
    }
    // Whoever had it may have removed it between the two calls: then this is nobody's name.
    struct stat held {};
    struct stat named {};
    is_there = fstat(descriptor_, &held) == 0 && stat(file_.c_str(), &named) == 0 &&
               held.st_ino == named.st_ino;
    if (!is_there) {
      close(descriptor_);
    }
  }
}

FileLock::~FileLock() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  close(descriptor_);
}

CampaignLog::CampaignLog(std::filesystem::path file, const CampaignKind& kind,
                         const std::string& tried)
    : file_(in_its_folder(std::move(file))), kind_(kind), lock_(file_.string() + ".lock") {
  if (std::filesystem::exists(file_)) {
    data_ = read_campaign(file_, kind_);
    if (data_.tried != tried) {
      refuse(file_, fmt::format("holds another campaign ('{}', not '{}')", data_.tried, tried));
    }
  }
  data_.tried = tried;
  write_campaign(file_, kind_, data_);
}

void CampaignLog::add(std::uint64_t seed, const CampaignRow& row) {
  data_.rows[seed] = row;
  std::ofstream stream(file_, std::ios::app);
  stream << line_of(kind_, seed, row) << '\n';
  stream.close();
  if (!stream) {
    refuse(file_, std::strerror(errno));
  }
}

std::string campaign_table(const CampaignKind& kind, const CampaignData& data, std::size_t asked) {
  const auto done = std::count_if(data.rows.begin(), data.rows.end(),
                                  [](const auto& row) { return row.second.done(); });
  std::string table =
      fmt::format("{}, {} of {} draws done\n{:<{}}{:>10}{:>10}{:>10}\n", data.tried, done,
                  std::max(asked, data.rows.size()), "", kFigureTextWidth, "median", "p95", "max");
  // Of a kind that has more than one answer, how many of each.
  if (kind.failures_from > 1) {
    std::string ends;
    for (std::size_t end = 0; end < kind.ends.size(); ++end) {
      const auto count = std::count_if(data.rows.begin(), data.rows.end(),
                                       [&](const auto& row) { return row.second.end == end; });
      ends += fmt::format("{}{} {}", end == 0 ? "" : ", ", kind.ends[end], count);
    }
    table.insert(table.find('\n') + 1, ends + "\n");
  }
  for (std::size_t i = 0; i < kind.columns.size(); ++i) {
    const FigureInfo& figure = *kind.columns[i];
    std::vector<double> values;
    for (const auto& [seed, row] : data.rows) {
      if (std::isfinite(row.figure[i])) {
        values.push_back(figure.unit.per_si * row.figure[i]);
      }
    }
    if (values.empty()) {
      continue;
    }
    std::sort(values.begin(), values.end());
    const bool is_low = figure.bad == BadEnd::kLow;
    table += fmt::format("{:<{}}{:>10.3f}{:>10.3f}{:>10.3f}", figure.text, kFigureTextWidth,
                         rank(values, 0.5), rank(values, is_low ? 0.05 : 0.95),
                         is_low ? values.front() : values.back());
    for (const std::string& after :
         {std::string(figure.unit.text), std::string(is_low ? "(p5, min)" : "")}) {
      table += after.empty() ? "" : " " + after;
    }
    table += "\n";
  }
  for (const auto& [seed, row] : data.rows) {
    if (!row.done()) {
      table += fmt::format("seed {}: {}\n", seed, kind.ends.at(row.end));
    }
  }
  return table;
}

}  // namespace graben::runs
