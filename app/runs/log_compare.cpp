// SPDX-License-Identifier: Apache-2.0
/// Figures of two logged runs beside each other.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "app/machines/task_text.hpp"
#include "app/runs/run_log.hpp"

namespace graben::runs {
namespace {

constexpr double kShort_s = 1.0;  ///< Figures of less are of its start alone.
/// More is no error of a way.
constexpr double kOtherPlace_m = 0.15;
constexpr std::size_t kFirstStroke = 5;  ///< Of an excavator's channels.
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Over the time of a log's pieces: a frame that is there twice, or lost, weighs nothing.
class TimeMean {
 public:
  void add(double time_s, double value) {
    const double passed_s = count_ > 0 ? identify::LogClock::counted_s(last_s_, time_s) : 0.0;
    last_s_ = time_s;
    sum_ += passed_s * value;
    time_s_ += passed_s;
    plain_ += value;
    ++count_;
  }

  /// Of a single moment its value; not a number without one.
  [[nodiscard]] double mean() const {
    return time_s_ > 0.0 ? sum_ / time_s_ : plain_ / static_cast<double>(count_);
  }

 private:
  double sum_ = 0.0;
  double time_s_ = 0.0;
  double plain_ = 0.0;
  double last_s_ = 0.0;
  int count_ = 0;
};

struct ErrorFigures {
  double most_m = kNone;
  double most_s = kNone;  ///< Since the run's start.
  double rms_m = kNone;
  double arrived_s = kNone;  ///< In the log's time.
};

ErrorFigures error_figures(const RunLog& run) {
  const Channel& error = run.channel[1];
  ErrorFigures figures;
  TimeMean square_m2;
  int count = 0;
  double near_since_s = kNone;
  for (std::size_t i = 0; i < error.value.size(); ++i) {
    const double off_m = std::abs(error.value[i]);
    if (!(error.time_s[i] >= run.start_s && off_m < kArrived_m)) {
      near_since_s = kNone;
    } else if (!std::isfinite(near_since_s)) {
      near_since_s = error.time_s[i];
    }
    // As PathProgress counts a run at full speed: an approach crosses the path, and its swing
    // falls, before it has arrived.
    if (count == 0 && !(error.time_s[i] - near_since_s >= kArrivedFor_s)) {
      continue;
    }
    figures.arrived_s = count == 0 ? error.time_s[i] : figures.arrived_s;
    square_m2.add(error.time_s[i], off_m * off_m);
    ++count;
    if (!(off_m <= figures.most_m)) {
      figures.most_m = off_m;
      figures.most_s = error.time_s[i] - run.start_s;
    }
  }
  if (count > 0) {
    figures.rms_m = std::sqrt(square_m2.mean());
  }
  return figures;
}

struct LambdaFigures {
  double least = kNone;
  double mean = kNone;
};

/// While something was followed, a controller at rest has lambda 0; from the arrival on, if any.
LambdaFigures lambda_figures(const RunLog& run, double arrived_s) {
  LambdaFigures figures;
  TimeMean mean;
  for (std::size_t i = 0; i < run.channel[0].value.size(); ++i) {
    const double lambda = run.channel[0].value[i];
    if (lambda > 0.0 && !(run.channel[0].time_s[i] < arrived_s)) {
      figures.least = lambda >= figures.least ? figures.least : lambda;
      mean.add(run.channel[0].time_s[i], lambda);
    }
  }
  figures.mean = mean.mean();
  return figures;
}

double shared(const RunLog& run, const std::string& limit) {
  for (const auto& [name, share] : run.limit_share) {
    if (name == limit) {
      return share;
    }
  }
  return 0.0;
}

/// Of OperatorCommand.Task.
std::string task_name(std::uint8_t task) {
  constexpr std::array<const char*, 7> kNames = {"none", "dig",         "grade",     "program",
                                                 "jog",  "coordinated", "commission"};
  return task < kNames.size() ? kNames[task] : fmt::format("{}", task);
}

/// As in a task file; the bus has the core's codes.
const char* step_words(const RunStep& step) {
  return machines::step_name(static_cast<StepKind>(step.kind));
}

/// The most that a cylinder stands elsewhere at these moments; not a number where none is known.
double strokes_apart_m(const RunLog& first, double first_s, const RunLog& second, double second_s) {
  double most_m = kNone;
  for (std::size_t i = kFirstStroke; i < first.channel.size(); ++i) {
    most_m =
        std::fmax(most_m, std::abs(first.channel[i].at(first_s) - second.channel[i].at(second_s)));
  }
  return most_m;
}

/// Two task files may both be 'program' to the bus: what tells them apart; empty: nothing.
std::string program_note(const RunLog& first, const RunLog& second) {
  if (first.step.empty() || second.step.empty()) {
    return "";
  }
  if (first.task_number != second.task_number) {
    return fmt::format("two tasks: numbers {} and {} of the controller's", first.task_number,
                       second.task_number);
  }
  const std::size_t both = std::min(first.step.size(), second.step.size());
  for (std::size_t i = 0; i < both; ++i) {
    const RunStep& a = first.step[i];
    const RunStep& b = second.step[i];
    if (a.number != b.number || a.kind != b.kind) {
      return fmt::format(
          "two tasks: after {} steps the first goes on with step {} ({}), the second with {} ({})",
          i, a.number, step_words(a), b.number, step_words(b));
    }
    const double apart_m = strokes_apart_m(first, a.begun_s, second, b.begun_s);
    // The first begins where the machine happened to stand.
    if (i > 0 && apart_m > kOtherPlace_m) {
      return fmt::format(
          "two tasks, or two ways: where step {} ({}) begins, cylinders are up to {:.0f} mm apart",
          a.number, step_words(a), 1e3 * apart_m);
    }
  }
  return first.step.size() == second.step.size()
             ? ""
             : fmt::format("two tasks, or one that was not finished: {} and {} steps",
                           first.step.size(), second.step.size());
}

std::string cell(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

}  // namespace

std::vector<ComparedFigure> compared_figures(const RunLog& first, const RunLog& second) {
  const ErrorFigures a = error_figures(first);
  const ErrorFigures b = error_figures(second);
  const LambdaFigures lambda_a = lambda_figures(first, a.arrived_s);
  const LambdaFigures lambda_b = lambda_figures(second, b.arrived_s);
  const std::string way = first.is_dozer ? "grade" : "path";
  const std::string error = way + " error";
  const auto fault = [](const RunLog& run) {
    return run.first_fault_s ? *run.first_fault_s - run.start_s : kNone;
  };
  std::vector<ComparedFigure> figures = {
      {"time active", "s", first.active_s, second.active_s, 2},
      {error + ", largest", "mm", 1e3 * a.most_m, 1e3 * b.most_m, 1},
      {"  at, since the start", "s", a.most_s, b.most_s, 2},
      {error + ", RMS", "mm", 1e3 * a.rms_m, 1e3 * b.rms_m, 1},
      {"lambda, least once on the " + way, "", lambda_a.least, lambda_b.least, 3},
      {"lambda, mean once on the " + way, "", lambda_a.mean, lambda_b.mean, 3},
      {"first fault at, since the start", "s", fault(first), fault(second), 2}};
  std::map<std::string, bool> limits;
  for (const RunLog* run : {&first, &second}) {
    for (const auto& [name, share] : run->limit_share) {
      limits[name] = true;
    }
  }
  for (const auto& [name, is_there] : limits) {
    figures.push_back({"held by " + (name == "none" ? "nothing" : name), "%",
                       100.0 * shared(first, name), 100.0 * shared(second, name), 1});
  }
  return figures;
}

std::vector<std::string> compared_notes(
    const RunLog& first, const RunLog& second,
    const std::function<std::string(std::uint32_t hash)>& profile_name) {
  std::vector<std::string> notes;
  const auto known = [](std::uint32_t hash) { return hash != 0; };
  if (first.profile_hash != second.profile_hash && known(first.profile_hash) &&
      known(second.profile_hash)) {
    notes.push_back(fmt::format("two profiles: {} and {}", profile_name(first.profile_hash),
                                profile_name(second.profile_hash)));
  }
  if (first.task != second.task) {
    notes.push_back(
        fmt::format("two tasks: {} and {}", task_name(first.task), task_name(second.task)));
  } else if (const std::string note = program_note(first, second); !note.empty()) {
    notes.push_back(note);
  }
  for (const RunLog* run : {&first, &second}) {
    if (run->active_s < kShort_s) {
      notes.push_back(
          fmt::format("{}: the controller was active for {:.2f} s only", run->name, run->active_s));
    }
  }
  return notes;
}

std::string compared_table(const RunLog& first, const RunLog& second,
                           const std::vector<ComparedFigure>& figures) {
  const auto shortened = [](const std::string& name) {
    constexpr std::size_t kMost = 14;
    return name.size() > kMost ? ".." + name.substr(name.size() - kMost + 2) : name;
  };
  std::string table = fmt::format("{:<34}{:>15}{:>15}{:>12}\n", "", shortened(first.name),
                                  shortened(second.name), "difference");
  for (const ComparedFigure& figure : figures) {
    table += fmt::format("{:<34}{:>15}{:>15}{:>12}{}{}\n", figure.text,
                         cell(figure.first, figure.decimals), cell(figure.second, figure.decimals),
                         cell(figure.second - figure.first, figure.decimals),
                         figure.unit.empty() ? "" : " ", figure.unit);
  }
  return table;
}

}  // namespace graben::runs
