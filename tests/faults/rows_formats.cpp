// SPDX-License-Identifier: Apache-2.0
// Rows 17 to 23: frames, values and profiles that are not what they have to be.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"
#include "tests/faults/trial.hpp"

namespace graben::faults {
namespace {

/// One wrong frame is counted and costs nothing; while they go on its values are missing.
template <class Kind>
void wrong_length(Trial<Kind>& trial) {
  auto& rig = trial.work();
  const Sensor& sensor = trial.any_sensor(Kind::vital());
  const std::uint32_t id = sensor.id;
  const auto length = static_cast<std::uint8_t>(trial.any_of(8));
  const std::uint32_t before = rig.ecu->link().wrong_length;
  rig.tamper = [id, length, left = 1](CanFrame& frame, const LoopbackPort*) mutable {
    if (frame.id == id && left-- > 0) {
      frame.length = length;
    }
    return true;
  };
  trial.expect_ignored(200 * kMillisecondUs, Kind::kLittle_m);
  trial.check(rig.ecu->link().wrong_length == before + 1, "the frame is not counted");
  Stop stop{trial.last_us(id), {sensor.missing}, kSilence_us, kSilence_us};
  rig.tamper = [id, length](CanFrame& frame, const LoopbackPort*) {
    frame.length = frame.id == id ? length : frame.length;
    return true;
  };
  stop.cure = [&rig] { rig.tamper = nullptr; };
  trial.expect_stop(stop);
}

/// Frames beside the live ones, in each cycle and for any message of the bus, as `make` has them.
template <class Kind>
void beside_the_live(Trial<Kind>& trial, void (*make)(Trial<Kind>& trial, CanFrame& frame)) {
  auto& rig = trial.work();
  rig.before_ecu = [&trial, &rig, make] {
    const auto& message =
        Kind::Dbc::kMessages[trial.any_of(static_cast<unsigned>(std::size(Kind::Dbc::kMessages)))];
    CanFrame frame;
    frame.id = message.id;
    frame.length = 8;
    for (std::uint8_t& byte : frame.data) {
      byte = static_cast<std::uint8_t>(trial.any_of(250));
    }
    protect<Kind>(frame, static_cast<std::uint8_t>(trial.any_of(kE2eCounterCount)));
    make(trial, frame);
    rig.bus.inject(frame);
  };
  trial.expect_ignored(500 * kMillisecondUs, 0.0);
}

template <class Kind>
void foreign_kinds(Trial<Kind>& trial) {
  beside_the_live<Kind>(trial, [](Trial<Kind>& of, CanFrame& frame) {
    switch (of.any_of(3)) {
      case 0:
        frame.remote = true;
        break;
      case 1:
        frame.error = true;
        break;
      default:
        frame.fd = true;
        break;
    }
  });
  trial.check(trial.rig->ecu->link().wrong_kind > 0, "none is counted");
}

/// The low 11 bits of an id of ours, and the whole number, as an 11-bit frame.
template <class Kind>
void short_ids(Trial<Kind>& trial) {
  beside_the_live<Kind>(trial, [](Trial<Kind>& of, CanFrame& frame) {
    constexpr std::uint32_t kShort = 0x7FF;
    frame.extended = false;
    frame.id = of.any_of(2) == 0 ? frame.id & kShort : frame.id;
  });
}

/// A raw value in the place of a measured one.
template <class Kind>
void raw_value(Rig<Kind>& rig, std::uint32_t id, const dbc::Field& field, std::uint32_t raw,
               int frames = 1 << 20) {
  rig.tamper = [id, field, raw, left = frames](CanFrame& frame, const LoopbackPort*) mutable {
    if (frame.id == id && left-- > 0) {
      set_raw<Kind>(frame, field, raw);
    }
    return true;
  };
}

/// Of a sensor that stops the machine by every second seed, of one that slows it by the others.
template <class Kind>
void special_value(Trial<Kind>& trial, std::uint32_t raw16, std::vector<Fault> beside) {
  auto& rig = trial.work();
  const auto cure = [&rig] { rig.tamper = nullptr; };
  const Sensor& sensor = trial.any_sensor(trial.odd() ? Kind::vital() : Kind::slowing());
  const dbc::Field& field = trial.any_field(sensor);
  raw_value(rig, sensor.id, field, special_raw(field, raw16));
  if (trial.odd()) {
    Stop stop{rig.now_us, std::move(beside)};
    stop.any.push_back(sensor.missing);
    stop.detect_us = stop.neutral_us = kCycle_us;
    stop.cure = cure;
    trial.expect_stop(stop);
    return;
  }
  Slowing slowing{rig.now_us, sensor.missing, cycle_us_of<Kind>(sensor.id)};
  slowing.cure = cure;
  trial.expect_slower(slowing);
}

template <class Kind>
void not_available(Trial<Kind>& trial) {
  special_value(trial, 0xFF00U + trial.any_of(0x100), {});
}

template <class Kind>
void error_value(Trial<Kind>& trial) {
  const bool stops = trial.odd();
  special_value(trial, 0xFE00U + trial.any_of(0x100), {Fault::kSensorError});
  trial.check(!stops || trial.outcome.codes.has(Fault::kSensorError),
              "the sensor's own word is not diagnosed");
}

/// Beyond any range that these messages have, and no special value. Of a sensor that stops the
/// machine: slower for one such frame, stopped while they go on. Of one that slows it: slower all
/// the time.
template <class Kind>
void out_of_range(Trial<Kind>& trial) {
  constexpr std::uint32_t kBeyond = 0x80;
  auto& rig = trial.work();
  const bool stops = trial.odd();
  const Sensor& sensor = trial.any_sensor(stops ? Kind::vital() : Kind::slowing());
  const dbc::Field& field = trial.any_field(sensor);
  const std::uint32_t raw = field.raw_max + kBeyond;
  Slowing slowing{rig.now_us, Fault::kValueOutOfRange, cycle_us_of<Kind>(sensor.id)};
  slowing.hold_us = stops ? 200 * kMillisecondUs : slowing.hold_us;
  raw_value(rig, sensor.id, field, raw, stops ? 1 : 1 << 20);
  slowing.cure = [&rig] { rig.tamper = nullptr; };
  trial.expect_slower(slowing);
  if (!stops) {
    return;
  }
  Stop stop{trial.last_us(sensor.id), {sensor.missing}, kSilence_us, kSilence_us};
  stop.cure = [&rig] { rig.tamper = nullptr; };
  raw_value(rig, sensor.id, field, raw);
  trial.expect_stop(stop);
}

/// Three to six different defects at once: each must be in the list of errors.
template <class Kind>
void bad_profile(Trial<Kind>& trial) {
  std::ifstream in(machines::find_profile(Kind::kProfile));
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::vector<Defect> defects = Kind::defects();
  for (std::size_t n = defects.size(); n > 1; --n) {
    std::swap(defects[n - 1], defects[trial.any_of(static_cast<unsigned>(n))]);
  }
  defects.resize(3 + trial.any_of(4));
  for (const Defect& defect : defects) {
    const std::size_t at = text.find(defect.line);
    trial.check(at != std::string::npos, fmt::format("no '{}' in the profile", defect.line));
    if (at != std::string::npos) {
      text.replace(at, std::string(defect.line).size(), defect.instead);
    }
  }
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      fmt::format("graben_faults_{}_{}.toml", ::getpid(), trial.seed());
  std::ofstream(file) << text;
  try {
    Kind::load(file);
    trial.check(false, "the profile was taken");
  } catch (const machines::ProfileError& error) {
    for (const Defect& defect : defects) {
      const bool named = std::any_of(
          error.errors().begin(), error.errors().end(),
          [&](const std::string& line) { return line.find(defect.key) != std::string::npos; });
      trial.check(named, fmt::format("'{}' is not among the errors", defect.key));
    }
    trial.saw("refused");
  }
  std::filesystem::remove(file);
}

}  // namespace

template <class Kind>
Rows<Kind> format_rows() {
  return {{17, "wrong DLC, once and for good", "I; N L", wrong_length<Kind>},
          {18, "RTR, error or FD frame with our id", "I", foreign_kinds<Kind>},
          {19, "11-bit frame with our id's low bits", "I", short_ids<Kind>},
          {20, "'not available': of what stops or slows", "N L | D", not_available<Kind>},
          {21, "'error': of what stops or slows", "N L | D", error_value<Kind>},
          {22, "value out of range, CRC right", "D; N L | D", out_of_range<Kind>},
          {23, "NaN, Inf, mm, missing, unknown in a profile", "refused", bad_profile<Kind>}};
}

template Rows<Excavator> format_rows();
template Rows<Dozer> format_rows();

}  // namespace graben::faults
