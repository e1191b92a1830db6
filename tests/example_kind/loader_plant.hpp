// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated loader: two cylinders, each with its own mass, on one open-centre pump.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "app/plant/cylinder.hpp"
#include "app/plant/machine_node.hpp"
#include "app/plant/pump_line.hpp"
#include "app/plant/valve_section.hpp"
#include "loader_dbc.hpp"
#include "tests/example_kind/loader_profile.hpp"

namespace graben::plant {

/// Of the plant's parts; on each cylinder hang a mass and a constant force that extends it.
class LoaderPlant {
 public:
  using Pair = std::array<double, kLoaderDrives>;
  static constexpr TimeUs kStepUs = 500;
  static constexpr double kStep_s = 0.5e-3;
  static constexpr Oil kOil = {1.4e9, -0.1e6};
  static constexpr Pair kMass_kg = {5000.0, 2000.0};
  static constexpr Pair kLoad_n = {42e3, 9e3};
  static constexpr SpoolSide kEdge = {0.2, 0.0, 1.5};  ///< Deadband and opening as of the profile.

  struct Side {
    Side(const LoaderProfile& profile, unsigned i)
        : cylinder({{profile.cap_m2[i], profile.rod_m2[i]},
                    profile.stroke_m[i],
                    1e-3,
                    kOil.bulk_modulus_pa,
                    {1200.0, 25e3}},
                   kStep_s),
          section({profile.spool[i],
                   profile.metering,
                   {0.02, 1.0, kEdge, kEdge, 0.1},
                   HydraulicDetails{}.protection(25e6)}),
          pilot(0.0, 0.0, kStep_s) {}

    Cylinder cylinder;
    ValveSection section;
    PilotValve pilot;
    double stroke_m = 0.0;
    double velocity_mps = 0.0;
  };

  LoaderPlant(const LoaderProfile& profile, const Pair& start_m)
      : profile_(profile),
        side_{Side(profile, kLift), Side(profile, kTilt)},
        pump_({profile.pump, kOil, HydraulicDetails{}.protection(profile.pump.relief_pa), 1.5e-3,
               1.0, kStep_s},
              kLoaderDrives) {
    for (unsigned i = 0; i < kLoaderDrives; ++i) {
      side_[i].stroke_m = start_m[i];
      side_[i].cylinder.start(start_m[i], -kLoad_n[i]);
    }
    set_bypass();
    pump_.start();
  }

  void advance(TimeUs duration_us) {
    for (TimeUs done = 0; done < duration_us; done += kStepUs) {
      step();
    }
  }
  void set_duty(const Pair& duty_ratio) { duty_ = duty_ratio; }
  void set_pilot_cut(bool on) { cut_ = on; }
  /// The pilot valve holds its spool there, whatever the duty.
  void hold_spool(unsigned i, std::optional<double> ratio) { side_[i].pilot.set_fault(ratio, 0.0); }

  [[nodiscard]] const Side& side(unsigned i) const { return side_[i]; }
  [[nodiscard]] double engine_radps() const { return profile_.pump.rated_speed_radps; }

 private:
  void set_bypass() {
    pump_.set_bypass(side_[kLift].section.bypass_inverse_square() +
                     side_[kTilt].section.bypass_inverse_square());
  }

  void step() {
    for (unsigned i = 0; i < kLoaderDrives; ++i) {
      Side& side = side_[i];
      side.section.set_command(side.pilot.step(duty_[i], cut_));
      const SectionFlows flows =
          side.section.solve({side.cylinder.cap_port(), side.cylinder.rod_port(),
                              pump_.supply_port(i), pump_.recycle_port(i)});
      pump_.set_section_flows(i, flows.supply_out_m3ps, flows.recycle_in_m3ps);
      side.section.step(kStep_s);
      const PistonLoad load = side.cylinder.load();
      const double half = 0.5 * kStep_s * load.damping_nspm;
      const double free =
          (kMass_kg[i] - half) * side.velocity_mps + kStep_s * (load.force_n + kLoad_n[i]);
      const double most = kStep_s * load.coulomb_n;
      const double before_mps = side.velocity_mps;
      side.velocity_mps = (free - std::clamp(free, -most, most)) / (kMass_kg[i] + half);
      const double mean_mps = 0.5 * (before_mps + side.velocity_mps);
      side.cylinder.step(flows.cap_in_m3ps, flows.rod_in_m3ps, mean_mps);
      side.stroke_m += kStep_s * mean_mps;
      side.cylinder.set_motion(side.stroke_m, side.velocity_mps);
    }
    pump_.step();
    set_bypass();
  }

  LoaderProfile profile_;
  std::array<Side, kLoaderDrives> side_;
  PumpLine pump_;
  Pair duty_{};
  bool cut_ = false;
};

/// The loader on its bus.
class LoaderNode : public MachineNode<dbc::loader::Dbc, LoaderPlant, NodeFaults> {
 public:
  LoaderNode(const LoaderProfile& profile, const LoaderPlant::Pair& start_m, CanPort& port,
             std::uint32_t profile_hash)
      : MachineNode(port, profile_hash, profile, start_m) {}

  /// To be called every 10 ms.
  void step(TimeUs now) {
    using namespace dbc::loader;
    receive([&](const CanFrame& frame) { take(frame, now); });
    if (spool_command_dies(now)) {
      set_duty(false, {});
    }
    advance(now);
    send(measured<LiftCylinder>(kLift), now);
    send(measured<TiltCylinder>(kTilt), now);
    if (is_due<EEC1>()) {
      send(EEC1{valid(plant_.engine_radps())}, now);
    }
    if (is_due<ValveState>(1)) {
      ValveState state = valve_state();
      state.lift_spool_ratio = valid(plant_.side(kLift).section.spool().travel_ratio());
      state.tilt_spool_ratio = valid(plant_.side(kTilt).section.spool().travel_ratio());
      send(state, now);
    }
    end_cycle(now);
  }

 private:
  void set_duty(bool enabled, const LoaderPlant::Pair& duty_ratio) {
    enabled_ = enabled;
    plant_.set_duty(enabled ? duty_ratio : LoaderPlant::Pair{});
  }
  void take(const CanFrame& frame, TimeUs now) {
    if (frame.id != SpoolCommand::kId) {
      return;
    }
    if (const auto request = take_spool_request(frame, now)) {
      const dbc::Physical& lift = request->command.lift_duty_ratio;
      const dbc::Physical& tilt = request->command.tilt_duty_ratio;
      set_duty(request->enabled && is_valid(lift) && is_valid(tilt), {lift.value, tilt.value});
    }
  }
  template <class Message>
  [[nodiscard]] Message measured(unsigned i) const {
    const LoaderPlant::Side& side = plant_.side(i);
    return {valid(side.stroke_m), valid(side.cylinder.cap().pressure_pa()),
            valid(side.cylinder.rod().pressure_pa())};
  }
};

}  // namespace graben::plant
