// SPDX-License-Identifier: Apache-2.0
// IMUs of the simulated machine, and what the controller makes of their frames: the strokes.

#include <algorithm>

#include "app/machines/imu_section.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/plant/excavator_node.hpp"
#include "firmware/excavator/inputs/imu_joints.hpp"
#include "firmware/numeric/constants.hpp"
#include "hal/buses/excavator_bus.hpp"
#include "tests/unit/plant/fixture/bus_rig.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

using namespace graben::plant;
using namespace graben::plant::test;

namespace bus = dbc::excavator;
using Inertial = dbc::j1939::ARI;
using Forces = dbc::j1939::ACS;

ExcavatorPlantProfile with_imus(ExcavatorPlantProfile profile) {
  machines::fit_usual_imus(profile.machine);
  return profile;
}

/// Nobody: the valve side closes.
struct NoDriver {
  explicit NoDriver(CanPort&) {}
  void step(TimeUs) {}
};

/// A machine, a hand on its valve, and the controller's way from frames to strokes.
struct ImuRig : BusRig<ExcavatorNode, NoDriver> {
  explicit ImuRig(const ExcavatorPlantProfile& of, const ExcavatorStart& start)
      : BusRig([&](CanPort& port) { return ExcavatorNode(of, start, port, kHash); }),
        profile(of.machine),
        kinematics(profile.geometry),
        receiver(BusParts{profile.has_swing(), addresses()}) {}

  [[nodiscard]] ImuAddresses addresses() const {
    ImuAddresses of{};
    for (std::size_t i = 0; i < of.size(); ++i) {
      of[i] = profile.imu.mount[i].address;
    }
    return of;
  }

  /// A cycle of the machine, then one of the controller's estimate.
  void follow(bool still) {
    cycle();
    for (auto& [id, frames] : seen) {
      for (const CanFrame& frame : frames) {
        receiver.accept(frame, now);
        last_of[id] = frame;
      }
    }
    seen.clear();
    strokes = next_imu_strokes(kinematics, profile.imu, receiver.inputs(), still, 0.01, state);
  }
  void rest(double time_s) {
    repeat(static_cast<int>(100.0 * time_s), [&] { follow(true); });
  }
  /// Drives with these duties.
  void drive(const std::array<double, kDriveCount>& duty, double time_s) {
    for (int i = 0; i < static_cast<int>(100.0 * time_s); ++i) {
      bus::SpoolCommand spool;
      spool.enable.value = bus::SpoolCommand::Enable::kOn;
      spool.boom_duty_ratio.value = duty[kBoom];
      spool.arm_duty_ratio.value = duty[kArm];
      spool.bucket_duty_ratio.value = duty[kBucket];
      bus::SwingCommand swing;
      swing.enable.value = bus::SwingCommand::Enable::kOn;
      swing.swing_duty_ratio.value = duty[kSwing];
      assert_true(our_port.send(frame_of(spool)) && our_port.send(frame_of(swing)));
      follow(false);
      worst_m = std::max(worst_m, off_m());
    }
  }
  /// Largest error of a stroke, as of its stamp, which is the machine's last cycle.
  [[nodiscard]] double off_m() const {
    double worst = 0.0;
    for (std::size_t i = 0; i < kAxisCount; ++i) {
      assert_true(strokes.stroke_m[i].validity == Validity::kValid);
      worst = std::max(worst, std::abs(strokes.stroke_m[i].value - machine.plant().strokes_m()[i]));
    }
    return worst;
  }

  ExcavatorProfile profile;
  ExcavatorKinematics kinematics;
  ExcavatorReceiver receiver;
  ImuState state;
  ImuStrokes strokes;
  std::map<std::uint32_t, CanFrame> last_of;
  double worst_m = 0.0;
};

constexpr std::array<double, 3> kStart_22t = {0.7, 0.7, 0.6};
constexpr std::array<double, 3> kStart_12t = {0.475, 0.565, 0.4375};

/// One drive after the other, then all at once.
void wave(ImuRig& rig) {
  rig.rest(2.0);
  rig.drive({0.5, 0.0, 0.0, 0.0}, 1.0);
  rig.drive({0.0, -0.5, 0.0, 0.0}, 1.0);
  rig.drive({0.0, 0.0, -0.5, 0.0}, 1.0);
  rig.drive({-0.4, 0.5, 0.5, 0.0}, 1.0);
  rig.drive({0.0, 0.0, 0.0, 0.0}, 1.0);
}

TEST(level_and_at_rest) {
  ImuRig rig(with_imus(machine_22t()), ExcavatorStart(kStart_22t));
  rig.cycles(5);
  // The boom's: its specific force is 1 g upwards, seen from a link that stands at its angle.
  const double boom_rad = rig.machine.plant().joint_angles_rad()[kBoom];
  const std::uint32_t address = rig.profile.imu.mount[kBoom].address;
  const Forces forces = Forces::decode(rig.seen.at((Forces::kId & ~0xFFU) | address).back().data);
  assert_near(forces.longitudinal_mps2.value, 9.80665 * std::sin(boom_rad), 0.006);
  assert_near(forces.vertical_mps2.value, 9.80665 * std::cos(boom_rad), 0.006);
  const Inertial rates =
      Inertial::decode(rig.seen.at((Inertial::kId & ~0xFFU) | address).back().data);
  assert_near(rates.pitch_rate_radps.value, 0.0, 1e-3);
  assert_near(rates.latency_s.value, 0.02, 0.0);
  // No stroke sensor beside them.
  assert_int_equal(rig.seen.count(bus::BoomStroke::kId), 0);
}

TEST(strokes_of_a_machine_in_motion) {
  ImuRig rig(with_imus(machine_22t()), ExcavatorStart(kStart_22t));
  wave(rig);
  print_message("22 t, exact sensors: %.2f mm\n", 1e3 * rig.worst_m);
  assert_true(rig.worst_m < 3e-3);
  assert_true(rig.worst_m > 1e-5);
}

TEST(what_is_left_of_bias_and_vibration) {
  ExcavatorPlantProfile profile = with_imus(machine_22t());
  profile.sensor_errors = true;
  profile.seed = 3;
  ImuRig rig(profile, ExcavatorStart(kStart_22t));
  wave(rig);
  print_message("22 t, 0.2 deg and vibration: %.2f mm\n", 1e3 * rig.worst_m);
  // 0.4 deg at a lever of 0.8 m are 5.6 mm.
  assert_true(rig.worst_m < 9e-3);
  for (const JointAngle& joint : rig.strokes.joints.joint) {
    assert_in_range(static_cast<int>(1e6 * joint.sd_rad), 2000, 7000);
  }
}

TEST(mounted_otherwise) {
  ExcavatorPlantProfile profile = with_imus(machine_22t());
  ImuProfile& imu = profile.machine.imu;
  imu.mount[kBoom].backwards = true;
  imu.mount[kArm].turn_rad = 0.7;
  imu.mount[kArm].at_m = {0.5, 0.3};
  imu.mount[kBucket].on_rocker = true;
  imu.mount[kBucket].at_m = {0.2, 0.05};
  imu.mount[kBodyImu].address = 0xF0;
  imu.mount[kBodyImu].backwards = true;
  imu.mount[kBodyImu].turn_rad = -0.1;
  ImuRig rig(profile, ExcavatorStart(kStart_22t));
  wave(rig);
  print_message("22 t, rocker: %.2f mm\n", 1e3 * rig.worst_m);
  assert_true(rig.worst_m < 4e-3);
}

TEST(swing_is_taken_out) {
  ImuRig rig(with_imus(machine_12t()), ExcavatorStart(kStart_12t));
  rig.rest(2.0);
  rig.drive({0.0, 0.0, 0.0, 0.8}, 5.0);
  assert_true(std::abs(rig.machine.plant().swing_rate_radps()) > 0.5);
  print_message("12 t, swinging: %.2f mm\n", 1e3 * rig.worst_m);
  assert_true(rig.worst_m < 3e-3);
}

TEST(silence_ages_and_error_shows) {
  ImuRig rig(with_imus(machine_22t()), ExcavatorStart(kStart_22t));
  rig.rest(1.0);
  const TimeUs before = rig.strokes.stroke_m[kBoom].stamp_us;
  const std::uint32_t id = (Inertial::kId & ~0xFFU) | rig.profile.imu.mount[kArm].address;
  rig.machine.faults().frames.set_silent(id, true);
  rig.rest(0.1);
  // Every stroke is as old as the worst of the IMUs.
  assert_int_equal(rig.strokes.stroke_m[kBoom].stamp_us, before);
  rig.machine.faults().frames.set_silent(id, false);
  rig.rest(1.0);
  assert_true(rig.off_m() < 3e-3);
}

/// A message of the boom's IMU goes on as it was while the boom moves; until it is told.
template <class Message>
void freeze(bool noisy) {
  ExcavatorPlantProfile profile = with_imus(machine_22t());
  profile.sensor_errors = noisy;
  ImuRig rig(profile, ExcavatorStart(kStart_22t));
  rig.rest(2.0);
  const std::uint32_t id = (Message::kId & ~0xFFU) | rig.profile.imu.mount[kBoom].address;
  const CanFrame frozen = rig.last_of.at(id);
  rig.machine.faults().frames.set_silent(id, true);
  int cycles = 0;
  while (rig.strokes.stroke_m[kBoom].validity == Validity::kValid && cycles < 500) {
    bus::SpoolCommand spool;
    spool.enable.value = bus::SpoolCommand::Enable::kOn;
    spool.boom_duty_ratio.value = 0.5;
    assert_true(rig.our_port.send(rig.frame_of(spool)));
    rig.receiver.accept(frozen, rig.now + kCycleUs);
    rig.follow(false);
    ++cycles;
  }
  print_message("frozen: told after %d cycles\n", cycles);
  assert_true(rig.strokes.stroke_m[kBoom].validity == Validity::kError);
  assert_in_range(cycles, 10, 100);
}

TEST(a_frozen_sensor_is_told) {
  freeze<Forces>(false);
  freeze<Forces>(true);
  freeze<Inertial>(true);
}

TEST(unknown_until_it_is_known) {
  ExcavatorPlantProfile profile = with_imus(machine_22t());
  profile.sensor_errors = true;
  ImuRig rig(profile, ExcavatorStart(kStart_22t));
  rig.follow(true);
  assert_true(rig.strokes.stroke_m[kBoom].validity == Validity::kNotAvailable);
  int cycles = 1;
  while (rig.strokes.stroke_m[kBoom].validity != Validity::kValid && cycles < 300) {
    rig.follow(true);
    ++cycles;
  }
  assert_in_range(cycles, 5, 100);
}
