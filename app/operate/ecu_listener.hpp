// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the station hears on the bus: the controller, the machine's strokes, and other stations.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/core/codes.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/j1939/ids.hpp"
#include "hal/j1939/transport.hpp"
#include "hal/link/message_rules.hpp"
#include "hal/link/stamp_echo.hpp"

namespace graben::operate {

/// A message as it came last.
template <class Message>
struct Heard {
  std::optional<Message> said;
  TimeUs at_us = 0;

  [[nodiscard]] bool is_fresh(TimeUs now, TimeUs within_us) const {
    return said && now - at_us < within_us;
  }
};

class EcuListener {
 public:
  using Dbc = dbc::excavator::Dbc;
  /// Of a controller with frames of this version: each kind's DBC has its own.
  explicit EcuListener(std::uint32_t dbc_version = Dbc::kDbcVersion) : dbc_version_(dbc_version) {}

  /// Five frames of EcuStatus in a row.
  static constexpr TimeUs kStatusTimeout_us = 100 * kMillisecondUs;
  /// What DM1 has not repeated for so long is over: each code comes within 1 s.
  static constexpr TimeUs kTroubleFor_us = 1500 * kMillisecondUs;

  void hear(const CanFrame& frame, TimeUs now);

  [[nodiscard]] const Heard<Dbc::EcuStatus>& status() const { return status_; }
  [[nodiscard]] const Heard<Dbc::EcuHealth>& health() const { return health_; }
  [[nodiscard]] const Heard<Dbc::EcuIdentity>& identity() const { return identity_; }
  [[nodiscard]] const Heard<Dbc::TaskStatus>& task() const { return task_; }
  [[nodiscard]] const Heard<Dbc::EcuTipLoad>& tip_load() const { return tip_load_; }
  [[nodiscard]] const Heard<Dbc::EcuChecks>& checks() const { return checks_; }
  [[nodiscard]] const Heard<Dbc::EcuMotion>& motion() const { return motion_; }
  /// Of boom, arm, bucket; empty where none came of late, or none that is valid.
  [[nodiscard]] std::array<std::optional<double>, 3> strokes_m(TimeUs now) const;
  /// Duties of boom, arm and bucket as the controller sent them last; 0 before.
  [[nodiscard]] std::array<double, 3> sent_ratio() const;
  /// Angle of the swing, rad, and its duty; the angle is empty as the strokes are.
  [[nodiscard]] std::optional<double> swing_rad(TimeUs now) const;
  [[nodiscard]] double swing_sent_ratio() const;
  /// What DM1 says besides.
  [[nodiscard]] std::vector<Fault> faults(TimeUs now) const;

  [[nodiscard]] bool hears_ecu(TimeUs now) const {
    return status_.is_fresh(now, kStatusTimeout_us);
  }
  /// As said last, if the ECU is heard.
  [[nodiscard]] std::optional<EcuMode> mode(TimeUs now) const;
  [[nodiscard]] std::uint32_t dbc_version() const { return dbc_version_; }
  /// The version that the ECU says, if it is not ours.
  [[nodiscard]] std::optional<std::uint32_t> other_version() const;
  /// Source address of another OperatorCommand, if one was heard.
  [[nodiscard]] std::optional<std::uint8_t> other_station() const { return other_station_; }
  /// For OperatorCommand.Echo.
  [[nodiscard]] dbc::Count echo() const { return echo_.said(); }

 private:
  struct Stroke {
    dbc::Physical value;
    TimeUs at_us = 0;
  };

  template <class Message>
  void take(const CanFrame& frame, TimeUs now, Heard<Message>& to);
  template <class Message>
  void take_stroke(const CanFrame& frame, dbc::Physical Message::*signal, TimeUs now, Stroke& to);
  void take_trouble(const CanFrame& frame, TimeUs now);
  void note_trouble(const CanFrame& single, TimeUs now);

  Heard<Dbc::EcuStatus> status_;
  Heard<Dbc::EcuHealth> health_;
  Heard<Dbc::EcuIdentity> identity_;
  Heard<Dbc::TaskStatus> task_;
  Heard<Dbc::EcuTipLoad> tip_load_;
  Heard<Dbc::EcuChecks> checks_;
  Heard<Dbc::EcuMotion> motion_;
  Heard<Dbc::SpoolCommand> spools_;
  Heard<Dbc::SwingCommand> swing_spool_;
  std::array<Stroke, 3> strokes_;
  Stroke swing_;
  j1939::BamReceiver troubles_{j1939::kActiveCodesPgn, kOwnAddress};  ///< DM1 of several codes.
  std::map<std::uint32_t, TimeUs> trouble_us_;  ///< SPN -> when it was said last.
  std::optional<std::uint8_t> other_station_;
  std::uint32_t dbc_version_;
  StampEcho<Dbc::EcuIdentity> echo_;
};

}  // namespace graben::operate
