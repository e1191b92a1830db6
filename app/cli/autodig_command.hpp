#pragma once
/// A task on the simulated machine, as both `autodig` and `dig --task` run it.

#include <optional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/task_file.hpp"

namespace graben::cli {

struct TaskRunOptions {
  std::string profile = "excavator_12t";
  std::string task = "flatten";
  std::string out = "out";
  std::string name = "autodig";  ///< Of the files in `out`.
  std::string summary;
  std::string errors = "none";
  std::vector<double> start;  ///< Teeth x, y, z in m and attitude in rad; where the task begins.
  std::uint64_t seed = 1;
  double speed = 1.0;
  std::optional<double> swash;       ///< Of the pumps, instead of the profile's.
  std::optional<double> duration_s;  ///< Of the first straight step.
  int rounds = 1;
};

/// Runs it, writes log, report and summary, prints the table. Throws std::runtime_error where the
/// run did not come to its end.
void run_task(const TaskRunOptions& options);

}  // namespace graben::cli
