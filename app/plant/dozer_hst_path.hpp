// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One path of the dozer's transmission: pump, two lines, motor, gear, sprocket, brake.

#include <array>
#include <optional>

#include "app/plant/dozer_plant_profile.hpp"
#include "app/plant/hydraulics.hpp"
#include "app/plant/spool.hpp"
#include "app/plant/wave_volume.hpp"

namespace graben::plant {

/// What is wrong with the servo of one displacement. The default is nothing.
struct DisplacementFault {
  std::optional<double> held_ratio;  ///< Where it goes, whatever is commanded.
  double offset_ratio = 0.0;         ///< Added to the command.
  bool reversed = false;             ///< The command counts with the other sign; pumps only.
};

/// A displacement that follows its command: first-order lag with a limited rate.
class DisplacementServo {
 public:
  DisplacementServo(double least, double start, double response_s, double rate_ps,
                    double dead_time_s, double step_s);

  /// Not finite counts as where it started.
  void set_wanted(double ratio);
  void set_fault(const DisplacementFault& fault) { fault_ = fault; }
  void step();
  [[nodiscard]] double ratio() const { return ratio_; }

 private:
  double least_;
  double start_;
  DeadTime late_;  ///< Of what is wanted beside where it started.
  double share_;   ///< Of the way that is left, in a step.
  double most_;    ///< In a step.
  double wanted_;
  double ratio_;
  DisplacementFault fault_;
};

/// What one step did, m^3/s. Line A is at high pressure when the machine is driven forward.
struct HstFlows {
  std::array<double, 2> pump_in{};   ///< Into line A and B, after leakage, relief and charge.
  std::array<double, 2> motor_in{};  ///< The same at the motor: what it takes is negative.
};

/// Closed circuit. Leakage is laminar from each line of pump and motor to their cases, and a share
/// of the displacement; relief and charge check of each line sit at the pump and join it to the
/// charge gallery, so that a relief's oil is not lost. What the check has let in goes out of the
/// lower line again through the flushing valve, whose shuttle the higher one holds open: the low
/// line keeps the charge pressure, however little leaks.
/// Each line is a transmission-line element: stable at any step. The motor's mechanical losses are
/// dry friction in proportion to its torque; the brake is dry friction too.
class HstPath {
 public:
  explicit HstPath(const DozerPlantProfile& profile, std::size_t track = 0);

  [[nodiscard]] DisplacementServo& pump() { return pump_; }
  [[nodiscard]] DisplacementServo& motor() { return motor_; }
  [[nodiscard]] const DisplacementServo& pump() const { return pump_; }
  [[nodiscard]] const DisplacementServo& motor() const { return motor_; }

  /// `traction_n` is what the track drives the body with, which holds the sprocket back.
  void step(double engine_radps, double traction_n, bool brake);

  /// Of the sprocket times its radius; forward is positive.
  [[nodiscard]] double track_speed_mps() const { return speed_radps_ * radius_; }
  /// Of line A and B, above ambient.
  [[nodiscard]] std::array<double, 2> pressures_pa() const {
    return {charge_ + line_[0].pressure_pa(), charge_ + line_[1].pressure_pa()};
  }
  /// Line A or B; its pressure counts from the charge pressure.
  [[nodiscard]] const WaveVolume& line(std::size_t index) const { return line_[index]; }
  [[nodiscard]] const HstFlows& flows() const { return flows_; }
  /// What the motor's oil pushes the sprocket with, before its friction, N m.
  [[nodiscard]] double motor_torque_nm() const { return motor_torque_; }

 private:
  static constexpr std::size_t kPumpPort = 0;
  static constexpr std::size_t kMotorPort = 1;

  void feed(double engine_radps);
  void turn(double traction_n, bool brake);
  /// Of line A or B, by the flushing valve, per pressure over the charge pressure.
  [[nodiscard]] double flushing_m3pspa(std::size_t index) const;

  DisplacementServo pump_;
  DisplacementServo motor_;
  std::array<WaveVolume, 2> line_;
  PortProtection protection_;
  double step_;
  double charge_;
  double flushing_m3pspa_;
  double shuttle_pa_;
  double pump_m3prad_;        ///< As its flow has it, of the pump's turn.
  double motor_m3prad_;       ///< Geometric, of the sprocket's turn.
  double motor_flow_m3prad_;  ///< As its flow has it.
  double pump_leak_m3pspa_;
  double motor_leak_m3pspa_;
  double inertia_;
  double radius_;
  double friction_share_;
  double brake_;
  double speed_radps_ = 0.0;  ///< Of the sprocket.
  double motor_torque_ = 0.0;
  HstFlows flows_;
};

}  // namespace graben::plant
