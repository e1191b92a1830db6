// SPDX-License-Identifier: Apache-2.0
#include "app/commission/commission_progress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/commission/commission_windows.hpp"
#include "app/machines/missing_file.hpp"

namespace graben::commission {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// What a frame resolves.
constexpr double kSame = 5e-5;

json drive_json(const SequenceOptions& options, unsigned k) {
  return {{"tried", options.drives[k]},
          {"least_m", options.window[k].least_m},
          {"most_m", options.window[k].most_m},
          {"most_mps", options.window[k].most_mps},
          {"touches_retracted_end", options.touch_retracted[k]},
          {"touches_extended_end", options.touch_extended[k]}};
}

void read_drive(const json& drive, unsigned k, SequenceOptions& options) {
  options.drives[k] = drive.at("tried");
  options.window[k] = {drive.at("least_m"), drive.at("most_m"), drive.at("most_mps")};
  options.touch_retracted[k] = drive.at("touches_retracted_end");
  options.touch_extended[k] = drive.at("touches_extended_end");
  if (options.drives[k]) {
    require_possible(options.window[k], options.stroke_m[k], axis_name(static_cast<int>(k)));
  }
}

json swing_json(const SequenceOptions& options) {
  return {{"tried", options.swing},
          {"right_rad", options.sector.right_rad},
          {"left_rad", options.sector.left_rad},
          {"most_radps", options.sector.most_radps}};
}

/// A progress from before the swing was led has none.
void read_swing(const json& drives, SequenceOptions& options) {
  const char* const name = axis_name(kSwing);
  options.swing = options.has_swing && drives.contains(name) && drives.at(name).at("tried");
  if (options.swing) {
    const json& swing = drives.at(name);
    options.sector = {swing.at("right_rad"), swing.at("left_rad"), swing.at("most_radps")};
    require_possible(options.sector);
  }
}

json steps_json(const Progress& progress) {
  const std::vector<SequenceStep> plan = planned_steps(progress.options);
  json steps = json::array();
  for (std::size_t at = 0; at < progress.results.size(); ++at) {
    const StepResult& result = progress.results[at];
    steps.push_back({{"step", step_text(plan.at(at))},
                     {"end", end_text(result.end)},
                     {"duty", result.duty},
                     {"speed_mps", result.speed_mps},
                     {"took_s", result.took_s}});
  }
  return steps;
}

StepEnd read_end(const std::string& text) {
  for (const StepEnd end : {StepEnd::kDone, StepEnd::kAtWindow, StepEnd::kNoMotion,
                            StepEnd::kOutside, StepEnd::kNoTime}) {
    if (text == end_text(end)) {
      return end;
    }
  }
  throw std::runtime_error(fmt::format("'{}' is no end of a step", text));
}

void read_steps(const json& steps, Progress& progress) {
  const std::vector<SequenceStep> plan = planned_steps(progress.options);
  for (const json& step : steps) {
    const std::size_t at = progress.results.size();
    if (at >= plan.size() || step.at("step") != step_text(plan[at])) {
      throw std::runtime_error("its steps are not those of this version of the sequence");
    }
    progress.results.push_back(
        {read_end(step.at("end")), step.at("duty"), step.at("speed_mps"), step.at("took_s")});
  }
}

/// What was left untouched although it was free may stay so.
bool are_same(const SequenceOptions& before, const SequenceOptions& now, unsigned k) {
  const Window& one = before.window[k];
  const Window& other = now.window[k];
  return std::abs(one.least_m - other.least_m) < kSame &&
         std::abs(one.most_m - other.most_m) < kSame &&
         std::abs(one.most_mps - other.most_mps) < kSame &&
         (now.touch_retracted[k] || !before.touch_retracted[k]) &&
         (now.touch_extended[k] || !before.touch_extended[k]);
}

}  // namespace

fs::path progress_file(const fs::path& log) { return log.string() + ".progress.json"; }

void write_progress(const fs::path& file, const Progress& progress) {
  json root = {{"profile_hash", progress.profile_hash},
               {"levels", progress.options.steps},
               {"bursts", progress.options.bursts},
               {"pairs", progress.options.pairs},
               {"steps", steps_json(progress)}};
  for (int axis = 0; axis < kAxisCount; ++axis) {
    root["drives"][axis_name(axis)] = drive_json(progress.options, static_cast<unsigned>(axis));
  }
  if (progress.options.has_swing) {
    root["drives"][axis_name(kSwing)] = swing_json(progress.options);
  }
  const fs::path part = file.string() + ".part";
  std::ofstream stream(part);
  stream << root.dump(1) << '\n';
  stream.close();
  if (!stream) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
  fs::rename(part, file);
}

Progress read_progress(const fs::path& file, std::uint32_t profile_hash,
                       const SequenceOptions& machine) {
  std::ifstream stream(file);
  if (!stream) {
    throw std::runtime_error(machines::unread_text(
        file, "the progress of a commissioning, which one that was stopped leaves beside its log"));
  }
  Progress progress;
  progress.options = machine;
  try {
    const json root = json::parse(stream);
    progress.profile_hash = root.at("profile_hash");
    progress.options.steps = root.at("levels");
    progress.options.bursts = root.at("bursts");
    progress.options.pairs = root.at("pairs");
    for (int axis = 0; axis < kAxisCount; ++axis) {
      read_drive(root.at("drives").at(axis_name(axis)), static_cast<unsigned>(axis),
                 progress.options);
    }
    read_swing(root.at("drives"), progress.options);
    read_steps(root.at("steps"), progress);
  } catch (const json::exception&) {
    throw std::runtime_error(fmt::format(
        "{}: damaged, so that nothing can be gone on with; begin newly with another --log",
        file.string()));
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  if (progress.profile_hash != profile_hash) {
    throw std::runtime_error(fmt::format(
        "{}: begun with another profile (hash {:08x}, this one's is {:08x}); begin newly",
        file.string(), progress.profile_hash, profile_hash));
  }
  return progress;
}

void require_same_windows(const SequenceOptions& before, const SequenceOptions& now) {
  const auto differs = [](double one, double other) { return std::abs(one - other) >= kSame; };
  if (before.swing && (!now.swing || differs(before.sector.right_rad, now.sector.right_rad) ||
                       differs(before.sector.left_rad, now.sector.left_rad) ||
                       differs(before.sector.most_radps, now.sector.most_radps))) {
    throw std::runtime_error(fmt::format("begun with another sector ({}), now {}; begin newly",
                                         sector_text(before.sector),
                                         now.swing ? sector_text(now.sector) : "none"));
  }
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    if (before.drives[k] && !are_same(before, now, k)) {
      throw std::runtime_error(fmt::format("begun with another window ({}), now {}; begin newly",
                                           window_text(before, axis), window_text(now, axis)));
    }
  }
}

}  // namespace graben::commission
