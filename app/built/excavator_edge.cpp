// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "app/built/machine_edge.hpp"
#include "app/ecu/excavator_kind.hpp"
#include "firmware/excavator/fences/machine_points.hpp"
#include "firmware/excavator/inputs/imu_joints.hpp"
#include "firmware/excavator/inputs/measured_joints.hpp"
#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/excavator/swing.hpp"

namespace graben::built {
namespace {

namespace bus = dbc::excavator;

/// With a width that may be told beside the profile.
ExcavatorProfile profile_of(const machines::ExcavatorMachine& machine, double width_m) {
  ExcavatorProfile profile = machine.profile;
  double& its_m = profile.geometry.body.bucket_width_m;
  its_m = width_of(its_m, width_m, "bucket.width");
  return profile;
}

class ExcavatorEdge : public MachineEdge {
 public:
  ExcavatorEdge(const machines::ExcavatorMachine& machine, double width_m)
      : setup_(profile_of(machine, width_m)), receiver_(parts_of(setup_, machine.bus)) {}

  void take(const CanFrame& frame, TimeUs now_us) override {
    if (frame.extended && frame.length == bus::EcuTipLoad::kLength &&
        same_message(frame.id, bus::EcuTipLoad::kId)) {
      take_force(bus::EcuTipLoad::decode(frame.data), now_us);
    }
    receiver_.accept(frame, now_us);
  }

  std::optional<EdgePlace> look(TimeUs now_us) override {
    receiver_.finish(now_us);
    const ExcavatorProfile& profile = setup_.profile;
    const ExcavatorInputs& inputs = receiver_.inputs();
    const DriveRows drives = setup_.bank.rows();
    // As at rest: what moves the machine by hand is believed too.
    constexpr bool kMoving = false;
    const ExcavatorValid valid =
        by_angles() ? validate(profile, drives, inputs, kMoving, now_us, accepted_, strokes(inputs))
                    : validate(profile, drives, inputs, kMoving, now_us, accepted_);
    const auto known = [](const ValidDrive& drive) { return drive.stroke_known; };
    if (!std::all_of(valid.drive.begin(), valid.drive.begin() + drives.count(), known)) {
      return std::nullopt;
    }
    const MachineMotion motion = machine_motion(
        setup_.kinematics, drives_of(profile, valid.strokes_m()), DriveVector::Zero());
    if (motion.status != ReachStatus::kOk) {
      return std::nullopt;
    }
    EdgePlace place;
    place.left_m = motion.at(MachinePoint::kEdgeLeft).position_m;
    place.right_m = motion.at(MachinePoint::kEdgeRight).position_m;
    place.outwards_m = motion.at(MachinePoint::kTeeth).position_m.head<2>().norm();
    if (tells_force_ && static_cast<double>(now_us - force_us_) < 1e6 * kForceOld_s) {
      place.level_n = level_n_;
      place.deviation_n = deviation_n_;
    }
    return place;
  }

  LinkCounters counters() const override { return receiver_.total(); }
  bool tells_work() const override { return tells_force_; }

 private:
  static BusParts parts_of(const ExcavatorSetup& setup, const BusTable& table) {
    return with_table(ecu::ExcavatorKind::parts(setup), &table);
  }
  [[nodiscard]] bool by_angles() const {
    return setup_.profile.imu.known() || setup_.profile.bus.joint_angles;
  }

  /// By whatever the machine measures: IMUs, or angles of its joints.
  const std::array<Signal<double>, kAxisCount>& strokes(const ExcavatorInputs& inputs) {
    const ExcavatorKinematics& kinematics = setup_.kinematics.planar();
    if (setup_.profile.imu.known()) {
      constexpr double kPeriod_s = 1e-6 * static_cast<double>(kPeriod_us);
      strokes_m_ = next_imu_strokes(kinematics, setup_.profile.imu, inputs, is_still(inputs),
                                    kPeriod_s, imus_)
                       .stroke_m;
    } else {
      strokes_m_ = strokes_of_joints(kinematics, inputs.joint_rad);
    }
    return strokes_m_;
  }

  /// All spools are measured, and closed.
  [[nodiscard]] bool is_still(const ExcavatorInputs& inputs) const {
    const double most = setup_.profile.safety.spool_tolerance;
    return std::all_of(inputs.axis.begin(), inputs.axis.end(), [most](const AxisInputs& axis) {
      return axis.spool_ratio.validity == Validity::kValid &&
             std::abs(axis.spool_ratio.value) <= most;
    });
  }

  void take_force(const bus::EcuTipLoad& load, TimeUs now_us) {
    const auto valid = [](const dbc::Physical& signal) {
      return signal.state == dbc::RawState::kValid;
    };
    if (valid(load.tip_force_outwards_n) && valid(load.tip_force_deviation_n)) {
      tells_force_ = true;
      force_us_ = now_us;
      level_n_ = load.tip_force_outwards_n.value;
      deviation_n_ = load.tip_force_deviation_n.value;
    }
  }

  ExcavatorSetup setup_;
  ExcavatorReceiver receiver_;
  std::array<AcceptedStroke, kDriveCount> accepted_;
  ImuState imus_;
  std::array<Signal<double>, kAxisCount> strokes_m_{};
  bool tells_force_ = false;
  double level_n_ = 0.0;
  double deviation_n_ = 0.0;
  TimeUs force_us_ = 0;
};

}  // namespace

std::unique_ptr<MachineEdge> excavator_edge(const machines::ExcavatorMachine& machine,
                                            double width_m) {
  return std::make_unique<ExcavatorEdge>(machine, width_m);
}

}  // namespace graben::built
