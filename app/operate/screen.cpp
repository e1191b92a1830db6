// SPDX-License-Identifier: Apache-2.0
#include "app/operate/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/runs/code_text.hpp"

namespace graben::operate {
namespace {

using Dbc = EcuListener::Dbc;

/// "label     text", over as many lines as it needs, words whole.
void put(std::vector<std::string>& lines, const char* label, const std::string& text) {
  constexpr std::size_t kIndent = 12;
  std::string line = fmt::format("{:<{}}", label, kIndent);
  std::istringstream words(text);
  bool is_first = true;
  for (std::string word; words >> word; is_first = false) {
    if (!is_first && line.size() + 1 + word.size() > kColumns) {
      lines.push_back(line);
      line = std::string(kIndent, ' ');
      is_first = true;
    }
    line += (is_first ? "" : " ") + word;
  }
  lines.push_back(line.substr(0, kColumns));
}

template <class Message>
std::string age_text(const Heard<Message>& heard, TimeUs now) {
  return heard.said ? fmt::format("{} ms ago", (now - heard.at_us) / kMillisecondUs) : "never";
}

const char* bus_words(CanPortState state) {
  switch (state) {
    case CanPortState::kClosed:
      return "closed";
    case CanPortState::kActive:
      return "active";
    case CanPortState::kErrorPassive:
      return "nobody acknowledges";
    case CanPortState::kBusOff:
      return "bus-off";
    case CanPortState::kDown:
      return "down";
  }
  return "";
}

Fault fault_of(const EcuListener& ecu) {
  return ecu.status().said ? static_cast<Fault>(ecu.status().said->fault.value) : Fault::kNone;
}

std::string deadman_text(const View& view) {
  if (view.request.enable) {
    return "HELD: enable is given";
  }
  const std::string why = trouble_words(view.trouble);
  if (view.deadman_held) {
    return fmt::format("held, and does not count: {}; release it", why);
  }
  return why.empty() ? "released" : "released; " + why;
}

std::string lambda_text(const Dbc::EcuStatus& status) {
  const Limit limit = {static_cast<LimitKind>(status.limit_kind.value),
                       static_cast<std::uint8_t>(status.limit_index.value)};
  std::string text = fmt::format("{} {:.3f}", bar(status.lambda.value), status.lambda.value);
  if (limit.kind != LimitKind::kNone) {
    text += ", held by " + runs::limit_words(limit, runs::excavator_actuators());
  }
  return text;
}

std::string strokes_text(const EcuListener& ecu, TimeUs now) {
  const auto strokes_m = ecu.strokes_m(now);
  std::string text;
  for (std::size_t i = 0; i < strokes_m.size(); ++i) {
    const std::string value = strokes_m[i] ? fmt::format("{:.3f} m", *strokes_m[i]) : "not heard";
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", runs::excavator_actuators()[i], value);
  }
  return text;
}

std::string axes_text(const View& view) {
  const Axes& axes = view.request.axes;
  const auto percent = [](double ratio) { return std::lround(100.0 * ratio); };
  const bool by_drive = view.chosen_task != Task::kCoordinated;
  return fmt::format("{} {:+d} %, {} {:+d} %, {} {:+d} %, swing {:+d} %", by_drive ? "boom" : "up",
                     percent(axes.boom_or_up_ratio), by_drive ? "arm" : "forward",
                     percent(axes.arm_or_forward_ratio), by_drive ? "bucket" : "attitude",
                     percent(axes.bucket_or_attitude_ratio), percent(axes.swing_ratio));
}

std::string asked_text(const View& view) {
  return fmt::format("{}, {}, speed {:.0f} %", task_words(view.chosen_task),
                     view.request.mode == OperatorMode::kAutomatic ? "Automatic" : "Manual",
                     100.0 * view.request.speed_override_ratio);
}

/// Empty while the controller tells neither force nor payload.
std::string load_text(const EcuListener& ecu, TimeUs now) {
  constexpr TimeUs kOld_us = 500 * kMillisecondUs;
  const auto& heard = ecu.tip_load();
  if (!heard.said || now - heard.at_us > kOld_us) {
    return "";
  }
  const Dbc::EcuTipLoad& load = *heard.said;
  std::string text;
  if (load.tip_force_outwards_n.state == dbc::RawState::kValid) {
    text = fmt::format("{:+.1f} kN outwards, {:+.1f} kN up, each +-{:.1f} kN",
                       1e-3 * load.tip_force_outwards_n.value, 1e-3 * load.tip_force_up_n.value,
                       1e-3 * load.tip_force_deviation_n.value);
  }
  if (load.payload_mass_kg.state == dbc::RawState::kValid) {
    text += fmt::format("{}payload {:.0f} +-{:.0f} kg", text.empty() ? "" : "; ",
                        load.payload_mass_kg.value, load.payload_deviation_kg.value);
  }
  return text;
}

const char* refused_words(Dbc::EcuChecks::Touch touch) {
  using Touch = Dbc::EcuChecks::Touch;
  switch (touch) {
    case Touch::kMoving:
      return "; last touch refused: the teeth were not still";
    case Touch::kNotByHand:
      return "; last touch refused: choose Manual first";
    case Touch::kNotKnown:
      return "; last touch refused: where the teeth are was not known";
    case Touch::kNoPoint:
      return "; last touch refused: no such point, or the benchmark comes first";
    case Touch::kContradict:
      return "; last touch refused: the site or its design has that point elsewhere";
    default:
      return "";
  }
}

/// Empty where the chosen task has no design, or the controller does not say.
std::string site_text(const EcuListener& ecu, TimeUs now) {
  using Frame = Dbc::EcuMotion::Frame;
  constexpr TimeUs kOld_us = 500 * kMillisecondUs;
  const auto& heard = ecu.motion();
  if (!heard.is_fresh(now, kOld_us) || heard.said->frame.state != dbc::RawState::kValid) {
    return "";
  }
  std::string text;
  switch (heard.said->frame.value) {
    case Frame::kNone:
      return "";
    case Frame::kUnknown:
      text = "UNKNOWN: touch the benchmark";
      break;
    case Frame::kBenchmark:
      text = "benchmark touched: now the heading's point";
      break;
    case Frame::kKnown:
      text = "known";
      break;
  }
  return ecu.checks().said ? text + refused_words(ecu.checks().said->touch.value) : text;
}

/// Empty where the profile has no mark, or the controller does not say.
std::string mark_text(const EcuListener& ecu, TimeUs now) {
  using Result = Dbc::EcuChecks::Result;
  constexpr TimeUs kOld_us = 2500 * kMillisecondUs;
  const auto& heard = ecu.checks();
  if (!heard.is_fresh(now, kOld_us) || heard.said->result.value == Result::kNoMark) {
    return "";
  }
  const Dbc::EcuChecks& checks = *heard.said;
  if (checks.result.value == Result::kNever) {
    return std::string("not checked since the start") + refused_words(checks.touch.value);
  }
  const auto mm = [](const dbc::Physical& way) { return std::lround(1e3 * way.value); };
  return fmt::format("{} {:.0f} min ago: {:+d} mm outwards, {:+d} across, {:+d} up{}",
                     checks.result.value == Result::kPassed ? "checked" : "MISSED",
                     checks.age_s.value / 60.0, mm(checks.off_outwards_m), mm(checks.off_across_m),
                     mm(checks.off_up_m), refused_words(checks.touch.value));
}

std::string also_text(const EcuListener& ecu, TimeUs now) {
  std::string text;
  for (const Fault fault : ecu.faults(now)) {
    if (fault != fault_of(ecu)) {
      text += (text.empty() ? "" : "; ") + std::string(runs::fault_words(fault));
    }
  }
  return text;
}

std::string version_text(const EcuListener& ecu) {
  const auto other = ecu.other_version();
  return other ? fmt::format("the controller's frames are version {}, this station's {}", *other,
                             Dbc::kDbcVersion)
               : "";
}

void put_controller(std::vector<std::string>& lines, const View& view) {
  const EcuListener& ecu = *view.ecu;
  const auto mode = ecu.mode(view.now_us);
  put(lines, "Controller",
      fmt::format("{}; status {}, health {}", mode_words(mode), age_text(ecu.status(), view.now_us),
                  age_text(ecu.health(), view.now_us)));
  if (const std::string version = version_text(ecu); !version.empty()) {
    put(lines, "", version);
  }
  if (!mode) {
    return;
  }
  if (*mode != EcuMode::kArmed && *mode != EcuMode::kActive) {
    put(lines, "Not armed", not_armed_words(ecu));
  }
  const Fault fault = fault_of(ecu);
  put(lines, "Fault", runs::fault_words(fault));
  if (fault != Fault::kNone) {
    put(lines, "", runs::fault_help(fault));
    put(lines, "", runs::pilot_words(fault));
  }
  if (const std::string also = also_text(ecu, view.now_us); !also.empty()) {
    put(lines, "Also", also);
  }
  put(lines, "Lambda", lambda_text(*ecu.status().said));
  if (const std::string load = load_text(ecu, view.now_us); !load.empty()) {
    put(lines, "Tip force", load);
  }
  if (const std::string mark = mark_text(ecu, view.now_us); !mark.empty()) {
    put(lines, "Mark", mark);
  }
  if (const std::string site = site_text(ecu, view.now_us); !site.empty()) {
    put(lines, "Site", site);
  }
}

}  // namespace

std::string not_armed_words(const EcuListener& ecu) {
  const std::uint32_t bits = ecu.health().said ? ecu.health().said->why_not_armed.value : 0;
  std::string text;
  for (int bit = 0; bit < kArmBlockCount; ++bit) {
    if ((bits >> static_cast<unsigned>(bit) & 1U) != 0) {
      text += (text.empty() ? "" : "; ") +
              std::string(runs::arm_block_words(static_cast<ArmBlock>(bit)));
    }
  }
  return text;
}

const char* mode_words(std::optional<EcuMode> mode) {
  return mode ? runs::mode_words(*mode) : "not heard";
}

const char* task_words(Task task) {
  switch (task) {
    case Task::kNone:
      return "no task";
    case Task::kJog:
      return "Jog";
    case Task::kCoordinated:
      return "Coordinated";
    case Task::kAssist:
      return "Assist";
    default:
      return "another task";
  }
}

std::string bar(double share) {
  constexpr int kCells = 20;
  const int full = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kCells));
  return fmt::format("[{:#>{}}{:.>{}}]", "", full, "", kCells - full);
}

std::vector<std::string> screen_lines(const View& view) {
  std::vector<std::string> lines;
  put(lines, "Station",
      fmt::format("{} {}; {}; {} s", view.interface, bus_words(view.bus), view.hands,
                  view.running_us / kSecondUs));
  put_controller(lines, view);
  put(lines, "Strokes", strokes_text(*view.ecu, view.now_us));
  lines.emplace_back();
  put(lines, "Asked for", asked_text(view));
  put(lines, "Levers", axes_text(view));
  put(lines, "Deadman", deadman_text(view));
  lines.emplace_back();
  std::istringstream help(view.help);
  for (std::string line; std::getline(help, line);) {
    lines.push_back(line.substr(0, kColumns));
  }
  return lines;
}

std::string state_line(const View& view) {
  const EcuListener& ecu = *view.ecu;
  const auto mode = ecu.mode(view.now_us);
  std::string line =
      fmt::format("{} {}; controller {}", view.interface, bus_words(view.bus), mode_words(mode));
  if (mode && fault_of(ecu) != Fault::kNone) {
    line += fmt::format(" ({})", runs::fault_words(fault_of(ecu)));
  } else if (mode && *mode != EcuMode::kArmed && *mode != EcuMode::kActive) {
    line += fmt::format(" ({})", not_armed_words(ecu));
  }
  if (const std::string version = version_text(ecu); !version.empty()) {
    line += "; " + version;
  }
  return fmt::format("{}; {}; deadman {}", line, asked_text(view), deadman_text(view));
}

}  // namespace graben::operate
