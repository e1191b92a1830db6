// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer, as the scripted bus needs a machine kind; what a member means stands in
/// excavator_bus.hpp.

#include <array>
#include <string>
#include <vector>

#include "app/ecu/dozer_kind.hpp"
#include "app/machines/dozer_file.hpp"
#include "firmware/dozer/blade.hpp"
#include "tests/fuzz/bus_port.hpp"

namespace graben::test {

struct DozerBus : ecu::DozerKind {
  using PumpCommand = Dbc::PumpDisplacementCommand;
  using MotorCommand = Dbc::MotorDisplacementCommand;
  static constexpr auto kTask = Dbc::OperatorCommand::Task::kGrade;
  static constexpr std::size_t kMostFrames = Transmitter::kMessageCount;
  static constexpr unsigned kSpools = 1;
  /// Blade cylinders, the body along the grade, its climb.
  static constexpr unsigned kPushed = 3;

  [[nodiscard]] static const Machine& shipped();
  [[nodiscard]] static bool is_needed(std::uint32_t id);
  /// A tilt and a track that curves, which the shipped dozer has not.
  [[nodiscard]] static constexpr bool is_of_a_part(std::uint32_t id) {
    return id == Dbc::TiltState::kId || id == Dbc::BodyCourse::kId ||
           id == Dbc::TouchedPoint::kId || id == Dbc::ExternalLimit::kId ||
           id == Dbc::DozerTry::kId || id == Dbc::DozerWindow::kId;
  }
  [[nodiscard]] static bool may_miss(std::uint32_t id) { return id == Dbc::EcuChecks::kId; }
  [[nodiscard]] static std::array<double, kSpools> duties(const Dbc::SpoolCommand& command) {
    return {command.blade_duty_ratio.value};
  }
  [[nodiscard]] static double duty_edge(const Profile& profile) {
    return profile.implement.spool_to_duty.y_first();
  }
  [[nodiscard]] static double spool_time_constant_s(const Profile&) { return 0.0; }
  static constexpr unsigned kLed = 0;

  /// Level on level ground; its tracks run as its displacements let them.
  class Body {
   public:
    explicit Body(const Profile& profile);
    void hear(const CanFrame& frame);
    void close();
    void move(double elapsed_s);
    [[nodiscard]] dbc::Payload payload_of(std::uint32_t id) const;
    void mend();

    std::array<double, kPushed> pushed_mps{};

   private:
    [[nodiscard]] double speed_mps() const;

    const Profile& profile_;
    BladeKinematics blade_;
    double stroke_m_;
    double position_m_ = -3.0;
    double height_m_ = 0.0;
    Dbc::SpoolCommand command_;
    Dbc::EcuMotion motion_;
    std::array<double, kTrackCount> pump_ratio_{};
    std::array<double, kTrackCount> motor_ratio_ = {1.0, 1.0};
  };

  class OtherCommands {
   public:
    explicit OtherCommands(const Profile& profile) : profile_(profile) {}
    [[nodiscard]] std::string check(const std::vector<SentFrame>& sent, bool moves, TimeUs now);

   private:
    [[nodiscard]] std::string check_pumps(const PumpCommand& command, bool moves, double elapsed_s);
    [[nodiscard]] std::string check_motors(const MotorCommand& command, bool moves,
                                           double elapsed_s);

    const Profile& profile_;
    std::array<double, kTrackCount> pump_ratio_{};
    std::array<double, kTrackCount> motor_ratio_ = {1.0, 1.0};
    TimeUs last_us_ = -1;
  };
};

}  // namespace graben::test
