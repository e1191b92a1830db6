// SPDX-License-Identifier: Apache-2.0
#include "app/identify/dozer/dozer_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "app/identify/machine/log_version.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "hal/link/e2e.hpp"

namespace graben::identify {
namespace {

namespace dozer_bus = dbc::dozer;

constexpr double kShortestLog_s = 5.0;
/// Strokes come every 10 ms: without them for longer nobody knows what the machine did.
constexpr double kLogGap_s = 0.2;
constexpr double kMostDamaged = 0.05;

using Readings = std::vector<Reading>;

struct BladeReadings {
  Readings duty;
  Readings spool;
  Readings stroke_m;
};

struct TrackReadings {
  Readings pump_sent;
  Readings motor_sent;
  Readings pump;
  Readings motor;
  Readings speed_mps;
  Readings line_pa;
};

void add(Readings& to, double time_s, const dbc::Physical& value) {
  if (value.state == dbc::RawState::kValid) {
    to.push_back({time_s, value.value});
  }
}

/// The last reading at or before each grid point; before the first, the first.
std::vector<double> held(const Readings& readings, double begin_s, std::size_t count) {
  std::vector<double> values(count, 0.0);
  if (readings.empty()) {
    return values;
  }
  auto next = readings.begin();
  double now = next->value;
  for (std::size_t at = 0; at < count; ++at) {
    const double time_s = begin_s + kGrid_s * static_cast<double>(at) + 5e-7;
    while (next != readings.end() && next->time_s <= time_s) {
      now = (next++)->value;
    }
    values[at] = now;
  }
  return values;
}

/// On lines from reading to reading.
std::vector<double> joined(const Readings& readings, double begin_s, std::size_t count) {
  std::vector<double> values(count, 0.0);
  std::size_t next = 0;
  for (std::size_t at = 0; at < count && !readings.empty(); ++at) {
    const double time_s = begin_s + kGrid_s * static_cast<double>(at);
    while (next + 1 < readings.size() && readings[next + 1].time_s <= time_s) {
      ++next;
    }
    const Reading& before = readings[next];
    const Reading& after = readings[std::min(next + 1, readings.size() - 1)];
    const double span_s = after.time_s - before.time_s;
    const double share =
        span_s > 0.0 ? std::clamp((time_s - before.time_s) / span_s, 0.0, 1.0) : 0.0;
    values[at] = before.value + share * (after.value - before.value);
  }
  return values;
}

Readings within(const Readings& readings, double begin_s, double end_s) {
  Readings part;
  for (const Reading& reading : readings) {
    if (reading.time_s >= begin_s && reading.time_s < end_s) {
      part.push_back({reading.time_s - begin_s, reading.value});
    }
  }
  return part;
}

}  // namespace

double DozerLog::length_s() const {
  double length_s = 0.0;
  for (const DozerSegment& segment : segments) {
    length_s += kGrid_s * static_cast<double>(segment.size());
  }
  return length_s;
}

class DozerCollector::Frames {
 public:
  explicit Frames(std::string name) {
    log_.name = std::move(name);
    for (const dbc::MessageInfo& message : dozer_bus::kMessages) {
      known_.emplace(message.id, message);
    }
  }

  void take(const LoggedFrame& frame) {
    const auto known = known_.find(frame.id);
    if (!frame.extended || known == known_.end()) {
      return;
    }
    ++log_.frames;
    const dbc::MessageInfo& message = known->second;
    if (frame.length != message.length ||
        (message.is_protected && !e2e_crc_fits(frame.data, message.data_id))) {
      ++log_.refused;
      return;
    }
    decode(frame);
  }

  DozerLog log();

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", log_.name, what));
  }
  void decode(const LoggedFrame& frame);
  void decode_commands(const LoggedFrame& frame);
  void identify(const LoggedFrame& frame);
  void demand_signals() const;
  [[nodiscard]] DozerSegment segment(double begin_s, double end_s) const;

  std::unordered_map<std::uint32_t, dbc::MessageInfo> known_;
  DozerLog log_;
  std::array<BladeReadings, 2> blade_;
  std::array<TrackReadings, kTrackCount> track_;
  Readings velocity_mps_;
  Readings engine_radps_;
  std::string other_version_;
};

void DozerCollector::Frames::decode(const LoggedFrame& frame) {
  const double t = frame.time_s;
  const auto path = [&](TrackReadings& to, const auto& message) {
    add(to.pump, t, message.pump_ratio);
    add(to.motor, t, message.motor_ratio);
    add(to.line_pa, t, message.line_pressure_pa);
  };
  switch (frame.id) {
    case dozer_bus::BladeStroke::kId:
      return add(blade_[0].stroke_m, t, dozer_bus::BladeStroke::decode(frame.data).blade_stroke_m);
    case dozer_bus::TiltState::kId:
      log_.tilts = true;
      return add(blade_[1].stroke_m, t, dozer_bus::TiltState::decode(frame.data).tilt_stroke_m);
    case dozer_bus::ValveState::kId: {
      const auto message = dozer_bus::ValveState::decode(frame.data);
      add(blade_[0].spool, t, message.blade_spool_ratio);
      return add(blade_[1].spool, t, message.tilt_spool_ratio);
    }
    case dozer_bus::BodyVelocity::kId:
      return add(velocity_mps_, t, dozer_bus::BodyVelocity::decode(frame.data).forward_mps);
    case dozer_bus::LeftTransmission::kId:
      return path(track_[kLeft], dozer_bus::LeftTransmission::decode(frame.data));
    case dozer_bus::RightTransmission::kId:
      return path(track_[kRight], dozer_bus::RightTransmission::decode(frame.data));
    case dozer_bus::TrackSpeed::kId: {
      const auto message = dozer_bus::TrackSpeed::decode(frame.data);
      add(track_[kLeft].speed_mps, t, message.left_track_mps);
      return add(track_[kRight].speed_mps, t, message.right_track_mps);
    }
    case dozer_bus::EEC1::kId:
      return add(engine_radps_, t, dozer_bus::EEC1::decode(frame.data).engine_speed_radps);
    case dozer_bus::MachineIdentity::kId:
      return identify(frame);
    default:
      return decode_commands(frame);
  }
}

void DozerCollector::Frames::decode_commands(const LoggedFrame& frame) {
  const double t = frame.time_s;
  if (frame.id == dozer_bus::SpoolCommand::kId) {
    const auto message = dozer_bus::SpoolCommand::decode(frame.data);
    const bool on = message.enable.state == dbc::RawState::kValid &&
                    message.enable.value == dozer_bus::SpoolCommand::Enable::kOn;
    const dbc::Physical duty[] = {message.blade_duty_ratio, message.tilt_duty_ratio};
    for (std::size_t drive = 0; drive < blade_.size(); ++drive) {
      const bool opens = on && duty[drive].state == dbc::RawState::kValid;
      blade_[drive].duty.push_back({t, opens ? duty[drive].value : 0.0});
    }
  } else if (frame.id == dozer_bus::PumpDisplacementCommand::kId) {
    const auto message = dozer_bus::PumpDisplacementCommand::decode(frame.data);
    add(track_[kLeft].pump_sent, t, message.left_pump_ratio);
    add(track_[kRight].pump_sent, t, message.right_pump_ratio);
  } else if (frame.id == dozer_bus::MotorDisplacementCommand::kId) {
    const auto message = dozer_bus::MotorDisplacementCommand::decode(frame.data);
    add(track_[kLeft].motor_sent, t, message.left_motor_ratio);
    add(track_[kRight].motor_sent, t, message.right_motor_ratio);
  }
}

void DozerCollector::Frames::identify(const LoggedFrame& frame) {
  const auto message = dozer_bus::MachineIdentity::decode(frame.data);
  if (message.dbc_version.state == dbc::RawState::kValid &&
      message.dbc_version.value != dozer_bus::kDbcVersion && other_version_.empty()) {
    other_version_ = fmt::format("the machine speaks version {} of the dozer's DBC, {} is read",
                                 message.dbc_version.value, dozer_bus::kDbcVersion);
  }
  const std::uint32_t hash = message.profile_hash.value;
  if (log_.profile_hash != 0 && hash != log_.profile_hash) {
    refuse(fmt::format("two machines in one log: profile {:08x}, before {:08x}", hash,
                       log_.profile_hash));
  }
  log_.profile_hash = hash;
}

void DozerCollector::Frames::demand_signals() const {
  const auto demand = [this](const Readings& readings, const char* what) {
    if (readings.empty()) {
      refuse(fmt::format("{} is not in it", what));
    }
  };
  demand(blade_[0].stroke_m, "the blade's stroke");
  demand(blade_[0].duty, "SpoolCommand, what the valve was sent,");
  demand(blade_[0].spool, "the blade's spool");
  if (log_.tilts) {
    demand(blade_[1].spool, "the tilt's spool");
  }
  demand(engine_radps_, "the engine's speed");
  demand(velocity_mps_, "the body's velocity");
  for (const TrackReadings& track : track_) {
    demand(track.pump_sent, "what the pumps were sent");
    demand(track.motor_sent, "what the motors were sent");
    demand(track.pump, "a pump's displacement");
    demand(track.motor, "a motor's displacement");
    demand(track.speed_mps, "a track's speed");
  }
}

DozerSegment DozerCollector::Frames::segment(double begin_s, double end_s) const {
  DozerSegment part;
  part.begin_s = begin_s;
  const auto count = static_cast<std::size_t>((end_s - begin_s) / kGrid_s);
  for (std::size_t drive = 0; drive < blade_.size(); ++drive) {
    BladeSeries& to = part.blade[drive];
    to.duty = held(blade_[drive].duty, begin_s, count);
    to.spool = joined(blade_[drive].spool, begin_s, count);
    to.stroke_m = held(blade_[drive].stroke_m, begin_s, count);
    to.spools = within(blade_[drive].spool, begin_s, end_s);
  }
  for (std::size_t i = 0; i < kTrackCount; ++i) {
    TrackSeries& to = part.track[i];
    to.pump_sent = held(track_[i].pump_sent, begin_s, count);
    to.motor_sent = held(track_[i].motor_sent, begin_s, count);
    to.pump = held(track_[i].pump, begin_s, count);
    to.motor = held(track_[i].motor, begin_s, count);
    to.speed_mps = held(track_[i].speed_mps, begin_s, count);
    to.line_pa = held(track_[i].line_pa, begin_s, count);
  }
  part.velocity_mps = held(velocity_mps_, begin_s, count);
  part.engine_radps = held(engine_radps_, begin_s, count);
  return part;
}

DozerLog DozerCollector::Frames::log() {
  if (log_.frames == 0) {
    refuse("no frame of a dozer on our bus");
  }
  const double damaged = static_cast<double>(log_.refused) / static_cast<double>(log_.frames);
  if (damaged > kMostDamaged) {
    refuse(
        fmt::format("{:.0f} % of its frames have a wrong checksum or length; at most {:.0f} % may",
                    100.0 * damaged, 100.0 * kMostDamaged));
  }
  if (!other_version_.empty()) {
    refuse(other_version_);
  }
  demand_signals();
  const Readings& strokes = blade_[0].stroke_m;
  double begin_s = strokes.front().time_s;
  for (std::size_t at = 1; at <= strokes.size(); ++at) {
    const double last_s = strokes[at - 1].time_s;
    if (at == strokes.size() || strokes[at].time_s - last_s > kLogGap_s) {
      if (last_s - begin_s >= kShortestLog_s) {
        log_.segments.push_back(segment(begin_s, last_s));
      }
      begin_s = at < strokes.size() ? strokes[at].time_s : begin_s;
    }
  }
  if (log_.segments.empty()) {
    refuse(fmt::format("is shorter than {} s in one piece", kShortestLog_s));
  }
  return log_;
}

DozerCollector::DozerCollector(std::string name)
    : frames_(std::make_unique<Frames>(std::move(name))) {}
DozerCollector::~DozerCollector() = default;
void DozerCollector::take(const LoggedFrame& frame) { frames_->take(frame); }
DozerLog DozerCollector::log() { return frames_->log(); }

DozerLog read_dozer_log(const std::filesystem::path& file) {
  DozerCollector collector(file.filename().string());
  const LogRead read = read_candump(file, [&](const LoggedFrame& frame) { collector.take(frame); });
  DozerLog log = collector.log();
  log.sha256 = read.sha256;
  log.notes = read.notes();
  return log;
}

}  // namespace graben::identify
