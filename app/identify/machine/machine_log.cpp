// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/machine_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "app/identify/machine/candump_reader.hpp"
#include "app/identify/machine/log_version.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/excavator/excavator_profile.hpp"
#include "hal/link/e2e.hpp"

namespace graben::identify {
namespace {

namespace bus = dbc::excavator;

constexpr double kShortest_s = 5.0;
/// Strokes come every 10 ms: without them for longer nobody knows what the machine did.
constexpr double kGap_s = 0.2;
/// Kernel stamps of frames that came together may be this much out of order.
constexpr double kBack_s = 0.002;

using Readings = std::vector<Reading>;

/// What comes off the bus, by its frames' times.
struct Signals {
  std::array<Readings, kDriveCount> duty;
  std::array<Readings, kDriveCount> spool;
  std::array<Readings, kDriveCount> stroke_m;
  std::array<Readings, kDriveCount> cap_pa;
  std::array<Readings, kDriveCount> rod_pa;
  std::array<Readings, kPumpCount> swash;
  Readings engine_radps;
};

constexpr std::array<const char*, kAxisCount> kNames = {"boom", "arm", "bucket"};
/// A signal may so often have no value: the last one holds meanwhile.
constexpr double kMostInvalid = 0.05;
/// Frames may so often be damaged.
constexpr double kMostRefused = 0.05;

/// A frame of a dozer that an excavator has not.
bool is_of_dozer(const LoggedFrame& frame) {
  return std::any_of(dbc::dozer::kMessages.begin(), dbc::dozer::kMessages.end(),
                     [&](const dbc::MessageInfo& message) { return message.id == frame.id; });
}

}  // namespace

/// Collects the frames of one log.
class LogCollector::Frames {
 public:
  explicit Frames(std::string name) : name_(std::move(name)) {
    for (const dbc::MessageInfo& message : bus::kMessages) {
      known_.emplace(message.id, message);
    }
  }

  void take(const LoggedFrame& frame) {
    const auto known = known_.find(frame.id);
    if (!frame.extended || known == known_.end()) {
      ++log_.foreign;
      dozer_ += frame.extended && is_of_dozer(frame) ? 1 : 0;
      return;
    }
    ++log_.frames;
    const dbc::MessageInfo& message = known->second;
    if (frame.length != message.length ||
        (message.is_protected && !e2e_crc_fits(frame.data, message.data_id))) {
      ++log_.refused;
      return;
    }
    if (frame.time_s < last_s_ - kBack_s) {
      fail(frame.line, fmt::format("its clock goes back by {:.3f} s", last_s_ - frame.time_s));
    }
    last_s_ = std::max(last_s_, frame.time_s);
    decode(frame);
  }

  MachineLog log(int pump_count, double swing_lever_m, bool told);

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", name_, line, what));
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", name_, what));
  }

  void add(Readings& to, double time_s, const dbc::Physical& value) {
    if (value.state == dbc::RawState::kValid) {
      to.push_back({time_s, value.value});
    } else {
      ++invalid_[&to];
    }
  }
  /// Refuses a signal that is missing, or has no value too often.
  void assert_heard(const Readings& readings, const std::string& what) const;

  void decode(const LoggedFrame& frame);
  void identify(const LoggedFrame& frame);
  void assert_whole(bool told) const;
  [[nodiscard]] LogSegment segment(double begin_s, double end_s, int pump_count) const;
  void scale_swing(double lever_m);

  std::string name_;
  std::unordered_map<std::uint32_t, dbc::MessageInfo> known_;
  MachineLog log_;
  Signals signals_;
  std::map<const Readings*, std::size_t> invalid_;
  std::string other_version_;
  std::size_t drives_ = kAxisCount;
  std::size_t dozer_ = 0;  ///< Frames that only a dozer's bus has.
  double last_s_ = -1e300;
};

void LogCollector::Frames::decode(const LoggedFrame& frame) {
  const double t = frame.time_s;
  const auto pressures = [&](std::size_t i, const dbc::Physical& cap, const dbc::Physical& rod) {
    add(signals_.cap_pa[i], t, cap);
    add(signals_.rod_pa[i], t, rod);
  };
  switch (frame.id) {
    case bus::BoomStroke::kId:
      return add(signals_.stroke_m[0], t, bus::BoomStroke::decode(frame.data).boom_stroke_m);
    case bus::ArmStroke::kId:
      return add(signals_.stroke_m[1], t, bus::ArmStroke::decode(frame.data).arm_stroke_m);
    case bus::BucketStroke::kId:
      return add(signals_.stroke_m[2], t, bus::BucketStroke::decode(frame.data).bucket_stroke_m);
    case bus::BoomPressure::kId: {
      const auto message = bus::BoomPressure::decode(frame.data);
      return pressures(0, message.boom_cap_pressure_pa, message.boom_rod_pressure_pa);
    }
    case bus::ArmPressure::kId: {
      const auto message = bus::ArmPressure::decode(frame.data);
      return pressures(1, message.arm_cap_pressure_pa, message.arm_rod_pressure_pa);
    }
    case bus::BucketPressure::kId: {
      const auto message = bus::BucketPressure::decode(frame.data);
      return pressures(2, message.bucket_cap_pressure_pa, message.bucket_rod_pressure_pa);
    }
    case bus::PumpState::kId: {
      const auto message = bus::PumpState::decode(frame.data);
      add(signals_.swash[0], t, message.pump1_swash_ratio);
      return add(signals_.swash[1], t, message.pump2_swash_ratio);
    }
    case bus::EEC1::kId:
      return add(signals_.engine_radps, t, bus::EEC1::decode(frame.data).engine_speed_radps);
    case bus::ValveState::kId: {
      const auto message = bus::ValveState::decode(frame.data);
      add(signals_.spool[0], t, message.boom_spool_ratio);
      add(signals_.spool[1], t, message.arm_spool_ratio);
      return add(signals_.spool[2], t, message.bucket_spool_ratio);
    }
    case bus::SpoolCommand::kId: {
      const auto message = bus::SpoolCommand::decode(frame.data);
      const bool on = message.enable.state == dbc::RawState::kValid &&
                      message.enable.value == bus::SpoolCommand::Enable::kOn;
      const std::array<dbc::Physical, kAxisCount> duty = {
          message.boom_duty_ratio, message.arm_duty_ratio, message.bucket_duty_ratio};
      for (std::size_t i = 0; i < kAxisCount; ++i) {
        const bool opens = on && duty[i].state == dbc::RawState::kValid;
        signals_.duty[i].push_back({t, opens ? duty[i].value : 0.0});
      }
      return;
    }
    case bus::SwingState::kId: {
      const auto message = bus::SwingState::decode(frame.data);
      add(signals_.stroke_m[kSwing], t, message.swing_angle_rad);
      return pressures(kSwing, message.swing_left_pressure_pa, message.swing_right_pressure_pa);
    }
    case bus::SwingValveState::kId:
      return add(signals_.spool[kSwing], t,
                 bus::SwingValveState::decode(frame.data).swing_spool_ratio);
    case bus::SwingCommand::kId: {
      const auto message = bus::SwingCommand::decode(frame.data);
      const bool on = message.enable.state == dbc::RawState::kValid &&
                      message.enable.value == bus::SwingCommand::Enable::kOn &&
                      message.swing_duty_ratio.state == dbc::RawState::kValid;
      signals_.duty[kSwing].push_back({t, on ? message.swing_duty_ratio.value : 0.0});
      return;
    }
    case bus::MachineIdentity::kId:
      return identify(frame);
    default:
      return;
  }
}

void LogCollector::Frames::identify(const LoggedFrame& frame) {
  const auto message = bus::MachineIdentity::decode(frame.data);
  if (message.dbc_version.state == dbc::RawState::kValid &&
      !is_read(message.dbc_version.value, kExcavatorVersions) && other_version_.empty()) {
    // A dozer's DBC has a version of its own: what the bus is comes first.
    other_version_ =
        fmt::format("{}:{}: the machine speaks version {} of the DBC, {}", name_, frame.line,
                    message.dbc_version.value, read_versions(kExcavatorVersions));
  }
  const std::uint32_t hash = message.profile_hash.value;
  if (log_.profile_hash != 0 && hash != log_.profile_hash) {
    fail(frame.line, fmt::format("two machines in one log: profile {:08x}, before {:08x}", hash,
                                 log_.profile_hash));
  }
  log_.profile_hash = hash;
}

namespace {

/// The last reading at or before each grid point; before the first, the first.
std::vector<double> sampled(const Readings& readings, double begin_s, std::size_t count,
                            double otherwise) {
  std::vector<double> values(count, otherwise);
  if (readings.empty()) {
    return values;
  }
  auto next = readings.begin();
  double held = next->value;
  for (std::size_t at = 0; at < count; ++at) {
    // Half a microsecond: a stamp that lies on the grid counts there, however it was rounded.
    const double now_s = begin_s + kGrid_s * static_cast<double>(at) + 5e-7;
    while (next != readings.end() && next->time_s <= now_s) {
      held = (next++)->value;
    }
    values[at] = held;
  }
  return values;
}

Readings within(const Readings& readings, double begin_s, double end_s) {
  const auto later = [](const Reading& reading, double time_s) { return reading.time_s < time_s; };
  const auto from = std::lower_bound(readings.begin(), readings.end(), begin_s, later);
  const auto until = std::lower_bound(from, readings.end(), end_s, later);
  Readings part(from, until);
  for (Reading& reading : part) {
    reading.time_s -= begin_s;
  }
  return part;
}

}  // namespace

LogSegment LogCollector::Frames::segment(double begin_s, double end_s, int pump_count) const {
  LogSegment part;
  part.begin_s = begin_s;
  const auto count = static_cast<std::size_t>((end_s - begin_s) / kGrid_s);
  part.senses_spools = true;
  part.drives = drives_;
  for (std::size_t i = 0; i < drives_; ++i) {
    CylinderSeries& axis = part.axis[i];
    axis.duty = sampled(signals_.duty[i], begin_s, count, 0.0);
    axis.stroke_m = sampled(signals_.stroke_m[i], begin_s, count, 0.0);
    axis.cap_pa = sampled(signals_.cap_pa[i], begin_s, count, 0.0);
    axis.rod_pa = sampled(signals_.rod_pa[i], begin_s, count, 0.0);
    axis.duties = within(signals_.duty[i], begin_s, end_s);
    axis.spools = within(signals_.spool[i], begin_s, end_s);
    part.senses_spools = part.senses_spools && (i == kSwing || !axis.spools.empty());
    axis.spool = axis.spools.empty() ? axis.duty : sampled(signals_.spool[i], begin_s, count, 0.0);
  }
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    const bool there = static_cast<int>(j) < pump_count;
    part.swash[j] = sampled(there ? signals_.swash[j] : Readings{}, begin_s, count, 0.0);
  }
  part.engine_radps = sampled(signals_.engine_radps, begin_s, count, 0.0);
  return part;
}

void LogCollector::Frames::assert_heard(const Readings& readings, const std::string& what) const {
  const auto found = invalid_.find(&readings);
  const std::size_t invalid = found == invalid_.end() ? 0 : found->second;
  const double share = static_cast<double>(invalid) /
                       static_cast<double>(std::max<std::size_t>(1, readings.size() + invalid));
  if (share > kMostInvalid) {
    refuse(fmt::format("{}: {:.0f} % of its frames have no value in range; at most {:.0f} % may",
                       what, 100.0 * share, 100.0 * kMostInvalid));
  }
  if (readings.empty()) {
    refuse(fmt::format("{} is not in it", what));
  }
}

void LogCollector::Frames::assert_whole(bool told) const {
  if (dozer_ > 0) {
    refuse("is the log of a dozer's bus; only excavators are identified");
  }
  if (!other_version_.empty()) {
    throw std::runtime_error(other_version_);
  }
  if (log_.frames == 0) {
    refuse(log_.foreign == 0 ? std::string("is empty: no frame is in it")
                             : fmt::format("no frame of an excavator on our bus ({} frames of "
                                           "others)",
                                           log_.foreign));
  }
  const double refused = static_cast<double>(log_.refused) / static_cast<double>(log_.frames);
  if (refused > kMostRefused) {
    refuse(
        fmt::format("{:.0f} % of its frames have a wrong checksum or length; at most {:.0f} % "
                    "may",
                    100.0 * refused, 100.0 * kMostRefused));
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    assert_heard(signals_.stroke_m[i], fmt::format("the stroke of the {}", kNames[i]));
    if (signals_.duty[i].empty()) {
      refuse("no SpoolCommand is in it: nothing says what the valves were sent");
    }
    assert_heard(signals_.cap_pa[i], fmt::format("the cap pressure of the {}", kNames[i]));
    assert_heard(signals_.rod_pa[i], fmt::format("the rod pressure of the {}", kNames[i]));
  }
  assert_heard(signals_.engine_radps, "the engine's speed");
  if (told) {
    assert_heard(signals_.swash[0], "the swash of pump 1");
  }
}

/// Angles as travels, as the core takes them.
void LogCollector::Frames::scale_swing(double lever_m) {
  const bool there = lever_m > 0.0 && !signals_.stroke_m[kSwing].empty() &&
                     !signals_.duty[kSwing].empty() && !signals_.cap_pa[kSwing].empty() &&
                     !signals_.rod_pa[kSwing].empty();
  drives_ = there ? kDriveCount : kAxisCount;
  for (Reading& angle : signals_.stroke_m[kSwing]) {
    angle.value *= lever_m;
  }
}

MachineLog LogCollector::Frames::log(int pump_count, double swing_lever_m, bool told) {
  assert_whole(told);
  scale_swing(swing_lever_m);
  const Readings& strokes = signals_.stroke_m[0];
  double begin_s = strokes.front().time_s;
  double last_s = begin_s;
  const auto end = [&](double end_s) {
    if (end_s - begin_s >= kShortest_s) {
      log_.segments.push_back(segment(begin_s, end_s, pump_count));
    }
  };
  for (const Reading& reading : strokes) {
    if (reading.time_s - last_s > kGap_s) {
      end(last_s);
      begin_s = reading.time_s;
    }
    last_s = reading.time_s;
  }
  end(last_s);
  if (log_.segments.empty()) {
    refuse(fmt::format("no {} s in one piece are in it ({:.1f} s in all)", kShortest_s,
                       strokes.back().time_s - strokes.front().time_s));
  }
  log_.name = name_;
  return std::move(log_);
}

LogCollector::LogCollector(std::string name) : frames_(new Frames(std::move(name))) {}
LogCollector::~LogCollector() = default;
void LogCollector::take(const LoggedFrame& frame) { frames_->take(frame); }
MachineLog LogCollector::log(int pump_count, double swing_lever_m, bool told) {
  return frames_->log(pump_count, swing_lever_m, told);
}

double MachineLog::length_s() const {
  double sum_s = 0.0;
  for (const LogSegment& part : segments) {
    sum_s += part.length_s();
  }
  return sum_s;
}

MachineLog read_machine_log(const std::filesystem::path& file, int pump_count, double swing_lever_m,
                            bool told) {
  LogCollector collector(file.filename().string());
  LogRead read = read_candump(file, [&](const LoggedFrame& frame) { collector.take(frame); });
  MachineLog log = collector.log(pump_count, swing_lever_m, told);
  log.sha256 = read.sha256;
  log.notes = read.notes();
  return log;
}

}  // namespace graben::identify
