// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A campaign's results as CSV: a line that says what was tried, a line of column names, a row for
/// each draw.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/runs/figures.hpp"

namespace graben::runs {

/// Kind of run that is drawn again and again, and the figures that are kept of each draw.
struct CampaignKind {
  const char* name;                        ///< "dig": the first word of what was tried.
  std::vector<const char*> ends;           ///< How a draw can end; the first one is "done".
  std::vector<const FigureInfo*> columns;  ///< Each has a name of its own for the file.
  std::size_t failures_from = 1;  ///< The first end that is a failure; those before it are answers.
};

/// Those of a table that have a column.
template <class Summary>
[[nodiscard]] std::vector<const FigureInfo*> columns_of(const FigureTable<Summary>& table) {
  std::vector<const FigureInfo*> columns;
  for (const Figure<Summary>& figure : table) {
    if (figure.info.column != nullptr) {
      columns.push_back(&figure.info);
    }
  }
  return columns;
}

struct CampaignRow {
  std::size_t end = 0;         ///< Of the kind's ends.
  std::vector<double> figure;  ///< In SI units, one for each column; kAbsent where there is none.

  [[nodiscard]] bool done() const { return end == 0; }
};
using CampaignRows = std::map<std::uint64_t, CampaignRow>;  ///< By seed.

/// The row of a run, of its figures that have a column. One that did not come to its end has none:
/// 0 mm would be the best of all.
[[nodiscard]] CampaignRow campaign_row(std::size_t end, const RunFigures& figures);

/// The whole of a file. Throws std::runtime_error with file and line of what can't be read; a last
/// line without its end is what an interrupted run leaves, and is not there.
struct CampaignData {
  std::string tried;  ///< Profile, its hash, scenario.
  CampaignRows rows;
};
[[nodiscard]] CampaignData read_campaign(const std::filesystem::path& file,
                                         const CampaignKind& kind);
/// The first word of what was tried. Throws std::runtime_error where the file is no campaign.
[[nodiscard]] std::string campaign_name(const std::filesystem::path& file);
/// Writes beside the file and puts it in its place, rows in the order of their seeds: same rows,
/// same bytes.
void write_campaign(const std::filesystem::path& file, const CampaignKind& kind,
                    const CampaignData& data);

/// One process at a time: holds a file beside the results, and removes it. Throws
/// std::runtime_error where another one has it.
class FileLock {
 public:
  explicit FileLock(std::filesystem::path file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// A file that grows by a row at a time, so that what was computed is not lost. `kind` must outlive
/// it.
class CampaignLog {
 public:
  /// Goes on with the rows that are there, which must be of the same trial; throws
  /// std::runtime_error otherwise.
  CampaignLog(std::filesystem::path file, const CampaignKind& kind, const std::string& tried);

  void add(std::uint64_t seed, const CampaignRow& row);
  [[nodiscard]] bool has(std::uint64_t seed) const { return data_.rows.count(seed) != 0; }
  [[nodiscard]] const CampaignData& data() const { return data_; }

 private:
  std::filesystem::path file_;
  const CampaignKind& kind_;
  FileLock lock_;
  CampaignData data_;
};

/// Median, 95th percentile (nearest rank) and largest of every figure that is there; where low is
/// bad, 5th percentile and least. Of `asked` draws, or of those that there are if these are more.
[[nodiscard]] std::string campaign_table(const CampaignKind& kind, const CampaignData& data,
                                         std::size_t asked = 0);

}  // namespace graben::runs
