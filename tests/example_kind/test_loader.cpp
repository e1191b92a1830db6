// SPDX-License-Identifier: Apache-2.0
// A machine kind by the recipe: it cuts at the pump's limit, keeps its path, and faults stop it.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "app/runs/frame_edit.hpp"
#include "app/runs/loopback_rig.hpp"
#include "tests/example_kind/loader_kind.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using Rig = runs::LoopbackRig<LoaderKind>;
using Bus = LoaderKind::Dbc;

struct Run {
  Rig rig{{}, LoaderSetup{}, {0.175, 0.181}, Task::kDig, 1.0};
  TimeUs now = 0;

  void until(
      TimeUs end, const std::function<void()>& look = [] {}) {
    for (; now < end; now += Rig::kPeriod_us) {
      rig.step(now);
      look();
    }
  }
  [[nodiscard]] const MachineStatus& status() const { return rig.ecu->outputs().status; }
  [[nodiscard]] bool neutral() const {
    return !rig.ecu->outputs().enable && rig.ecu->outputs().duty_ratio == std::array{0.0, 0.0};
  }
};

/// Where the bucket's edge is.
Eigen::Vector2d edge_m(const LoaderProfile& profile, const plant::LoaderPlant& plant) {
  const auto angle_rad = [&](unsigned i) {
    return CylinderTriangle(profile.parent_pin_m[i], profile.child_pin_m[i], -1)
        .angle(profile.closed_length_m[i] + plant.side(i).stroke_m);
  };
  const Eigen::Rotation2Dd arm(angle_rad(kLift)), bucket(angle_rad(kTilt));
  return arm *
         (Eigen::Vector2d(profile.arm_m, 0.0) + bucket * Eigen::Vector2d(0.0, -profile.bucket_m));
}

TEST(cuts_at_the_pumps_limit) {
  Run run;
  const LoaderProfile profile;
  const Eigen::Vector2d along = (profile.cut_to_m - profile.cut_from_m).normalized();
  double worst_m = 0.0, left_m = 1.0, lambda = 0.0;
  int cycles = 0, flow = 0;
  run.until(10 * kSecondUs, [&] {
    const Eigen::Vector2d to_go_m = profile.cut_to_m - edge_m(profile, run.rig.plant.plant());
    left_m = to_go_m.norm();
    worst_m = std::max(worst_m, std::abs(along.x() * to_go_m.y() - along.y() * to_go_m.x()));
    if (run.now >= Rig::kTask_us && along.dot(to_go_m) > 0.3) {
      ++cycles;
      lambda += run.status().lambda;
      flow += run.status().lambda < 1.0 && run.status().limit.kind == LimitKind::kPumpFlow ? 1 : 0;
    }
  });
  print_message("%d cycles, lambda %.2f, by the flow %.2f; path error %.1f mm, left %.1f mm\n",
                cycles, lambda / cycles, 1.0 * flow / cycles, 1e3 * worst_m, 1e3 * left_m);
  assert_true(flow > cycles / 2);
  assert_true(lambda / cycles < 0.9);
  assert_true(worst_m < 0.03 && left_m < 0.01);
}

void stops(Fault fault, const std::function<void(Rig&)>& strike,
           const std::function<void(Rig&)>& cure) {
  constexpr TimeUs kStrike = kSecondUs;
  Run run;
  run.until(kStrike);
  assert_int_equal(run.status().mode, EcuMode::kActive);
  strike(run.rig);
  TimeUs stopped = 0;
  run.until(kStrike + 1500 * kMillisecondUs,
            [&] { stopped = stopped == 0 && run.neutral() ? run.now : stopped; });
  print_message("fault %d after %d ms\n", static_cast<int>(fault),
                static_cast<int>((stopped - kStrike) / kMillisecondUs));
  assert_in_range(stopped, kStrike, kStrike + 100 * kMillisecondUs);
  assert_int_equal(run.status().fault, fault);
  assert_true(run.rig.ecu->outputs().pilot_cut);
  assert_near(run.rig.plant.plant().side(kLift).velocity_mps, 0.0, 0.005);
  assert_near(run.rig.plant.plant().side(kTilt).velocity_mps, 0.0, 0.005);
  // Cured, it stays until the operator lets go and enables again.
  cure(run.rig);
  run.until(run.now + 2 * kSecondUs, [&] { assert_true(run.neutral()); });
  assert_int_equal(run.status().mode, EcuMode::kFault);
  assert_int_equal(run.status().fault, fault);
  run.rig.enable_from(run.now + kSecondUs);
  run.until(run.now + 2 * kSecondUs);
  assert_int_equal(run.status().mode, EcuMode::kActive);
}

TEST(stops_on_five_faults) {
  const auto spoil = [](std::uint32_t id, const std::function<bool(CanFrame&)>& edit) {
    return [=](Rig& rig) {
      rig.bus.set_fault_hook([=](CanFrame& frame, auto*) { return frame.id != id || edit(frame); });
    };
  };
  const auto clean = [](Rig& rig) { rig.bus.set_fault_hook({}); };
  const auto corrupt = [](CanFrame& frame) { return runs::corrupt(frame), true; };
  const auto other = [](bool on) {
    return [=](Rig& rig) { rig.plant.faults().wrong_identity = on; };
  };
  const auto hold = [](std::optional<double> ratio) {
    return [=](Rig& rig) { rig.plant.plant().hold_spool(kTilt, ratio); };
  };
  const auto bus_off = [](Rig& rig) { rig.ecu_port.set_state(CanPortState::kBusOff); };
  stops(Fault::kStrokeMissing, spoil(Bus::LiftCylinder::kId, [](auto&) { return false; }), clean);
  stops(Fault::kMessageCorrupt, spoil(Bus::TiltCylinder::kId, corrupt), clean);
  stops(Fault::kBusOff, bus_off, [](auto&) {});
  stops(Fault::kIdentityMismatch, other(true), other(false));
  stops(Fault::kSpoolStuck, hold(-0.9), hold({}));
}
