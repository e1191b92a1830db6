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

std::vector<std::string> texts_of(const SequenceOptions& options) {
  std::vector<std::string> texts;
  for (const SequenceStep& step : planned_steps(options)) {
    texts.push_back(step_text(step));
  }
  return texts;
}

std::vector<std::string> texts_of(const DozerOptions& options) { return dozer_step_texts(options); }

json steps_json(const std::vector<std::string>& texts, const std::vector<StepResult>& results) {
  json steps = json::array();
  for (std::size_t at = 0; at < results.size(); ++at) {
    const StepResult& result = results[at];
    steps.push_back({{"step", texts.at(at)},
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

std::vector<StepResult> read_steps(const json& steps, const std::vector<std::string>& texts) {
  std::vector<StepResult> results;
  for (const json& step : steps) {
    const std::size_t at = results.size();
    if (at >= texts.size() || step.at("step") != texts[at]) {
      throw std::runtime_error("its steps are not those of this version of the sequence");
    }
    results.push_back(
        {read_end(step.at("end")), step.at("duty"), step.at("speed_mps"), step.at("took_s")});
  }
  return results;
}

json drives_json(const SequenceOptions& options) {
  json drives;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    drives[axis_name(axis)] = drive_json(options, static_cast<unsigned>(axis));
  }
  if (options.has_swing) {
    drives[axis_name(kSwing)] = swing_json(options);
  }
  return drives;
}

json window_json(bool tried, const Window& window) {
  return {{"tried", tried},
          {"least_m", window.least_m},
          {"most_m", window.most_m},
          {"most_mps", window.most_mps}};
}

json drives_json(const DozerOptions& options) {
  json drives;
  for (std::size_t drive = 0; drive < 2; ++drive) {
    drives[kDozerDrives[drive]] =
        window_json(options.blade.drives[drive], options.blade.window[drive]);
  }
  drives[kDozerDrives[2]] = window_json(options.tracks, options.way);
  return drives;
}

/// What both kinds leave out of their sequence.
const SequenceOptions& parts_of(const SequenceOptions& options) { return options; }
const SequenceOptions& parts_of(const DozerOptions& options) { return options.blade; }
SequenceOptions& parts_of(SequenceOptions& options) { return options; }
SequenceOptions& parts_of(DozerOptions& options) { return options.blade; }

void read_drives(const json& drives, SequenceOptions& options) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    read_drive(drives.at(axis_name(axis)), static_cast<unsigned>(axis), options);
  }
  read_swing(drives, options);
}

void read_drives(const json& drives, DozerOptions& options) {
  const auto read = [&drives](std::size_t drive, Window& window) -> bool {
    const json& said = drives.at(kDozerDrives[drive]);
    window = {said.at("least_m"), said.at("most_m"), said.at("most_mps")};
    return said.at("tried");
  };
  for (std::size_t drive = 0; drive < 2; ++drive) {
    options.blade.drives[drive] =
        read(drive, options.blade.window[drive]) && (drive == 0 || options.has_tilt);
  }
  options.tracks = read(2, options.way);
  require_possible(options);
}

template <class Options>
void write(const fs::path& file, const ProgressOf<Options>& progress) {
  const SequenceOptions& parts = parts_of(progress.options);
  const json root = {{"profile_hash", progress.profile_hash},
                     {"levels", parts.steps},
                     {"bursts", parts.bursts},
                     {"pairs", parts.pairs},
                     {"drives", drives_json(progress.options)},
                     {"steps", steps_json(texts_of(progress.options), progress.results)}};
  const fs::path part = file.string() + ".part";
  std::ofstream stream(part);
  stream << root.dump(1) << '\n';
  stream.close();
  if (!stream) {
    throw std::runtime_error(file.string() + ": cannot be written");
  }
  fs::rename(part, file);
}

template <class Options>
ProgressOf<Options> read(const fs::path& file, std::uint32_t profile_hash, const Options& machine) {
  std::ifstream stream(file);
  if (!stream) {
    throw std::runtime_error(machines::unread_text(
        file, "the progress of a commissioning, which one that was stopped leaves beside its log"));
  }
  ProgressOf<Options> progress;
  progress.options = machine;
  try {
    const json root = json::parse(stream);
    progress.profile_hash = root.at("profile_hash");
    SequenceOptions& parts = parts_of(progress.options);
    parts.steps = root.at("levels");
    parts.bursts = root.at("bursts");
    parts.pairs = root.at("pairs");
    read_drives(root.at("drives"), progress.options);
    progress.results = read_steps(root.at("steps"), texts_of(progress.options));
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

bool is_same(const Window& one, const Window& other) {
  return std::abs(one.least_m - other.least_m) < kSame &&
         std::abs(one.most_m - other.most_m) < kSame &&
         std::abs(one.most_mps - other.most_mps) < kSame;
}

/// What was left untouched although it was free may stay so.
bool are_same(const SequenceOptions& before, const SequenceOptions& now, unsigned k) {
  return is_same(before.window[k], now.window[k]) &&
         (now.touch_retracted[k] || !before.touch_retracted[k]) &&
         (now.touch_extended[k] || !before.touch_extended[k]);
}

}  // namespace

fs::path progress_file(const fs::path& log) { return log.string() + ".progress.json"; }

void write_progress(const fs::path& file, const Progress& progress) { write(file, progress); }

void write_progress(const fs::path& file, const DozerProgress& progress) { write(file, progress); }

Progress read_progress(const fs::path& file, std::uint32_t profile_hash,
                       const SequenceOptions& machine) {
  return read(file, profile_hash, machine);
}

DozerProgress read_progress(const fs::path& file, std::uint32_t profile_hash,
                            const DozerOptions& machine) {
  return read(file, profile_hash, machine);
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

void require_same_windows(const DozerOptions& before, const DozerOptions& now) {
  const auto require = [](const char* drive, bool tried, const Window& one, bool again,
                          const Window& other) {
    if (tried && !(again && is_same(one, other))) {
      throw std::runtime_error(fmt::format(
          "{}: begun with another window ({:.3f} to {:.3f} m, {:.2f} m/s), now {}; begin newly",
          drive, one.least_m, one.most_m, one.most_mps,
          again ? fmt::format("{:.3f} to {:.3f} m, {:.2f} m/s", other.least_m, other.most_m,
                              other.most_mps)
                : std::string("none")));
    }
  };
  for (std::size_t drive = 0; drive < 2; ++drive) {
    require(kDozerDrives[drive], before.blade.drives[drive], before.blade.window[drive],
            now.blade.drives[drive], now.blade.window[drive]);
  }
  require(kDozerDrives[2], before.tracks, before.way, now.tracks, now.way);
}

}  // namespace graben::commission
