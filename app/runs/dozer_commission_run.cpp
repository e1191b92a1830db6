// SPDX-License-Identifier: Apache-2.0
#include "app/runs/dozer_commission_run.hpp"

#include "app/runs/dozer_rig.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"

namespace graben::runs {
namespace {

namespace bus = dbc::dozer;

/// Longest that it may take, s.
constexpr double kDozerMost_s = 600.0;

/// What the station hears of machine and controller.
class DozerEar {
 public:
  explicit DozerEar(LoopbackPort& port) : port_(port) {}

  void listen() {
    plant::receive_frames(port_, [this](const CanFrame& frame) { hear(frame); });
  }

  commission::DozerSeen seen;

 private:
  static void take(double& to, const dbc::Physical& value) {
    to = value.state == dbc::RawState::kValid ? value.value : to;
  }
  void hear(const CanFrame& frame);

  LoopbackPort& port_;
};

void DozerEar::hear(const CanFrame& frame) {
  if (same_message(frame.id, bus::BladeStroke::kId)) {
    take(seen.stroke_m[0], bus::BladeStroke::decode(frame.data).blade_stroke_m);
  } else if (same_message(frame.id, bus::TiltState::kId)) {
    take(seen.stroke_m[1], bus::TiltState::decode(frame.data).tilt_stroke_m);
  } else if (same_message(frame.id, bus::BodyPosition::kId)) {
    take(seen.position_m, bus::BodyPosition::decode(frame.data).position_m);
  } else if (same_message(frame.id, bus::BodyVelocity::kId)) {
    take(seen.velocity_mps, bus::BodyVelocity::decode(frame.data).forward_mps);
  } else if (same_message(frame.id, bus::SpoolCommand::kId)) {
    const auto spools = bus::SpoolCommand::decode(frame.data);
    take(seen.sent_ratio[0], spools.blade_duty_ratio);
    take(seen.sent_ratio[1], spools.tilt_duty_ratio);
  } else if (same_message(frame.id, bus::EcuStatus::kId)) {
    seen.active = bus::EcuStatus::decode(frame.data).mode.value == bus::EcuStatus::Mode::kActive;
  }
}

identify::LoggedFrame logged_frame(const CanFrame& frame) {
  identify::LoggedFrame line;
  line.time_s = seconds(frame.stamp_us);
  line.id = frame.id;
  line.extended = frame.extended;
  line.length = frame.length;
  line.data = frame.data;
  return line;
}

plant::DozerHands confirmed(const commission::DozerOptions& options) {
  plant::DozerHands hands;
  for (std::size_t drive = 0; drive < 2; ++drive) {
    const commission::Window& window = options.blade.window[drive];
    if (options.blade.drives[drive]) {
      hands.window[drive] = StrokeWindow{window.least_m, window.most_m, window.most_mps};
    }
  }
  if (options.tracks) {
    hands.window[2] = StrokeWindow{options.way.least_m, options.way.most_m, options.way.most_mps};
  }
  return hands;
}

/// Goes on for so long as nothing ends it; true once something does.
bool ends(const DozerRig& rig, const commission::DozerSequence& sequence, TimeUs now_us,
          DozerCommissionResult& result) {
  const DozerStatus& status = rig.ecu->outputs().status;
  if (status.mode == EcuMode::kFault) {
    result.end = DozerCommissionEnd::kFault;
    result.fault = status.fault;
  } else if (sequence.wrong()) {
    result.end = DozerCommissionEnd::kWrongWay;
    result.wrong = sequence.wrong();
  } else if (seconds(now_us) > kDozerMost_s) {
    result.end = DozerCommissionEnd::kTooLong;
  }
  return result.end != DozerCommissionEnd::kDone;
}

}  // namespace

DozerCommissionResult run_dozer_commission(
    const machines::SimulatedDozer& machine, const commission::DozerOptions& options,
    const std::filesystem::path& log_file,
    const std::function<void(const identify::LoggedFrame&)>& take, const Progress& progress) {
  DozerRig rig(machine, machine.profile, {}, Task::kCommission, 1.0);
  LoopbackPort& port = rig.bus.attach();
  static_cast<void>(port.open());
  DozerEar ear(port);
  std::optional<CandumpLog> log;
  if (!log_file.empty()) {
    log.emplace(log_file, "vcan0");
  }
  rig.bus.set_tap([&](const CanFrame& frame) {
    if (log) {
      log->write(frame, frame.stamp_us);
    }
    if (take) {
      take(logged_frame(frame));
    }
  });
  commission::DozerSequence sequence(options);
  plant::DozerHands hands = confirmed(options);
  DozerCommissionResult result;
  TimeUs now_us = 0;
  for (; !sequence.is_done(); now_us += DozerRig::kPeriod_us) {
    ear.listen();
    sequence.step(seconds(now_us), ear.seen);
    hands.tried = sequence.tried();
    rig.driver.set_tries(hands);
    static_cast<void>(rig.step(now_us));
    if (ends(rig, sequence, now_us, result)) {
      break;
    }
    if (!sequence.is_done()) {
      progress(static_cast<double>(sequence.at()) / static_cast<double>(sequence.texts().size()),
               sequence.texts()[sequence.at()]);
    }
  }
  rig.release();
  for (const TimeUs end_us = now_us + 500 * kMillisecondUs; now_us < end_us;
       now_us += DozerRig::kPeriod_us) {
    static_cast<void>(rig.step(now_us));
  }
  rig.bus.set_tap(nullptr);
  if (log) {
    log->close();
  }
  result.step = sequence.at();
  result.machine_s = sequence.active_s();
  result.steps = sequence.results();
  return result;
}

}  // namespace graben::runs
