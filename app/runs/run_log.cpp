// SPDX-License-Identifier: Apache-2.0
#include "app/runs/run_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/identify/machine/log_version.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/buses/common_messages.hpp"

namespace graben::runs {
namespace {

using dbc::Physical;
using dbc::RawState;
using Status = dbc::common::EcuStatus;

constexpr double kOld_s = 0.2;

/// Puts frames into the channels of their signals.
class Reader {
 public:
  explicit Reader(RunLog& run) : run_(run) {}

  void take(const identify::LoggedFrame& frame) {
    if (frames_++ == 0) {
      run_.from_s = frame.time_s;
    }
    run_.until_s = frame.time_s;
    if (!frame.extended || frame.length != 8) {
      return;
    }
    if (!is_kind_known_) {
      find_kind(frame.id);
    }
    if (frame.id == dbc::common::EcuIdentity::kId) {
      const auto identity = dbc::common::EcuIdentity::decode(frame.data);
      run_.profile_hash =
          identity.profile_hash.state == RawState::kValid ? identity.profile_hash.value : 0;
    }
    if (frame.id == dbc::common::OperatorCommand::kId) {
      const auto task = dbc::common::OperatorCommand::decode(frame.data).task;
      // None is asked for at the end, while the machine still comes to rest.
      if (is_active_ && task.state == RawState::kValid &&
          task.value != dbc::common::OperatorCommand::Task::kNone) {
        run_.task = static_cast<std::uint8_t>(task.value);
      }
    }
    if (is_kind_known_) {
      if (frame.id == Status::kId) {
        status(frame);
      }
      run_.is_dozer ? dozer(frame) : excavator(frame);
    }
  }

  void finish() {
    if (run_.status_s.empty()) {
      throw std::runtime_error(
          run_.name + ": has no word of a controller (EcuStatus) of an excavator or dozer");
    }
    if (!is_started_) {
      run_.start_s = run_.from_s;
    }
    run_.limit_share = limits().shares();
  }

 private:
  /// By the machine's frames or the controller's: with IMUs or on another bus no stroke is told.
  void find_kind(std::uint32_t id) {
    run_.is_dozer = id == dbc::dozer::BladeStroke::kId || id == dbc::dozer::EcuGrade::kId;
    is_kind_known_ = run_.is_dozer || id == dbc::excavator::BoomStroke::kId ||
                     id == dbc::excavator::EcuHydraulics::kId;
    if (is_kind_known_) {
      run_.channel.assign(channel_table(run_.is_dozer).size(), {});
    }
  }

  LimitCount& limits() {
    if (!limits_) {
      limits_.emplace(run_.is_dozer ? dozer_actuators() : excavator_actuators());
    }
    return *limits_;
  }

  void put(std::size_t channel, const identify::LoggedFrame& frame, const Physical& signal) {
    if (signal.state == RawState::kValid) {
      run_.channel[channel].time_s.push_back(frame.time_s);
      run_.channel[channel].value.push_back(signal.value);
    }
  }

  void status(const identify::LoggedFrame& frame) {
    const Status status = Status::decode(frame.data);
    const bool is_active = status.mode.value == Status::Mode::kActive;
    // The first frame of a piece stands for as long as the last one of the piece before.
    const double passed_s =
        run_.status_s.empty()
            ? 0.0
            : identify::LogClock::counted_s(run_.status_s.back(), frame.time_s, status_period_s_);
    status_period_s_ = passed_s;
    put(0, frame, status.lambda);
    is_active_ = is_active;
    if (is_active) {
      if (!is_started_) {
        is_started_ = true;
        run_.start_s = frame.time_s;
      }
      run_.active_s += passed_s;
      limits().add({static_cast<LimitKind>(status.limit_kind.value),
                    static_cast<std::uint8_t>(status.limit_index.value)},
                   passed_s);
    }
    // What a controller waits for before it is ready is no fault.
    is_ready_ = is_ready_ || status.mode.value != Status::Mode::kSilent;
    const auto fault = static_cast<Fault>(status.fault.value);
    if (is_ready_ && fault != Fault::kNone && !run_.first_fault_s) {
      run_.first_fault_s = frame.time_s;
      run_.first_fault = fault;
    }
    run_.status_s.push_back(frame.time_s);
  }

  void excavator(const identify::LoggedFrame& frame) {
    namespace bus = dbc::excavator;
    switch (frame.id) {
      case bus::EcuHydraulics::kId:
        return put(1, frame, bus::EcuHydraulics::decode(frame.data).path_error_m);
      case bus::ValveState::kId: {
        const auto valve = bus::ValveState::decode(frame.data);
        put(2, frame, valve.boom_spool_ratio);
        put(3, frame, valve.arm_spool_ratio);
        return put(4, frame, valve.bucket_spool_ratio);
      }
      case bus::BoomStroke::kId:
        return put(5, frame, bus::BoomStroke::decode(frame.data).boom_stroke_m);
      case bus::ArmStroke::kId:
        return put(6, frame, bus::ArmStroke::decode(frame.data).arm_stroke_m);
      case bus::BucketStroke::kId:
        return put(7, frame, bus::BucketStroke::decode(frame.data).bucket_stroke_m);
      case bus::TaskStatus::kId:
        return step(bus::TaskStatus::decode(frame.data), frame.time_s);
      default:
        return;
    }
  }

  void step(const dbc::excavator::TaskStatus& status, double time_s) {
    if (!is_active_ || status.task_number.state != RawState::kValid ||
        status.step.state != RawState::kValid || status.step_kind.state != RawState::kValid) {
      return;
    }
    const RunStep now{static_cast<std::uint8_t>(status.step.value),
                      static_cast<std::uint8_t>(status.step_kind.value), time_s};
    run_.task_number = static_cast<std::uint8_t>(status.task_number.value);
    if (run_.step.empty() || run_.step.back().number != now.number ||
        run_.step.back().kind != now.kind) {
      run_.step.push_back(now);
    }
  }

  void dozer(const identify::LoggedFrame& frame) {
    namespace bus = dbc::dozer;
    switch (frame.id) {
      case bus::EcuGrade::kId:
        return put(1, frame, bus::EcuGrade::decode(frame.data).grade_error_m);
      case bus::ValveState::kId:
        return put(2, frame, bus::ValveState::decode(frame.data).blade_spool_ratio);
      case bus::BladeStroke::kId:
        return put(3, frame, bus::BladeStroke::decode(frame.data).blade_stroke_m);
      default:
        return;
    }
  }

  RunLog& run_;
  std::optional<LimitCount> limits_;
  std::size_t frames_ = 0;
  bool is_kind_known_ = false;
  bool is_started_ = false;
  bool is_active_ = false;
  double status_period_s_ = 0.0;  ///< From one EcuStatus to the next.
  bool is_ready_ = false;
};

}  // namespace

double Channel::at(double when_s) const {
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), when_s);
  if (after == time_s.begin()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto index = static_cast<std::size_t>(after - time_s.begin()) - 1;
  return when_s - time_s[index] > kOld_s ? std::numeric_limits<double>::quiet_NaN() : value[index];
}

const std::vector<ChannelInfo>& channel_table(bool is_dozer) {
  static const std::vector<ChannelInfo> excavator = {
      {"lambda", "Lambda", "lambda", "", 1.0, 3, true},
      {"error", "Path error", "Path error", "mm", 1e3, 1, true},
      {"spools", "Spools", "Boom", "per mille", 1e3, 0, true},
      {"spools", "Spools", "Arm", "per mille", 1e3, 0, true},
      {"spools", "Spools", "Bucket", "per mille", 1e3, 0, true},
      {"strokes", "Strokes", "Boom", "mm", 1e3, 1, false},
      {"strokes", "Strokes", "Arm", "mm", 1e3, 1, false},
      {"strokes", "Strokes", "Bucket", "mm", 1e3, 1, false}};
  static const std::vector<ChannelInfo> dozer = {
      {"lambda", "Lambda", "lambda", "", 1.0, 3, true},
      {"error", "Grade error", "Grade error", "mm", 1e3, 1, true},
      {"spools", "Blade spool", "Blade", "per mille", 1e3, 0, true},
      {"strokes", "Blade stroke", "Blade", "mm", 1e3, 1, false}};
  return is_dozer ? dozer : excavator;
}

RunLog read_run_log(const std::filesystem::path& file) {
  RunLog run;
  run.name = file.string();
  Reader reader(run);
  run.read = identify::read_versioned(
      file, [&reader](const identify::LoggedFrame& frame) { reader.take(frame); });
  reader.finish();
  return run;
}

LimitShares logged_limit_shares(const std::filesystem::path& file) {
  return std::filesystem::is_regular_file(file) ? read_run_log(file).limit_share : LimitShares{};
}

}  // namespace graben::runs
