#include "hal/buses/dozer_receiver.hpp"

#include "can_dbc/generated/dozer_dbc.hpp"
#include "hal/link/message_decode.hpp"

namespace graben {
namespace {

namespace bus = dbc::dozer;

using BusTask = bus::OperatorCommand::Task;
static_assert(static_cast<int>(BusTask::kGrade) == static_cast<int>(Task::kGrade));
static_assert(bus::OperatorCommand::kTask.raw_max == static_cast<unsigned>(Task::kGrade));

/// Either path; its line pressure is for diagnosis only.
template <class Transmission>
void put_transmission(TrackInputs& track, const Transmission& message, TimeUs now) {
  put(track.pump_ratio, message.pump_ratio, now);
  put(track.motor_ratio, message.motor_ratio, now);
}

struct Store {
  using To = DozerReceiver::Received;

  template <class Message>
  static constexpr bool is_ours(const Message&) {
    return true;
  }
  template <class Message>
  static constexpr BusPart part(const Message&) {
    return nullptr;
  }
  static constexpr bool is_ours(const bus::OperatorCommand& message) {
    return message.task.value != BusTask::kDig;
  }

  static void store(const bus::BladeStroke& message, TimeUs now, To& to) {
    put(to.inputs.blade_stroke_m, message.blade_stroke_m, now);
  }
  static void store(const bus::BodyPosition& message, TimeUs now, To& to) {
    put(to.inputs.body.position_m, message.position_m, now);
    put(to.inputs.body.height_m, message.height_m, now);
  }
  static void store(const bus::BodyPitch& message, TimeUs now, To& to) {
    put(to.inputs.body.pitch_rad, message.pitch_rad, now);
    put(to.inputs.body.pitch_rate_radps, message.pitch_rate_radps, now);
  }
  static void store(const bus::BodyVelocity& message, TimeUs now, To& to) {
    put(to.inputs.body.velocity_mps, message.forward_mps, now);
    put(to.inputs.body.climb_mps, message.climb_mps, now);
  }
  static void store(const bus::LeftTransmission& message, TimeUs now, To& to) {
    put_transmission(to.inputs.track[kLeft], message, now);
  }
  static void store(const bus::RightTransmission& message, TimeUs now, To& to) {
    put_transmission(to.inputs.track[kRight], message, now);
  }
  static void store(const bus::TrackSpeed& message, TimeUs now, To& to) {
    put(to.inputs.track[kLeft].speed_mps, message.left_track_mps, now);
    put(to.inputs.track[kRight].speed_mps, message.right_track_mps, now);
  }
  static void store(const bus::EEC1& message, TimeUs now, To& to) {
    put(to.inputs.engine_speed_radps, message.engine_speed_radps, now);
  }
  static void store(const bus::OperatorCommand& message, TimeUs now, To& to) {
    put_driver(to.inputs.driver, message, now);
  }
  static void store(const bus::MachineIdentity& message, TimeUs now, To& to) {
    put_identity(to.identity, message, now);
  }
  static void store(const bus::ValveState& message, TimeUs now, To& to) {
    put(to.inputs.blade_spool_ratio, message.blade_spool_ratio, now);
    put(to.inputs.valve_enabled, message.enabled, now);
  }
};

using Messages =
    dbc::MessageList<bus::BladeStroke, bus::BodyPosition, bus::BodyPitch, bus::BodyVelocity,
                     bus::LeftTransmission, bus::RightTransmission, bus::TrackSpeed, bus::EEC1,
                     bus::OperatorCommand, bus::MachineIdentity, bus::ValveState>;
constexpr auto kTable =
    receive_table<DozerInputs, Store>(Messages{}, bus::kMessages, bus::kDbcVersion);

}  // namespace

const ReceiveTable<DozerInputs, DozerReception::kMessageCount>& DozerReception::table() {
  return kTable;
}

}  // namespace graben
