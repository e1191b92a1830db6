// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Messages that the buses of all machine kinds carry (common.dbc.in): where their signals go, and
/// what fills them. A kind's bus adds its own.

#include "can_dbc/generated/common_dbc.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "hal/link/message_decode.hpp"
#include "hal/link/message_encode.hpp"

namespace graben {

template <class Bus, class Own>
constexpr bool same_code(Bus bus_code, Own own_code) {
  return static_cast<int>(bus_code) == static_cast<int>(own_code);
}

/// Those that a controller receives.
using CommonReceived =
    dbc::MessageList<dbc::common::EEC1, dbc::common::OperatorCommand, dbc::common::TouchedPoint,
                     dbc::common::ExternalLimit, dbc::common::MachineIdentity>;

void store_operator(const dbc::common::OperatorCommand& message, TimeUs now, OperatorInputs& to);
void store_external(const dbc::common::ExternalLimit& message, TimeUs now,
                    Signal<ExternalWord>& to);
void store_touch(const dbc::common::TouchedPoint& message, TimeUs now, Signal<TouchWord>& to);
void store_identity(const dbc::common::MachineIdentity& message, TimeUs now, PartnerIdentity& to);

/// Base of a kind's Store; a kind adds `store` of its own messages. `own` are its tasks: an
/// operator's frame with another is not for it.
template <class Inputs, Task... own>
struct CommonStore {
  using To = Received<Inputs>;

  template <class Message>
  static constexpr bool is_ours(const Message&) {
    return true;
  }
  static constexpr bool is_ours(const dbc::common::OperatorCommand& message) {
    return (same_code(message.task.value, Task::kNone) || ... ||
            same_code(message.task.value, own));
  }
  template <class Message>
  static constexpr BusPart part(const Message&) {
    return nullptr;
  }

  static void store(const dbc::common::EEC1& message, TimeUs now, To& to) {
    put(to.inputs.engine_speed_radps, message.engine_speed_radps, now);
  }
  static void store(const dbc::common::OperatorCommand& message, TimeUs now, To& to) {
    store_operator(message, now, to.inputs.driver);
    put(to.echoes.driver, message.echo, now);
  }
  static void store(const dbc::common::TouchedPoint& message, TimeUs now, To& to) {
    store_touch(message, now, to.inputs.driver.touch);
  }
  static void store(const dbc::common::ExternalLimit& message, TimeUs now, To& to) {
    store_external(message, now, to.inputs.external);
  }
  static void store(const dbc::common::MachineIdentity& message, TimeUs now, To& to) {
    store_identity(message, now, to.identity);
    put(to.echoes.machine, message.echo, now);
  }
};

/// PilotCut is said whatever else is: Off, On or 'not available'; `outputs` are a controller's.
template <class SpoolCommand, class Outputs>
void set_pilot_cut(SpoolCommand& message, const Outputs& outputs) {
  using PilotCut = typename SpoolCommand::PilotCut;
  if (!outputs.pilot_known) {
    message.pilot_cut.state = dbc::RawState::kNotAvailable;
  } else if (outputs.pilot_cut) {
    message.pilot_cut = coded<PilotCut>(PilotCut::kOn);
  }
}

[[nodiscard]] dbc::common::EcuStatus ecu_status(const MachineStatus& status,
                                                const EcuDiagnosis& diagnosis);
[[nodiscard]] dbc::common::EcuHealth ecu_health(const MachineStatus& status,
                                                const EcuDiagnosis& diagnosis);
[[nodiscard]] dbc::common::EcuIdentity ecu_identity(const EcuDiagnosis& diagnosis,
                                                    std::uint8_t dbc_version);
[[nodiscard]] dbc::common::EcuChecks ecu_checks(const MarkTold& mark);
[[nodiscard]] dbc::Payload encode_trouble(const Dm1Content& content);

template <class Outputs>
dbc::common::EcuStatus status_of(const Outputs& outputs, const EcuDiagnosis& diagnosis) {
  return ecu_status(outputs.status, diagnosis);
}
template <class Outputs>
dbc::common::EcuHealth health_of(const Outputs& outputs, const EcuDiagnosis& diagnosis) {
  return ecu_health(outputs.status, diagnosis);
}
template <class Outputs>
dbc::common::EcuChecks checks_of(const Outputs& outputs, const EcuDiagnosis&) {
  return ecu_checks(outputs.status.mark);
}
template <class Outputs, std::uint8_t dbc_version>
dbc::common::EcuIdentity identity_of(const Outputs&, const EcuDiagnosis& diagnosis) {
  return ecu_identity(diagnosis, dbc_version);
}

/// Rows of a kind's table of what is sent.
template <class Outputs>
constexpr auto ecu_status_row() {
  return send_row<Outputs, dbc::common::EcuStatus, status_of<Outputs>>(0);
}
template <class Outputs>
constexpr auto ecu_health_row() {
  return send_row<Outputs, dbc::common::EcuHealth, health_of<Outputs>>(5 * kControlPeriod_us);
}
template <class Outputs>
constexpr auto ecu_checks_row() {
  return send_row<Outputs, dbc::common::EcuChecks, checks_of<Outputs>>(8 * kControlPeriod_us);
}
template <class Outputs, std::uint8_t dbc_version>
constexpr auto ecu_identity_row() {
  return send_row<Outputs, dbc::common::EcuIdentity, identity_of<Outputs, dbc_version>>(0);
}

/// A kind's table: `rows` most urgent first, and DM1.
template <class... Rows>
constexpr auto bus_send_table(const Rows&... rows) {
  return send_table(dbc::common::DM1::kId, &encode_trouble, rows...);
}

}  // namespace graben
