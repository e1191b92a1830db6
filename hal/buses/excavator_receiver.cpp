#include "hal/buses/excavator_receiver.hpp"

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/link/message_decode.hpp"

namespace graben {
namespace {

namespace bus = dbc::excavator;

using BusTask = bus::OperatorCommand::Task;
static_assert(static_cast<int>(BusTask::kProgram) == static_cast<int>(Task::kProgram));
static_assert(bus::OperatorCommand::kTask.raw_max == static_cast<unsigned>(Task::kProgram));

void put_pressures(AxisInputs& axis, const dbc::Physical& cap, const dbc::Physical& rod,
                   TimeUs now) {
  put(axis.cap_pressure_pa, cap, now);
  put(axis.rod_pressure_pa, rod, now);
}

struct Store {
  using To = ExcavatorReceiver::Received;

  template <class Message>
  static constexpr bool is_ours(const Message&) {
    return true;
  }
  static constexpr bool is_ours(const bus::OperatorCommand& message) {
    return message.task.value != BusTask::kGrade;
  }
  template <class Message>
  static constexpr BusPart part(const Message&) {
    return nullptr;
  }
  static constexpr BusPart part(const bus::SwingState&) { return &BusParts::swing_drive; }
  static constexpr BusPart part(const bus::SwingValveState&) { return &BusParts::swing_drive; }

  static void store(const bus::BoomStroke& message, TimeUs now, To& to) {
    put(to.inputs.axis[0].stroke_m, message.boom_stroke_m, now);
  }
  static void store(const bus::ArmStroke& message, TimeUs now, To& to) {
    put(to.inputs.axis[1].stroke_m, message.arm_stroke_m, now);
  }
  static void store(const bus::BucketStroke& message, TimeUs now, To& to) {
    put(to.inputs.axis[2].stroke_m, message.bucket_stroke_m, now);
  }
  static void store(const bus::BoomPressure& message, TimeUs now, To& to) {
    put_pressures(to.inputs.axis[0], message.boom_cap_pressure_pa, message.boom_rod_pressure_pa,
                  now);
  }
  static void store(const bus::ArmPressure& message, TimeUs now, To& to) {
    put_pressures(to.inputs.axis[1], message.arm_cap_pressure_pa, message.arm_rod_pressure_pa, now);
  }
  static void store(const bus::BucketPressure& message, TimeUs now, To& to) {
    put_pressures(to.inputs.axis[2], message.bucket_cap_pressure_pa, message.bucket_rod_pressure_pa,
                  now);
  }
  static void store(const bus::SwingState& message, TimeUs now, To& to) {
    put(to.inputs.swing.angle_rad, message.swing_angle_rad, now);
    put(to.inputs.swing.left_pressure_pa, message.swing_left_pressure_pa, now);
    put(to.inputs.swing.right_pressure_pa, message.swing_right_pressure_pa, now);
  }
  static void store(const bus::PumpState& message, TimeUs now, To& to) {
    put(to.inputs.swash_ratio[0], message.pump1_swash_ratio, now);
    put(to.inputs.swash_ratio[1], message.pump2_swash_ratio, now);
  }
  static void store(const bus::EEC1& message, TimeUs now, To& to) {
    put(to.inputs.engine_speed_radps, message.engine_speed_radps, now);
  }
  static void store(const bus::OperatorCommand& message, TimeUs now, To& to) {
    put_driver(to.inputs.driver, message, now);
    put(to.inputs.driver.task_number, message.task_number, now);
  }
  static void store(const bus::MachineIdentity& message, TimeUs now, To& to) {
    put_identity(to.identity, message, now);
  }
  static void store(const bus::ValveState& message, TimeUs now, To& to) {
    put(to.inputs.axis[0].spool_ratio, message.boom_spool_ratio, now);
    put(to.inputs.axis[1].spool_ratio, message.arm_spool_ratio, now);
    put(to.inputs.axis[2].spool_ratio, message.bucket_spool_ratio, now);
    put(to.inputs.valve_enabled, message.enabled, now);
  }
  static void store(const bus::SwingValveState& message, TimeUs now, To& to) {
    put(to.inputs.swing.spool_ratio, message.swing_spool_ratio, now);
  }
};

using Messages =
    dbc::MessageList<bus::BoomStroke, bus::ArmStroke, bus::BucketStroke, bus::BoomPressure,
                     bus::ArmPressure, bus::BucketPressure, bus::PumpState, bus::EEC1,
                     bus::OperatorCommand, bus::MachineIdentity, bus::ValveState, bus::SwingState,
                     bus::SwingValveState>;
constexpr auto kTable =
    receive_table<ExcavatorInputs, Store>(Messages{}, bus::kMessages, bus::kDbcVersion);

}  // namespace

const ReceiveTable<ExcavatorInputs, ExcavatorReception::kMessageCount>&
ExcavatorReception::table() {
  return kTable;
}

}  // namespace graben
