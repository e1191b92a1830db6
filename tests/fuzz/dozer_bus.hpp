#pragma once
/// The dozer, as the scripted bus needs a machine kind; what a member means stands in
/// excavator_bus.hpp.

#include <array>
#include <string>
#include <vector>

#include "app/ecu/dozer_ecu.hpp"
#include "app/machines/dozer_file.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "firmware/dozer/blade.hpp"
#include "tests/fuzz/bus_port.hpp"

namespace graben::test {

struct DozerBus {
  using Machine = machines::DozerMachine;
  using Profile = DozerProfile;
  using Ecu = ecu::DozerEcu;
  using Outputs = DozerOutputs;
  using AllMessages = dbc::dozer::AllMessages;
  using SpoolCommand = dbc::dozer::SpoolCommand;
  using OperatorCommand = dbc::dozer::OperatorCommand;
  using MachineIdentity = dbc::dozer::MachineIdentity;
  using ValveState = dbc::dozer::ValveState;
  using EcuStatus = dbc::dozer::EcuStatus;
  using EcuHealth = dbc::dozer::EcuHealth;
  using PumpCommand = dbc::dozer::PumpDisplacementCommand;
  using MotorCommand = dbc::dozer::MotorDisplacementCommand;
  static constexpr const auto& kMessages = dbc::dozer::kMessages;
  static constexpr std::uint8_t kDbcVersion = dbc::dozer::kDbcVersion;
  static constexpr auto kTask = OperatorCommand::Task::kGrade;
  static constexpr std::size_t kMostFrames = DozerTransmitter::kMessageCount;
  static constexpr unsigned kSpools = 1;
  /// Blade cylinders, the body along the grade, its climb.
  static constexpr unsigned kPushed = 3;

  [[nodiscard]] static const Machine& shipped();
  [[nodiscard]] static bool is_needed(std::uint32_t id);
  [[nodiscard]] static constexpr bool is_of_a_part(std::uint32_t) { return false; }
  [[nodiscard]] static bool may_miss(std::uint32_t) { return false; }
  [[nodiscard]] static std::array<double, kSpools> duties(const SpoolCommand& command) {
    return {command.blade_duty_ratio.value};
  }
  [[nodiscard]] static double duty_edge(const Profile& profile) {
    return profile.implement.spool_to_duty.y_first();
  }

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
    SpoolCommand command_;
    dbc::dozer::EcuMotion motion_;
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
