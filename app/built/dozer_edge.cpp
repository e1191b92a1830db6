// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <stdexcept>

#include "app/built/machine_edge.hpp"
#include "app/ecu/dozer_kind.hpp"
#include "firmware/dozer/safety/dozer_validation.hpp"
#include "firmware/dozer/tilt.hpp"

namespace graben::built {
namespace {

class DozerEdge : public MachineEdge {
 public:
  DozerEdge(const machines::DozerMachine& machine, double width_m)
      : setup_(machine.profile),
        width_m_(width_of(machine.profile.tilt.edge_width_m, width_m, "tilt.edge_width")) {}

  void take(const CanFrame& frame, TimeUs now_us) override {
    if (frame.extended && same_message(frame.id, dbc::dozer::BodyCourse::kId)) {
      throw std::runtime_error(
          "its track curves (BodyCourse): the bus then tells stations along it and no place in "
          "plan; allowed: a dozer on a straight track");
    }
    receiver_.accept(frame, now_us);
  }

  std::optional<EdgePlace> look(TimeUs now_us) override {
    receiver_.finish(now_us);
    const DriveRows drives = setup_.bank.rows();
    constexpr bool kMoving = false;
    const DozerValid valid =
        validate(setup_.profile, drives, receiver_.inputs(), kMoving, now_us, state_);
    const bool has_tilt = setup_.profile.tilt.present;
    if (valid.faults.has(Fault::kPoseMissing) || !valid.blade().stroke_known ||
        (has_tilt && !valid.tilt().stroke_known)) {
      return std::nullopt;
    }
    const BodyPose body{{valid.position_m, 0.0, valid.height_m},
                        rotation_from_pitch_and_roll(valid.pitch_rad, valid.roll_rad)};
    const double angle_rad = setup_.blade.angle_rad(valid.blade().stroke_m);
    const double tilt_rad = has_tilt ? setup_.tilt.angle_rad(valid.tilt().stroke_m) : 0.0;
    const Eigen::Vector3d middle_m = edge_in_world_m(setup_.blade, body, angle_rad);
    const double slope = edge_slope(body.rotation, angle_rad, tilt_rad).slope;
    const Eigen::Vector3d half_m = 0.5 * width_m_ * Eigen::Vector3d(0.0, 1.0, slope).normalized();
    EdgePlace place;
    place.left_m = middle_m + half_m;
    place.right_m = middle_m - half_m;
    place.at_work = valid.velocity_mps > kAtWork_mps &&
                    setup_.blade.edge_m(angle_rad).y() < kAtWorkOverTracks_m;
    return place;
  }

  LinkCounters counters() const override { return receiver_.total(); }
  bool tells_work() const override { return true; }

 private:
  DozerSetup setup_;
  DozerReceiver receiver_;
  DozerValidationState state_;
  double width_m_;
};

}  // namespace

std::unique_ptr<MachineEdge> dozer_edge(const machines::DozerMachine& machine, double width_m) {
  return std::make_unique<DozerEdge>(machine, width_m);
}

}  // namespace graben::built
