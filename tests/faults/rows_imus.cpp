// SPDX-License-Identifier: Apache-2.0
// Rows 76 and 90: IMUs on the links in the place of stroke sensors, silent or wrong.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "can_dbc/generated/j1939_dbc.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "tests/faults/row.hpp"

namespace graben::faults {
namespace {

using Rates = dbc::j1939::ARI;
using Forces = dbc::j1939::ACS;

/// The true tip may come no further from the path than this more than it would anyway.
constexpr double kFurtherMost_m = 0.15;
constexpr TimeUs kLookedAt_us = 10 * kSecondUs;

enum class ImuFault {
  kSilent,
  kDegraded,
  kFrozen,
  kTwoSenders,
  kTilted,     ///< By 20 deg, as of a bracket that was hit.
  kOffset,     ///< 0.35 g of one axis.
  kOtherSign,  ///< Of the gyro.
  kShaken,     ///< Vibration beyond what the sensor can take: 17 deg/s and 1.5 g.
};
constexpr unsigned kFaults = 8;

constexpr double kTilt_rad = 0.35;

/// At most, from the first wrong frame; 0: what does no harm may go on.
TimeUs seen_within_us(ImuFault fault) {
  switch (fault) {
    case ImuFault::kSilent:
      return 60 * kMillisecondUs;
    case ImuFault::kDegraded:
      return 20 * kMillisecondUs;
    case ImuFault::kFrozen:
      return 2 * kSecondUs;
    case ImuFault::kTwoSenders:
      return 120 * kMillisecondUs;
    case ImuFault::kTilted:
      return kSecondUs;
    case ImuFault::kOffset:
    case ImuFault::kOtherSign:
    case ImuFault::kShaken:
      break;
  }
  return 0;
}

/// As Trial::work(), with the time that IMUs need to learn their biases.
void dig_by_imus(Trial<Excavator>& trial) {
  trial.set_up(Excavator::imu_scenery_of(trial.seed()));
  auto& rig = *trial.rig;
  rig.run(runs::kImusLearn_us);
  rig.ask(true, Task::kNone);
  rig.run(100 * kMillisecondUs);
  rig.ask(true, Task::kDig);
  trial.check(rig.run_until(kSecondUs, [&] { return rig.mode() == EcuMode::kActive; }),
              "the task does not begin");
  rig.run(trial.any_time(Excavator::kFirstInjection_us, Excavator::kLastInjection_us));
}

/// What becomes of the frames of one IMU.
struct Spoiler {
  ImuFault fault;
  std::uint8_t address;
  bool of_rates;  ///< Where one message is wrong, which.
  std::optional<CanFrame> kept;
  plant::Random* random;

  [[nodiscard]] bool is(const CanFrame& frame, std::uint32_t message) const {
    return frame.id == ((message & ~0xFFU) | address);
  }

  /// False: the frame is lost.
  bool spoil(CanFrame& frame) {
    const bool rates = is(frame, Rates::kId);
    if (!rates && !is(frame, Forces::kId)) {
      return true;
    }
    if (fault == ImuFault::kSilent) {
      return rates != of_rates;
    }
    if (fault == ImuFault::kFrozen && rates == of_rates) {
      kept = kept ? kept : std::optional<CanFrame>(frame);
      frame.data = kept->data;
    }
    if (rates) {
      spoil_rates(frame);
    } else {
      spoil_forces(frame);
    }
    return true;
  }

 private:
  void spoil_rates(CanFrame& frame) const {
    Rates message = Rates::decode(frame.data);
    if (fault == ImuFault::kOtherSign) {
      message.pitch_rate_radps.value *= -1.0;
    } else if (fault == ImuFault::kShaken) {
      message.pitch_rate_radps.value += 0.3 * random->normal();
    } else {
      return;
    }
    frame.data = message.encode();
  }

  void spoil_forces(CanFrame& frame) const {
    Forces message = Forces::decode(frame.data);
    if (fault == ImuFault::kDegraded) {
      message.vertical_merit = {Forces::VerticalMerit::kDegraded, dbc::RawState::kValid};
    } else if (fault == ImuFault::kTilted) {
      const double along = message.longitudinal_mps2.value;
      const double up = message.vertical_mps2.value;
      message.longitudinal_mps2.value = along * std::cos(kTilt_rad) + up * std::sin(kTilt_rad);
      message.vertical_mps2.value = up * std::cos(kTilt_rad) - along * std::sin(kTilt_rad);
    } else if (fault == ImuFault::kOffset) {
      message.longitudinal_mps2.value += 3.4;
    } else if (fault == ImuFault::kShaken) {
      message.longitudinal_mps2.value += 15.0 * random->normal();
      message.vertical_mps2.value += 15.0 * random->normal();
    } else {
      return;
    }
    frame.data = message.encode();
  }
};

double tip_off_path_m(const Rig<Excavator>& rig) {
  const RoundedRectangle path(rig.machine.profile.dig_path);
  const Eigen::Vector2d tip_m = rig.plant.plant().tip().position_m;
  return (path.closest(tip_m).position_m - tip_m).norm();
}

CanFrame of_another_sender(std::uint8_t address) {
  CanFrame frame;
  frame.id = (Rates::kId & ~0xFFU) | address;
  frame.extended = true;
  frame.length = Rates::kLength;
  Rates message;
  message.pitch_rate_radps = {0.0, dbc::RawState::kValid};
  message.roll_rate_radps = {0.0, dbc::RawState::kValid};
  message.yaw_rate_radps = {0.0, dbc::RawState::kValid};
  frame.data = message.encode();
  return frame;
}

void imu_wrong(Trial<Excavator>& trial) {
  dig_by_imus(trial);
  auto& rig = *trial.rig;
  const auto fault = static_cast<ImuFault>(trial.seed() % kFaults);
  const std::uint8_t address = rig.machine.profile.imu.mount[trial.any_of(kAxisCount)].address;
  Spoiler spoiler{fault, address, trial.odd(), std::nullopt, &trial.random};
  const double before_m = tip_off_path_m(rig);
  const TimeUs since_us = rig.at_us();
  rig.tamper = [&](CanFrame& frame, const LoopbackPort*) { return spoiler.spoil(frame); };
  if (fault == ImuFault::kTwoSenders) {
    rig.before_all = [&] { static_cast<void>(rig.other_port.send(of_another_sender(address))); };
  }
  double most_m = 0.0;
  const bool seen = rig.run_until(kLookedAt_us, [&] {
    most_m = std::max(most_m, tip_off_path_m(rig) - before_m);
    return rig.mode() != EcuMode::kActive;
  });
  rig.tamper = nullptr;
  rig.before_all = nullptr;
  const TimeUs took_us = rig.at_us() - since_us;
  const TimeUs most_us = seen_within_us(fault);
  if (seen) {
    trial.outcome.codes.add(rig.outputs().status.fault);
    trial.outcome.to_detection_us = took_us;
    trial.check(!rig.outputs().enable, "not neutral in that cycle");
  }
  trial.check(most_us == 0 || (seen && took_us <= most_us),
              "not seen within " + std::to_string(most_us / kMillisecondUs) + " ms but after " +
                  std::to_string(took_us / kMillisecondUs));
  trial.outcome.harm = most_m;
  trial.outcome.harm_unit = "m";
  trial.check(most_m <= kFurtherMost_m,
              "the true tip is " + std::to_string(1e3 * most_m) + " mm further off the path");
  trial.saw(seen ? "N L" : "no harm");
}

/// A gyro that is off by so much from now on.
constexpr double kGyroOff_radps = 0.07;
constexpr double kGyroHarmMost_m = 0.15;
/// Of the bucket's, which is too near to its pin for its force to tell of its gyro at once, and the
/// arm's, whose force may be shaken too much for that.
constexpr double kNearGyroHarmMost_m = 0.25;

/// Who lets go and asks anew while the gyro still is off moves nothing.
void check_not_armed_again(Trial<Excavator>& trial) {
  auto& rig = *trial.rig;
  using Wish = std::pair<bool, Task>;
  for (const auto& [enable, task] :
       {Wish{false, Task::kNone}, Wish{true, Task::kNone}, Wish{true, Excavator::kTask}}) {
    rig.ask(enable, task);
    const bool again = rig.run_until(kSecondUs, [&] { return in_motion(rig.mode()); });
    trial.check(!again, "moved again by a gyro that is off");
  }
}

void gyro_jumps(Trial<Excavator>& trial) {
  dig_by_imus(trial);
  auto& rig = *trial.rig;
  const unsigned axis = trial.any_of(kAxisCount);
  const std::uint32_t id = (Rates::kId & ~0xFFU) | rig.machine.profile.imu.mount[axis].address;
  const double off_radps = trial.odd() ? kGyroOff_radps : -kGyroOff_radps;
  const double before_m = tip_off_path_m(rig);
  const TimeUs since_us = rig.at_us();
  rig.tamper = [id, off_radps](CanFrame& frame, const LoopbackPort*) {
    if (frame.id == id) {
      Rates message = Rates::decode(frame.data);
      message.pitch_rate_radps.value += off_radps;
      frame.data = message.encode();
    }
    return true;
  };
  double most_m = 0.0;
  const bool seen = rig.run_until(kLookedAt_us, [&] {
    most_m = std::max(most_m, tip_off_path_m(rig) - before_m);
    return rig.mode() != EcuMode::kActive;
  });
  trial.check(seen, "not seen");
  trial.outcome.codes.add(rig.outputs().status.fault);
  trial.outcome.to_detection_us = rig.at_us() - since_us;
  trial.check(!rig.outputs().enable, "not neutral in that cycle");
  check_not_armed_again(trial);
  rig.tamper = nullptr;
  trial.outcome.harm = most_m;
  trial.outcome.harm_unit = "m";
  trial.check(most_m <= (axis == kBoom ? kGyroHarmMost_m : kNearGyroHarmMost_m),
              "the true tip is " + std::to_string(1e3 * most_m) + " mm further off the path");
  trial.saw("N L");
}

}  // namespace

Rows<Excavator> imu_rows() {
  return {{76, "IMU silent, degraded, frozen, doubled, tilted, offset, other sign, shaken",
           "N L | no harm", imu_wrong},
          {90, "a gyro jumps by 4 deg/s", "N L", gyro_jumps}};
}

}  // namespace graben::faults
