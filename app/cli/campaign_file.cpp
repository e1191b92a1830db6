#include "app/cli/campaign_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace graben::cli {
namespace {

constexpr double kMilli = 1e3;
constexpr double kPercent = 100.0;
constexpr double kDegrees = 180.0 / 3.14159265358979323846;
constexpr double kMega = 1e-6;
constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<const char*, 4> kEnds = {"done", "path-not-reached", "loop-not-closed",
                                              "fault"};

std::string header() {
  std::string line = "seed,end";
  for (const CampaignColumn& column : campaign_columns()) {
    line += fmt::format(",{}", column.name);
  }
  return line;
}

std::string line_of(std::uint64_t seed, const CampaignRow& row) {
  std::string line = fmt::format("{},{}", seed, kEnds.at(static_cast<std::size_t>(row.end)));
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

std::pair<std::uint64_t, CampaignRow> row_of(const std::string& line) {
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() != 2 + kCampaignColumns) {
    throw std::runtime_error(
        fmt::format("{} cells instead of {}", cells.size(), 2 + kCampaignColumns));
  }
  CampaignRow row;
  const auto* end = std::find(kEnds.begin(), kEnds.end(), cells[1]);
  if (end == kEnds.end()) {
    throw std::runtime_error(fmt::format("'{}' is no end of a run", cells[1]));
  }
  row.end = static_cast<DigEnd>(end - kEnds.begin());
  for (std::size_t i = 0; i < kCampaignColumns; ++i) {
    row.figure[i] = number_of(cells[2 + i]);
  }
  return {seed_of(cells[0]), row};
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

/// Nearest rank of sorted values.
double rank(const std::vector<double>& sorted, double share) {
  const auto count = static_cast<double>(sorted.size());
  const auto index = static_cast<std::size_t>(std::max(0.0, std::ceil(share * count) - 1.0));
  return sorted[std::min(index, sorted.size() - 1)];
}

}  // namespace

const std::array<CampaignColumn, kCampaignColumns>& campaign_columns() {
  using S = DigSummary;
  static const std::array<CampaignColumn, kCampaignColumns> columns = {{
      {"max_error_true_m", "path error of the true tip, max", "mm", kMilli,
       [](const S& s) { return s.max_error_true_m; }},
      {"rmse_error_true_m", "path error of the true tip, RMSE", "mm", kMilli,
       [](const S& s) { return s.rmse_error_true_m; }},
      {"max_error_measured_m", "path error of the measured tip, max", "mm", kMilli,
       [](const S& s) { return s.max_error_measured_m; }},
      {"rmse_error_measured_m", "path error of the measured tip, RMSE", "mm", kMilli,
       [](const S& s) { return s.rmse_error_measured_m; }},
      {"lambda_min", "lambda, min", "", 1.0, [](const S& s) { return s.lambda_min; }},
      {"lambda_mean", "lambda, mean", "", 1.0, [](const S& s) { return s.lambda_mean; }},
      {"lambda_below_1", "time with lambda below 1", "%", kPercent,
       [](const S& s) { return s.lambda_below_1_share; }},
      {"regeneration", "time with a regeneration check open", "%", kPercent,
       [](const S& s) { return s.regeneration_share; }},
      {"loop_s", "time round the path", "s", 1.0, [](const S& s) { return s.loop_s; }},
      {"approach_s", "time to reach the path", "s", 1.0, [](const S& s) { return s.approach_s; }},
      {"peak_chamber_pressure_pa", "highest chamber pressure", "MPa", kMega,
       [](const S& s) { return s.peak_chamber_pressure_pa; }},
      {"lambda_held", "lambda while the obstacle holds, min", "", 1.0,
       [](const S& s) { return s.recovery ? s.recovery->lambda_held : kAbsent; }},
      {"off_field_max_rad", "mean direction off the field afterwards, max", "deg", kDegrees,
       [](const S& s) { return s.recovery ? s.recovery->off_field_max_rad : kAbsent; }},
      {"ringing_max_rad", "the same from cycle to cycle", "deg", kDegrees,
       [](const S& s) { return s.recovery ? s.recovery->ringing_max_rad : kAbsent; }},
      {"recovery_error_max_m", "path error of the true tip afterwards, max", "mm", kMilli,
       [](const S& s) { return s.recovery ? s.recovery->error_max_m : kAbsent; }},
  }};
  return columns;
}

CampaignData read_campaign(const std::filesystem::path& file) {
  std::ifstream stream(file);
  CampaignData data;
  std::string line;
  if (!std::getline(stream, line) || line.rfind("# ", 0) != 0) {
    refuse(file, "is no campaign: its first line does not say what was tried");
  }
  data.tried = line.substr(2);
  if (!std::getline(stream, line) || line != header()) {
    refuse(file, "line 2: other columns than this program's");
  }
  // Without its end the last line is cut: getline then meets the end of the file inside it.
  for (int number = 3; std::getline(stream, line) && !stream.eof(); ++number) {
    try {
      if (!data.rows.insert(row_of(line)).second) {
        throw std::runtime_error("a seed for the second time");
      }
    } catch (const std::runtime_error& error) {
      refuse(file, fmt::format("line {}: {}", number, error.what()));
    }
  }
  return data;
}

void write_campaign(const std::filesystem::path& file, const CampaignData& data) {
  const std::filesystem::path beside = file.string() + ".new";
  std::ofstream stream(beside);
  stream << "# " << data.tried << '\n' << header() << '\n';
  for (const auto& [seed, row] : data.rows) {
    stream << line_of(seed, row) << '\n';
  }
  stream.close();
  if (!stream) {
    refuse(beside, std::strerror(errno));
  }
  std::filesystem::rename(beside, file);
}

FileLock::FileLock(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = open(file_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (descriptor_ < 0) {
    refuse(file_, std::strerror(errno));
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor_);
    refuse(file_, "another campaign is writing its results here");
  }
}

FileLock::~FileLock() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  close(descriptor_);
}

CampaignLog::CampaignLog(std::filesystem::path file, const std::string& tried)
    : file_(std::move(file)), lock_(file_.string() + ".lock") {
  if (std::filesystem::exists(file_)) {
    data_ = read_campaign(file_);
    if (data_.tried != tried) {
      refuse(file_, fmt::format("holds another campaign ('{}', not '{}')", data_.tried, tried));
    }
  }
  data_.tried = tried;
  write_campaign(file_, data_);
}

void CampaignLog::add(std::uint64_t seed, const CampaignRow& row) {
  data_.rows[seed] = row;
  std::ofstream stream(file_, std::ios::app);
  stream << line_of(seed, row) << '\n';
  stream.close();
  if (!stream) {
    refuse(file_, std::strerror(errno));
  }
}

std::string campaign_table(const CampaignData& data) {
  const auto done = std::count_if(data.rows.begin(), data.rows.end(),
                                  [](const auto& row) { return row.second.end == DigEnd::kDone; });
  std::string table = fmt::format("{}, {} of {} draws done\n{:<50}{:>10}{:>10}{:>10}\n", data.tried,
                                  done, data.rows.size(), "", "median", "p95", "max");
  for (std::size_t i = 0; i < kCampaignColumns; ++i) {
    const CampaignColumn& column = campaign_columns()[i];
    std::vector<double> values;
    for (const auto& [seed, row] : data.rows) {
      if (std::isfinite(row.figure[i])) {
        values.push_back(column.shown * row.figure[i]);
      }
    }
    if (values.empty()) {
      continue;
    }
    std::sort(values.begin(), values.end());
    table += fmt::format("{:<50}{:>10.3f}{:>10.3f}{:>10.3f} {}\n", column.words, rank(values, 0.5),
                         rank(values, 0.95), values.back(), column.unit);
  }
  for (const auto& [seed, row] : data.rows) {
    if (row.end != DigEnd::kDone) {
      table += fmt::format("seed {}: {}\n", seed, kEnds.at(static_cast<std::size_t>(row.end)));
    }
  }
  return table;
}

}  // namespace graben::cli
