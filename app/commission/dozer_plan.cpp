// SPDX-License-Identifier: Apache-2.0
#include "app/commission/dozer_plan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "app/commission/commission_windows.hpp"
#include "app/machines/profile_document.hpp"
#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/tilt.hpp"

namespace graben::commission {
namespace {

/// Between edge and ground.
constexpr double kClear_m = 0.10;
constexpr double kBladeMost_mps = 0.4;
constexpr double kLeastBlade_m = 0.12;
constexpr double kLeast_mps = 0.02;
constexpr double kMost_mps = 2.0;
/// Room to come to a speed and to stop, to each side.
constexpr double kLeastWay_m = 1.5;
constexpr double kMostWay_m = 15.0;
constexpr double kMostTravel_mps = 3.0;

/// Stroke at which the edge is still clear of the ground, its lower end too where it is `tilted`.
double lowest_m(const DozerProfile& profile, bool tilted) {
  const BladeKinematics blade(profile.blade);
  const double end_m =
      tilted ? profile.tilt.half_width_m() * std::sin(profile.tilt.angle_most_rad) : 0.0;
  double clear_m = 0.0;
  double low_m = blade.stroke_max_m();
  constexpr int kHalvings = 40;
  for (int n = 0; n < kHalvings; ++n) {
    const double at_m = 0.5 * (clear_m + low_m);
    (blade.edge_m(blade.angle_rad(at_m)).y() > kClear_m + end_m ? clear_m : low_m) = at_m;
  }
  return clear_m;
}

/// What another drive's words are made of.
std::string renamed(std::string text, int axis, const char* name) {
  const std::string old = axis_name(axis);
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at)) {
    text.replace(at, old.size(), name);
    at += std::string(name).size();
  }
  return text;
}

std::string in_words(const std::string& text) {
  return renamed(renamed(text, 0, kDozerDrives[0]), 1, kDozerDrives[1]);
}

std::string travel_text(const TravelStep& step) {
  const char* const way = step.sign > 0 ? "forward" : "back";
  return step.motor
             ? fmt::format("tracks, {}: motors to half of their displacement", way)
             : fmt::format("tracks, {}: step {} of {}", way, step.level + 1, kTravelLevelCount);
}

Window read_window(machines::TomlReader& reader, const std::string& name,
                   const machines::Range& range, double most_mps) {
  Window window;
  window.least_m = reader.number(name + ".least", range, "least stroke, or way behind (below 0)");
  window.most_m = reader.number(name + ".most", range, "largest stroke, or way before");
  window.most_mps = reader.number(name + ".speed", {kLeast_mps, most_mps, "m/s"}, "largest speed");
  return window;
}

void read_blade(machines::TomlReader& reader, std::size_t drive, SequenceOptions& options) {
  const std::string name = kDozerDrives[drive];
  Window& window = options.window[drive];
  window = read_window(reader, name, {0.0, options.stroke_m[drive], "m"}, kMost_mps);
  if (reader.is_sound() && window.most_m - window.least_m < kLeastBlade_m) {
    reader.fail(name, fmt::format("from {:.3f} to {:.3f} m; allowed: at least {} m long",
                                  window.least_m, window.most_m, kLeastBlade_m));
  }
}

void read_way(machines::TomlReader& reader, Window& way) {
  const std::string name = kDozerDrives[2];
  way = read_window(reader, name, {-kMostWay_m, kMostWay_m, "m"}, kMostTravel_mps);
  if (reader.is_sound() && (way.least_m > -kLeastWay_m || way.most_m < kLeastWay_m)) {
    reader.fail(name, fmt::format("from {:.2f} to {:.2f} m; allowed: at least {} m to each side",
                                  way.least_m, way.most_m, kLeastWay_m));
  }
}

bool is_between(double least, double value, double most) { return least <= value && value <= most; }

bool is_possible(const Window& window, const machines::Range& range, double most_mps) {
  return is_between(range.least, window.least_m, range.most) &&
         is_between(range.least, window.most_m, range.most) &&
         is_between(kLeast_mps, window.most_mps, most_mps);
}

}  // namespace

DozerOptions whole_dozer(const DozerProfile& profile) {
  DozerOptions options;
  options.has_tilt = profile.tilt.present;
  SequenceOptions& blade = options.blade;
  blade.drives = {true, profile.tilt.present, false};
  blade.touch_extended = blade.touch_retracted = {false, false, false};
  blade.pairs = false;
  // A blade may stand on the ground: up is the way that is free.
  blade.first_sign[0] = -1;
  blade.room = 0.3;
  blade.room_per_level = 0.15;
  blade.room_most = 0.9;
  blade.first_inside = 0.4;
  blade.there_m = 0.015;
  blade.stroke_m[0] = BladeKinematics(profile.blade).stroke_max_m();
  blade.window[0] = {0.0, lowest_m(profile, false), kBladeMost_mps};
  if (profile.tilt.present) {
    blade.stroke_m[1] = TiltKinematics(profile.tilt).stroke_max_m();
    blade.window[1] = {0.0, blade.stroke_m[1], kBladeMost_mps};
    blade.parked_m = 0.5 * lowest_m(profile, true);
  }
  return options;
}

std::vector<TravelStep> planned_travel(const DozerOptions& options) {
  std::vector<TravelStep> steps;
  if (!options.tracks) {
    return steps;
  }
  for (int level = 0; level < kTravelLevelCount; ++level) {
    steps.push_back({1, level, false});
    steps.push_back({-1, level, false});
  }
  steps.push_back({1, 0, true});
  steps.push_back({-1, 0, true});
  return steps;
}

std::vector<std::string> dozer_step_texts(const DozerOptions& options) {
  std::vector<std::string> texts;
  for (const SequenceStep& step : planned_steps(options.blade)) {
    texts.push_back(in_words(step_text(step)));
  }
  for (const TravelStep& step : planned_travel(options)) {
    texts.push_back(travel_text(step));
  }
  return texts;
}

std::string dozer_wrong_text(const WrongWay& wrong) { return in_words(wrong_text(wrong)); }

std::vector<std::string> dozer_window_texts(const DozerOptions& options) {
  std::vector<std::string> texts;
  for (int axis = 0; axis < 2; ++axis) {
    if (options.blade.drives[static_cast<std::size_t>(axis)]) {
      texts.push_back(in_words(window_text(options.blade, axis)));
    }
  }
  if (options.tracks) {
    texts.push_back(
        fmt::format("tracks: from {:.1f} m behind to {:.1f} m before where they stand, "
                    "at most {:.2f} m/s",
                    -options.way.least_m, options.way.most_m, options.way.most_mps));
  }
  return texts;
}

void require_possible(const DozerOptions& options) {
  const auto require = [](std::size_t drive, bool possible, const Window& window) {
    if (!possible) {
      throw std::runtime_error(fmt::format("{}: from {:g} to {:g} m at {:g} m/s cannot be",
                                           kDozerDrives[drive], window.least_m, window.most_m,
                                           window.most_mps));
    }
  };
  for (std::size_t drive = 0; drive < 2; ++drive) {
    const Window& window = options.blade.window[drive];
    const bool possible =
        is_possible(window, {0.0, options.blade.stroke_m[drive], "m"}, kMost_mps) &&
        window.most_m - window.least_m >= kLeastBlade_m;
    require(drive, possible || !options.blade.drives[drive], window);
  }
  const Window& way = options.way;
  const bool possible = is_possible(way, {-kMostWay_m, kMostWay_m, "m"}, kMostTravel_mps) &&
                        way.least_m <= -kLeastWay_m && way.most_m >= kLeastWay_m;
  require(2, possible || !options.tracks, way);
}

void read_dozer_windows(const std::filesystem::path& file, DozerOptions& options) {
  const machines::ProfileDocument document = machines::read_document(file);
  machines::TomlReader reader(document.root);
  for (std::size_t drive = 0; drive < 2; ++drive) {
    const bool is_there = drive == 0 || options.has_tilt;
    const bool said = is_there && document.root.contains(kDozerDrives[drive]);
    options.blade.drives[drive] = options.blade.drives[drive] && said;
    if (said) {
      read_blade(reader, drive, options.blade);
    }
  }
  const bool said = document.root.contains(kDozerDrives[2]);
  options.tracks = options.tracks && said;
  if (said) {
    read_way(reader, options.way);
  }
  reader.refuse_unknown_keys();
  machines::throw_errors(document, reader);
}

}  // namespace graben::commission
