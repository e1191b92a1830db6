// SPDX-License-Identifier: Apache-2.0
#include "app/runs/commission_run.hpp"

#include "app/runs/excavator_rig.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::runs {
namespace {

namespace bus = dbc::excavator;

/// What the station hears of machine and controller.
class Ear {
 public:
  explicit Ear(LoopbackPort& port) : port_(port) {}

  void listen() {
    plant::receive_frames(port_, [this](const CanFrame& frame) {
      const auto take = [this](std::size_t axis, const dbc::Physical& stroke) {
        if (stroke.state == dbc::RawState::kValid) {
          strokes_m[axis] = stroke.value;
        }
      };
      if (same_message(frame.id, bus::BoomStroke::kId)) {
        take(0, bus::BoomStroke::decode(frame.data).boom_stroke_m);
      } else if (same_message(frame.id, bus::ArmStroke::kId)) {
        take(1, bus::ArmStroke::decode(frame.data).arm_stroke_m);
      } else if (same_message(frame.id, bus::BucketStroke::kId)) {
        take(2, bus::BucketStroke::decode(frame.data).bucket_stroke_m);
      } else if (same_message(frame.id, bus::SpoolCommand::kId)) {
        const auto spools = bus::SpoolCommand::decode(frame.data);
        sent_ratio = {spools.boom_duty_ratio.value, spools.arm_duty_ratio.value,
                      spools.bucket_duty_ratio.value};
      } else if (same_message(frame.id, bus::SwingState::kId)) {
        const auto angle = bus::SwingState::decode(frame.data).swing_angle_rad;
        swing_rad = angle.state == dbc::RawState::kValid ? angle.value : swing_rad;
      } else if (same_message(frame.id, bus::SwingCommand::kId)) {
        swing_sent_ratio = bus::SwingCommand::decode(frame.data).swing_duty_ratio.value;
      } else if (same_message(frame.id, bus::EcuStatus::kId)) {
        mode = bus::EcuStatus::decode(frame.data).mode.value;
      }
    });
  }

  std::array<double, kAxisCount> strokes_m{};
  std::array<double, kAxisCount> sent_ratio{};
  double swing_rad = 0.0;
  double swing_sent_ratio = 0.0;
  bus::EcuStatus::Mode mode = bus::EcuStatus::Mode::kSilent;

 private:
  LoopbackPort& port_;
};

}  // namespace

identify::LoggedFrame logged_frame(const CanFrame& frame) {
  identify::LoggedFrame line;
  line.time_s = seconds(frame.stamp_us);
  line.id = frame.id;
  line.extended = frame.extended;
  line.length = frame.length;
  line.data = frame.data;
  return line;
}

CommissionOptions usual_commission(const machines::SimulatedExcavator& machine) {
  CommissionOptions options;
  options.sequence = commission::whole_sequence(machine.profile);
  for (unsigned k = 0; k < kAxisCount; ++k) {
    options.start_strokes_m[k] = 0.5 * machine.profile.geometry.cylinder[k].stroke_m;
  }
  return options;
}

CommissionResult run_commission(const machines::SimulatedExcavator& machine,
                                const CommissionOptions& options, const TakeFrame& take,
                                const Progress& progress) {
  ExcavatorRig rig(machine, machine.profile, start_at(options.start_strokes_m), Task::kCommission,
                   1.0);
  LoopbackPort& port = rig.bus.attach();
  static_cast<void>(port.open());
  Ear ear(port);
  commission::CommissionSequence sequence(options.sequence);
  plant::OperatorHands hands;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const commission::Window& window = options.sequence.window[axis];
    if (options.sequence.drives[axis]) {
      hands.window[axis] = StrokeWindow{window.least_m, window.most_m, window.most_mps};
    }
  }
  const auto try_next = [&](TimeUs now_us) {
    ear.listen();
    sequence.step(seconds(now_us),
                  {ear.strokes_m, ear.sent_ratio, ear.mode == bus::EcuStatus::Mode::kActive,
                   ear.swing_rad, ear.swing_sent_ratio});
    hands.tried_ratio = sequence.duty();
    hands.lever_ratio[kSwing] = sequence.swing_duty();
    rig.driver.set_hands(hands);
  };
  const auto words = [&sequence](std::size_t at) { return step_text(sequence.steps()[at]); };
  return lead_commission(rig, sequence, options.log_file, take, try_next, sequence.steps().size(),
                         words, progress);
}

}  // namespace graben::runs
