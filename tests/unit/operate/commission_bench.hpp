// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The station of a commissioning, the controller and the simulated machine on a bus in memory.

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/operate/commission_frames.hpp"
#include "app/operate/commission_station.hpp"
#include "app/runs/excavator_rig.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

/// One drive; its ramps, and what is added to them.
inline commission::SequenceOptions one_drive(const machines::SimulatedExcavator& machine,
                                             int axis) {
  commission::SequenceOptions options = commission::whole_sequence(machine.profile);
  for (unsigned k = 0; k < kAxisCount; ++k) {
    options.window[k].least_m = 0.05 * options.stroke_m[k];
    options.window[k].most_m = 0.95 * options.stroke_m[k];
    options.drives[k] = static_cast<int>(k) == axis;
    options.touch_extended[k] = false;
    options.touch_retracted[k] = false;
  }
  options.steps = false;
  options.bursts = false;
  options.pairs = false;
  return options;
}

struct CommissionBench {
  using Kind = runs::ExcavatorSim;

  CommissionBench(const machines::SimulatedExcavator& given,
                  const commission::SequenceOptions& options)
      : machine(given), plant(Kind::node(machine, runs::start_at(middle(machine)), plant_port)) {
    setup.sequence = options;
    setup.profile_hash = machine.hash;
    assert_true(plant_port.open() && station_port.open() && ecu_port.open());
    ecu = std::make_unique<Kind::Ecu>(machine.profile, machine.hash, ecu_port);
    station = std::make_unique<operate::CommissionStation>(setup);
    run(1.0);
  }

  static Eigen::Vector3d middle(const machines::SimulatedExcavator& machine) {
    Eigen::Vector3d strokes_m;
    for (unsigned k = 0; k < kAxisCount; ++k) {
      strokes_m[k] = 0.5 * machine.profile.geometry.cylinder[k].stroke_m;
    }
    return strokes_m;
  }

  void cycle() {
    bus.set_time(now_us);
    plant.step(now_us);
    plant::receive_frames(station_port,
                          [this](const CanFrame& frame) { heard.hear(frame, now_us); });
    const auto trouble =
        heard.hears_ecu(now_us) ? operate::Trouble::kNone : operate::Trouble::kEcuSilent;
    station->step(hands, trouble, heard, now_us);
    if (cycles++ % 2 == 0 && sends) {
      for (const CanFrame& frame :
           frames.next(station->request(), station->tried(), heard.echo(), now_us)) {
        static_cast<void>(station_port.send(frame));
      }
    }
    ecu->step(now_us, 0);
    now_us += operate::CommissionStation::kPeriod_us;
    watch();
  }
  void run(double time_s) {
    for (double at_s = 0.0; at_s < time_s; at_s += 0.01) {
      cycle();
    }
  }
  /// Until `holds()`, for so long at most.
  template <class Holds>
  bool run_until(const Holds& holds, double most_s) {
    for (double at_s = 0.0; at_s < most_s && !holds(); at_s += 0.01) {
      cycle();
    }
    return holds();
  }
  bool run_to_end(double most_s = 300.0) {
    return run_until([this] { return station->end() != operate::CommissionEnd::kNone; }, most_s);
  }

  /// From here on the drives may go where their duties say, and nowhere else.
  void begin_watch() {
    from_m = strokes_m();
    strayed_m = 0.0;
    told = {};
  }
  /// Another station goes on after what is done.
  void restart_station(const std::vector<commission::StepResult>& done) {
    setup.done = done;
    station = std::make_unique<operate::CommissionStation>(setup);
    hands = {};
    run(2.0);  // What jumped at rest has stood since.
    hands.deadman = true;
  }

  [[nodiscard]] Eigen::Vector3d strokes_m() const {
    const auto strokes = plant.plant().strokes_m();
    return {strokes[0], strokes[1], strokes[2]};
  }
  /// From where the station takes the cylinder to be to where it is.
  [[nodiscard]] double unseen_m(int axis) const {
    const auto shown_m = heard.strokes_m(now_us)[static_cast<unsigned>(axis)];
    return shown_m ? std::abs(strokes_m()[axis] - *shown_m) : 0.0;
  }
  [[nodiscard]] bool neutral() const {
    const auto& duty = ecu->outputs().duty_ratio;
    return std::all_of(duty.begin(), duty.end(), [](double each) { return each == 0.0; });
  }
  [[nodiscard]] double duty() const {
    const auto& duty = station->tried().duty_ratio;
    return std::abs(duty[0]) + std::abs(duty[1]) + std::abs(duty[2]);
  }
  [[nodiscard]] Fault fault() const { return ecu->outputs().status.fault; }

  machines::SimulatedExcavator machine;
  LoopbackBus bus;
  LoopbackPort& plant_port = bus.attach();
  LoopbackPort& station_port = bus.attach();
  LoopbackPort& ecu_port = bus.attach();
  Kind::Node plant;
  std::unique_ptr<Kind::Ecu> ecu;
  operate::CommissionSetup setup;
  std::unique_ptr<operate::CommissionStation> station;
  operate::CommissionFrames frames;
  operate::EcuListener heard;
  operate::Hands hands;
  bool sends = true;
  TimeUs now_us = 0;
  double strayed_m = 0.0;  ///< Farthest that a cylinder has gone against its duty, or without one.

 private:
  void watch() {
    const auto& duty = station->tried().duty_ratio;
    const Eigen::Vector3d gone_m = strokes_m() - from_m;
    for (unsigned k = 0; k < kAxisCount; ++k) {
      if (duty[k] != 0.0) {
        told[k] = duty[k] > 0.0 ? 1.0 : -1.0;
      }
      const double wrong_m = told[k] == 0.0 ? std::abs(gone_m[k]) : -told[k] * gone_m[k];
      strayed_m = std::max(strayed_m, wrong_m);
    }
  }

  unsigned long cycles = 0;
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();
  std::array<double, kAxisCount> told{};
};

}  // namespace graben::test
