// SPDX-License-Identifier: Apache-2.0
#include "app/commission/commission_windows.hpp"

#include <fmt/format.h>

#include <sstream>

#include "app/machines/profile_document.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::commission {
namespace {

constexpr double kNearEnd = 0.05;
constexpr double kUsual_mps = 0.5;
constexpr double kLeast_mps = 0.02;
constexpr double kMost_mps = 2.0;
/// Room for a ramp to each side and what a late machine needs to stop.
constexpr double kLeastLength_m = 0.20;

bool is_possible(const Window& window, double stroke_m) {
  return window.least_m >= 0.0 && window.most_m <= stroke_m &&
         window.most_m - window.least_m >= kLeastLength_m && window.most_mps >= kLeast_mps &&
         window.most_mps <= kMost_mps;
}

std::string possible_text(double stroke_m) {
  return fmt::format("allowed: within 0 .. {:.3f} m, at least {:.2f} m long", stroke_m,
                     kLeastLength_m);
}

constexpr double kMostSector_rad = 3.0;
/// Each side: less is no room to come to a speed and to stop.
constexpr double kLeastSector_rad = 0.6;
constexpr double kLeast_radps = 0.1;
constexpr double kMost_radps = 1.5;

bool is_possible(const Sector& sector) {
  return sector.right_rad >= -kMostSector_rad && sector.left_rad <= kMostSector_rad &&
         sector.left_rad - sector.right_rad >= kLeastSector_rad &&
         sector.most_radps >= kLeast_radps && sector.most_radps <= kMost_radps;
}

std::string possible_sector() {
  return fmt::format("allowed: within {} .. {} rad, at least {} rad wide", -kMostSector_rad,
                     kMostSector_rad, kLeastSector_rad);
}

void read_sector(machines::TomlReader& reader, Sector& sector) {
  const machines::Range angle{-kMostSector_rad, kMostSector_rad, "rad"};
  sector.right_rad = reader.number("swing.right", angle, "farthest to the right");
  sector.left_rad = reader.number("swing.left", angle, "farthest to the left");
  sector.most_radps =
      reader.number("swing.speed", {kLeast_radps, kMost_radps, "rad/s"}, "largest speed");
  if (reader.is_sound() && !is_possible(sector)) {
    reader.fail("swing", fmt::format("from {:.3f} to {:.3f} rad; {}", sector.right_rad,
                                     sector.left_rad, possible_sector()));
  }
}

void put(const DriveAnswer& answer, unsigned k, SequenceOptions& options) {
  options.window[k] = answer.window;
  options.touch_retracted[k] = answer.retracted_end_free;
  options.touch_extended[k] = answer.extended_end_free;
}

void free_ends(double stroke_m, DriveAnswer& answer) {
  if (answer.retracted_end_free) {
    answer.window.least_m = 0.0;
  }
  if (answer.extended_end_free) {
    answer.window.most_m = stroke_m;
  }
}

DriveAnswer read_drive(machines::TomlReader& reader, const std::string& name, double stroke_m) {
  DriveAnswer answer;
  answer.retracted_end_free =
      reader.boolean_or(false, name + ".retracted_end_free", "the retracted end may be touched");
  answer.extended_end_free =
      reader.boolean_or(false, name + ".extended_end_free", "the extended end may be touched");
  const machines::Range stroke{0.0, stroke_m, "m"};
  if (!answer.retracted_end_free) {
    answer.window.least_m = reader.number(name + ".least", stroke, "least stroke");
  }
  if (!answer.extended_end_free) {
    answer.window.most_m = reader.number(name + ".most", stroke, "largest stroke");
  }
  answer.window.most_mps =
      reader.number(name + ".speed", {kLeast_mps, kMost_mps, "m/s"}, "largest speed");
  free_ends(stroke_m, answer);
  if (reader.is_sound() && !is_possible(answer.window, stroke_m)) {
    reader.fail(name, fmt::format("from {:.3f} to {:.3f} m; {}", answer.window.least_m,
                                  answer.window.most_m, possible_text(stroke_m)));
  }
  return answer;
}

/// "yes" or "no"; nothing for anything else.
std::optional<bool> yes_or_no(const std::string& text) {
  if (text.empty() || text == "n" || text == "no") {
    return false;
  }
  return text == "y" || text == "yes" ? std::optional<bool>(true) : std::nullopt;
}

/// Numbers and nothing else; false if `text` is something else.
bool read_numbers(const std::string& text, std::initializer_list<double*> numbers) {
  std::istringstream words(text);
  for (double* const number : numbers) {
    if (!(words >> *number)) {
      return false;
    }
  }
  std::string rest;
  return !(words >> rest);
}

bool ask_end(const Ask& ask, const char* drive, const char* end, bool& free) {
  for (;;) {
    const auto said = ask(fmt::format("{}: may its {} end be touched, gently? [y/N] ", drive, end));
    if (!said) {
      return false;
    }
    if (const auto answer = yes_or_no(*said)) {
      free = *answer;
      return true;
    }
  }
}

bool ask_drive(const Ask& ask, int axis, double stroke_m, DriveAnswer& answer) {
  const char* const drive = axis_name(axis);
  if (!ask_end(ask, drive, "retracted", answer.retracted_end_free) ||
      !ask_end(ask, drive, "extended", answer.extended_end_free)) {
    return false;
  }
  const DriveAnswer proposed = answer;
  for (std::string why;;) {
    answer = proposed;
    free_ends(stroke_m, answer);
    const auto said = ask(fmt::format("{}{}: window, m: LEAST MOST [{:.3f} {:.3f}] ", why, drive,
                                      answer.window.least_m, answer.window.most_m));
    const auto speed =
        said ? ask(fmt::format("{}: largest speed, m/s [{:.2f}] ", drive, answer.window.most_mps))
             : std::nullopt;
    if (!speed) {
      return false;
    }
    const bool read =
        (said->empty() || read_numbers(*said, {&answer.window.least_m, &answer.window.most_m})) &&
        (speed->empty() || read_numbers(*speed, {&answer.window.most_mps}));
    free_ends(stroke_m, answer);
    if (read && is_possible(answer.window, stroke_m)) {
      return true;
    }
    why = fmt::format("This cannot be; {}, {} .. {} m/s\n", possible_text(stroke_m), kLeast_mps,
                      kMost_mps);
  }
}

bool ask_sector(const Ask& ask, Sector& sector) {
  const Sector proposed = sector;
  for (std::string why;;) {
    sector = proposed;
    double right_deg = kDegreesPerRad * sector.right_rad;
    double left_deg = kDegreesPerRad * sector.left_rad;
    const auto said = ask(
        fmt::format("{}swing: sector, deg: RIGHT LEFT [{:.0f} {:.0f}] ", why, right_deg, left_deg));
    const auto speed =
        said ? ask(fmt::format("swing: largest speed, rad/s [{:.2f}] ", sector.most_radps))
             : std::nullopt;
    if (!speed) {
      return false;
    }
    const bool read = (said->empty() || read_numbers(*said, {&right_deg, &left_deg})) &&
                      (speed->empty() || read_numbers(*speed, {&sector.most_radps}));
    sector.right_rad = right_deg / kDegreesPerRad;
    sector.left_rad = left_deg / kDegreesPerRad;
    if (read && is_possible(sector)) {
      return true;
    }
    why = fmt::format("This cannot be; {}, {} .. {} rad/s\n", possible_sector(), kLeast_radps,
                      kMost_radps);
  }
}

}  // namespace

void require_possible(const Sector& sector) {
  if (!is_possible(sector)) {
    throw std::runtime_error(fmt::format("swing: from {:g} to {:g} rad at {:g} rad/s; {}",
                                         sector.right_rad, sector.left_rad, sector.most_radps,
                                         possible_sector()));
  }
}

std::string sector_text(const Sector& sector) {
  return fmt::format("swing: from {:.0f} deg (right) to {:.0f} deg (left), at most {:.2f} rad/s",
                     kDegreesPerRad * sector.right_rad, kDegreesPerRad * sector.left_rad,
                     sector.most_radps);
}

void require_possible(const Window& window, double stroke_m, const std::string& name) {
  if (!is_possible(window, stroke_m)) {
    throw std::runtime_error(fmt::format("{}: from {:g} to {:g} m at {:g} m/s; {}, {} .. {} m/s",
                                         name, window.least_m, window.most_m, window.most_mps,
                                         possible_text(stroke_m), kLeast_mps, kMost_mps));
  }
}

DriveAnswer proposed_answer(double stroke_m) {
  return {{kNearEnd * stroke_m, (1.0 - kNearEnd) * stroke_m, kUsual_mps}, false, false};
}

void read_windows(const std::filesystem::path& file, SequenceOptions& options) {
  const machines::ProfileDocument document = machines::read_document(file);
  machines::TomlReader reader(document.root);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const std::string name = axis_name(axis);
    if (options.drives[k] || document.root.contains(name)) {
      put(read_drive(reader, name, options.stroke_m[k]), k, options);
    }
  }
  // Nobody has confirmed where it may turn.
  const bool said = options.has_swing && document.root.contains("swing");
  options.swing = options.swing && said;
  if (said) {
    read_sector(reader, options.sector);
  }
  reader.refuse_unknown_keys();
  machines::throw_errors(document, reader);
}

bool ask_windows(const Ask& ask, SequenceOptions& options) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    if (options.drives[k]) {
      DriveAnswer answer = proposed_answer(options.stroke_m[k]);
      if (!ask_drive(ask, axis, options.stroke_m[k], answer)) {
        return false;
      }
      put(answer, k, options);
    }
  }
  return !options.swing || ask_sector(ask, options.sector);
}

std::string window_text(const SequenceOptions& options, int axis) {
  const auto k = static_cast<unsigned>(axis);
  const Window& window = options.window[k];
  const bool retracted = options.touch_retracted[k];
  const bool extended = options.touch_extended[k];
  const char* const ends = retracted && extended ? "both ends are touched"
                           : retracted           ? "its retracted end is touched"
                           : extended            ? "its extended end is touched"
                                                 : "its ends are not touched";
  return fmt::format("{}: {:.3f} to {:.3f} of {:.3f} m, at most {:.2f} m/s, {}", axis_name(axis),
                     window.least_m, window.most_m, options.stroke_m[k], window.most_mps, ends);
}

}  // namespace graben::commission
