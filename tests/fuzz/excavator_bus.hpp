// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator, as the scripted bus needs a machine kind.

#include <array>
#include <string>
#include <vector>

#include "app/ecu/excavator_kind.hpp"
#include "app/machines/excavator_file.hpp"
#include "tests/fuzz/bus_port.hpp"

namespace graben::test {

struct ExcavatorBus : ecu::ExcavatorKind {
  static constexpr auto kTask = Dbc::OperatorCommand::Task::kDig;
  static constexpr std::size_t kMostFrames = Transmitter::kMessageCount;
  static constexpr unsigned kSpools = kAxisCount;
  static constexpr unsigned kPushed = kAxisCount;

  [[nodiscard]] static const Machine& shipped();
  /// Without it nothing may move: the others only slow.
  [[nodiscard]] static bool is_needed(std::uint32_t id);
  /// Of a swing drive or second sensors, which the shipped machine does not have; or of the
  /// operator's hands, which the task that is fuzzed does not look at. Unspoilt they come in no
  /// run.
  [[nodiscard]] static constexpr bool is_of_a_part(std::uint32_t id) {
    return id == Dbc::SwingState::kId || id == Dbc::SwingValveState::kId ||
           id == Dbc::OperatorAxes::kId || id == Dbc::CommissionDuty::kId ||
           id == Dbc::CommissionWindow::kId || id == Dbc::SecondStrokes::kId ||
           id == Dbc::SecondSwing::kId || id == Dbc::TouchedPoint::kId ||
           id == Dbc::ExternalLimit::kId;
  }
  /// Whether its values may be not available.
  [[nodiscard]] static bool may_miss(std::uint32_t id) {
    return id == Dbc::PumpCommand::kId || id == Dbc::EcuLearntValves::kId ||
           id == Dbc::EcuTipLoad::kId || id == Dbc::TaskStatus::kId || id == Dbc::EcuChecks::kId;
  }
  [[nodiscard]] static std::array<double, kSpools> duties(const Dbc::SpoolCommand& command);
  /// The duty at which a spool begins to open.
  [[nodiscard]] static double duty_edge(const Profile& profile) {
    return profile.valve.spool_to_duty.y_first();
  }
  /// Of the spools that are led, the first of all, through their lag; 0: none is.
  [[nodiscard]] static double spool_time_constant_s(const Profile& profile) {
    return profile.control.law == ControlLaw::kOil ? profile.oil.spool_time_constant_s : 0.0;
  }
  static constexpr unsigned kLed = 2;

  /// A machine that does what it is told.
  class Body {
   public:
    explicit Body(const Profile& profile);
    void hear(const CanFrame& frame);
    /// No command has come for long.
    void close() { command_ = {}; }
    void move(double elapsed_s);
    /// Of the machine's own messages.
    [[nodiscard]] dbc::Payload payload_of(std::uint32_t id) const;
    /// It stands at a pose on its path if it has been pushed off.
    void mend();

    std::array<double, kPushed> pushed_mps{};  ///< Motion that nobody asked for.

   private:
    const Profile& profile_;
    std::array<double, kAxisCount> strokes_m_{};
    Dbc::SpoolCommand command_;
    Dbc::EcuStatus status_;
    Dbc::EcuMotion motion_;
  };

  /// What must hold of a cycle's commands beside the spools'.
  class OtherCommands {
   public:
    explicit OtherCommands(const Profile&) {}
    [[nodiscard]] std::string check(const std::vector<SentFrame>& sent, bool moves, TimeUs now);
  };
};

}  // namespace graben::test
