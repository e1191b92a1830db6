// Rows 17 to 23: frames, values and profiles that are not what they have to be.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

constexpr double kLittle_m = 0.004;
constexpr TimeUs kSilence_us = 50 * kMillisecondUs;

const std::vector<Fault> kMissing = {Fault::kStrokeMissing};

/// One wrong frame is counted and costs nothing; while they go on the stroke is missing.
void wrong_length(Trial& trial) {
  trial.dig();
  Rig& rig = *trial.rig;
  const std::uint32_t id = trial.any_id(kStrokeIds);
  const auto length = static_cast<std::uint8_t>(trial.any_of(8));
  const std::uint32_t before = rig.ecu->link().wrong_length;
  rig.tamper = [id, length, left = 1](CanFrame& frame, const LoopbackPort*) mutable {
    if (frame.id == id && left-- > 0) {
      frame.length = length;
    }
    return true;
  };
  trial.expect_ignored(200 * kMillisecondUs, kLittle_m);
  trial.check(rig.ecu->link().wrong_length == before + 1, "the frame is not counted");
  Stop stop;
  stop.since_us = trial.last_us(id);
  stop.any = kMissing;
  stop.detect_us = stop.neutral_us = kSilence_us;
  rig.tamper = [id, length](CanFrame& frame, const LoopbackPort*) {
    frame.length = frame.id == id ? length : frame.length;
    return true;
  };
  stop.cure = [&rig] { rig.tamper = nullptr; };
  trial.expect_stop(stop);
}

/// Frames beside the live ones, in each cycle and for any message of the bus, as `make` has them.
void beside_the_live(Trial& trial, void (*make)(Trial& trial, CanFrame& frame)) {
  trial.dig();
  Rig& rig = *trial.rig;
  rig.before_ecu = [&trial, &rig, make] {
    const auto& message =
        bus::kMessages[trial.any_of(static_cast<unsigned>(std::size(bus::kMessages)))];
    CanFrame frame;
    frame.id = message.id;
    frame.length = 8;
    for (std::uint8_t& byte : frame.data) {
      byte = static_cast<std::uint8_t>(trial.any_of(250));
    }
    protect(frame, static_cast<std::uint8_t>(trial.any_of(kE2eCounterCount)));
    make(trial, frame);
    rig.bus.inject(frame);
  };
  trial.expect_ignored(500 * kMillisecondUs, 0.0);
}

void foreign_kinds(Trial& trial) {
  beside_the_live(trial, [](Trial& of, CanFrame& frame) {
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
void short_ids(Trial& trial) {
  beside_the_live(trial, [](Trial& of, CanFrame& frame) {
    constexpr std::uint32_t kShort = 0x7FF;
    frame.extended = false;
    frame.id = of.any_of(2) == 0 ? frame.id & kShort : frame.id;
  });
}

dbc::Field stroke_field() { return bus::BoomStroke::kBoomStroke; }
dbc::Field pressure_field(unsigned side) {
  return side == 0 ? bus::BoomPressure::kBoomCapPressure : bus::BoomPressure::kBoomRodPressure;
}

/// A raw value in the place of a measured one: all stroke messages have one layout, all pressure
/// messages too.
void raw_value(Rig& rig, std::uint32_t id, const dbc::Field& field, std::uint32_t raw,
               int frames = 1 << 20) {
  rig.tamper = [id, field, raw, left = frames](CanFrame& frame, const LoopbackPort*) mutable {
    if (frame.id == id && left-- > 0) {
      set_raw(frame, field, raw);
    }
    return true;
  };
}

/// A stroke by every second seed, a pressure by the others.
void special_value(Trial& trial, std::uint32_t raw, std::vector<Fault> of_a_stroke) {
  trial.dig();
  Rig& rig = *trial.rig;
  const auto cure = [&rig] { rig.tamper = nullptr; };
  if (trial.odd()) {
    raw_value(rig, trial.any_id(kStrokeIds), stroke_field(), raw);
    Stop stop;
    stop.since_us = rig.now_us;
    stop.any = std::move(of_a_stroke);
    stop.detect_us = stop.neutral_us = kCycle_us;
    stop.cure = cure;
    trial.expect_stop(stop);
    return;
  }
  raw_value(rig, trial.any_id(kPressureIds), pressure_field(trial.any_of(2)), raw);
  Slowing slowing;
  slowing.since_us = rig.now_us;
  slowing.fault = Fault::kPressureMissing;
  slowing.detect_us = kCycle_us;
  slowing.cure = cure;
  trial.expect_slower(slowing);
}

void not_available(Trial& trial) {
  special_value(trial, 0xFF00U + trial.any_of(0x100), {Fault::kStrokeMissing});
}

void error_value(Trial& trial) {
  const bool of_a_stroke = trial.odd();
  special_value(trial, 0xFE00U + trial.any_of(0x100), {Fault::kStrokeMissing, Fault::kSensorError});
  trial.check(!of_a_stroke || trial.outcome.codes.has(Fault::kSensorError),
              "the sensor's own word is not diagnosed");
}

/// Beyond any range that these messages have, and no special value. A stroke: slower for one such
/// frame, stopped while they go on. A pressure: slower all the time.
void out_of_range(Trial& trial) {
  constexpr std::uint32_t kBeyond = 0xFA80;
  trial.dig();
  Rig& rig = *trial.rig;
  const bool stroke = trial.odd();
  const std::uint32_t id = stroke ? trial.any_id(kStrokeIds) : trial.any_id(kPressureIds);
  const dbc::Field field = stroke ? stroke_field() : pressure_field(trial.any_of(2));
  Slowing slowing;
  slowing.since_us = rig.now_us;
  slowing.fault = Fault::kValueOutOfRange;
  slowing.detect_us = kCycle_us;
  slowing.hold_us = stroke ? 200 * kMillisecondUs : slowing.hold_us;
  raw_value(rig, id, field, kBeyond, stroke ? 1 : 1 << 20);
  slowing.cure = [&rig] { rig.tamper = nullptr; };
  trial.expect_slower(slowing);
  if (!stroke) {
    return;
  }
  Stop stop;
  stop.since_us = trial.last_us(id);
  stop.any = kMissing;
  stop.detect_us = stop.neutral_us = kSilence_us;
  stop.cure = [&rig] { rig.tamper = nullptr; };
  raw_value(rig, id, field, kBeyond);
  trial.expect_stop(stop);
}

/// A line of the shipped profile, what becomes of it, and the key that the message has to name.
struct Defect {
  const char* line;
  const char* instead;
  const char* key;
};

constexpr Defect kDefects[] = {
    {"inertia = 6850.0", "inertia = nan", "boom.inertia"},
    {"mass = 2130.0", "mass = inf", "boom.mass"},
    {"length = 2.90", "length = 2900.0", "arm.length"},
    {"spool_travel = 0.010", "spool_travel = 10.0", "valve.spool_travel"},
    {"port_relief = 38.0e6", "port_relief = 380.0", "valve.port_relief"},
    {"servo_gain = 2.0", "", "control.servo_gain"},
    {"degraded_speed = 0.3", "", "safety.degraded_speed"},
    {"sensor_timeout = 0.045", "sensor_timeout = 0.045\nsensor_timeuot = 0.1",
     "control.sensor_timeuot"},
    {"deadband = 0.2", "deadband = -inf", "valve.deadband"},
    {"swash = 0.643", "swash = \"full\"", "experiment.swash"},
};

/// Three to six different defects at once: each must be in the list of errors.
void bad_profile(Trial& trial) {
  std::ifstream in(machines::find_profile("excavator_22t"));
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::vector<Defect> defects(std::begin(kDefects), std::end(kDefects));
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
    static_cast<void>(machines::load_excavator(file));
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

Rows format_rows() {
  return {{17, "wrong DLC, once and for good", "I; N L", wrong_length},
          {18, "RTR, error or FD frame with our id", "I", foreign_kinds},
          {19, "11-bit frame with our id's low bits", "I", short_ids},
          {20, "'not available': stroke or pressure", "N L | D", not_available},
          {21, "'error': stroke or pressure", "N L | D", error_value},
          {22, "value out of range, CRC right", "D; N L | D", out_of_range},
          {23, "NaN, Inf, mm, missing, unknown in a profile", "refused", bad_profile}};
}

}  // namespace graben::faults
