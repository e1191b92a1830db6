#include "app/runs/fault_text.hpp"

namespace graben::runs {

const char* fault_words(Fault fault) {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kStrokeMissing:
      return "a stroke is missing";
    case Fault::kPressureMissing:
      return "a pressure is missing";
    case Fault::kSwashMissing:
      return "a pump's swash is missing";
    case Fault::kEngineSpeedMissing:
      return "the engine's speed is missing";
    case Fault::kOperatorMissing:
      return "the operator's frames are missing";
    case Fault::kStrokeImplausible:
      return "a stroke lies outside its cylinder";
    case Fault::kPoseUnreachable:
      return "the pose cannot be reached";
    case Fault::kSolverFailed:
      return "the valve's equations were not solved";
    case Fault::kCommandNotFinite:
      return "a command is not a number";
    case Fault::kCycleStalled:
      return "a control cycle stalled";
    case Fault::kIdentityMismatch:
      return "the machine has another profile or DBC";
    case Fault::kBusOff:
      return "bus-off";
    case Fault::kBusPassive:
      return "the bus is error-passive: nobody acknowledges";
    case Fault::kBusDown:
      return "the bus is down";
    case Fault::kTransmitFailed:
      return "the bus does not take frames";
    case Fault::kCycleOverrun:
      return "two control cycles in a row were late";
    case Fault::kMessageCorrupt:
      return "wrong CRCs of a message";
    case Fault::kMessageSequence:
      return "a message out of sequence";
    case Fault::kMessageMasquerade:
      return "a message under another one's id";
    case Fault::kSpoolMissing:
      return "the valve's feedback is missing";
    case Fault::kSpoolStuck:
      return "a spool does not obey";
    case Fault::kUncommandedMotion:
      return "a cylinder moves uncommanded";
    case Fault::kStrokeStuck:
      return "a stroke stands still under flow";
    case Fault::kStrokeJump:
      return "a stroke jumps";
    case Fault::kPressureImplausible:
      return "a pressure is stuck or at its rail";
    case Fault::kSwashDisagrees:
      return "a pump's swash is not as commanded";
    case Fault::kMemoryCorrupt:
      return "a stored setpoint has changed";
    case Fault::kValveNotFollowing:
      return "the valve does not confirm enable";
    case Fault::kValueOutOfRange:
      return "a value is out of its range";
    case Fault::kSensorError:
      return "a sensor calls itself wrong";
    case Fault::kPoseMissing:
      return "the body's pose is missing";
    case Fault::kPoseImplausible:
      return "the body's pose jumps or cannot be";
    case Fault::kTransmissionMissing:
      return "the transmission's feedback is missing";
    case Fault::kDisplacementDisagrees:
      return "a displacement does not obey";
    case Fault::kDisplacementRunaway:
      return "a displacement runs away";
    case Fault::kTrackSpeedDisagrees:
      return "a track's speed is not that of its displacements";
    case Fault::kTaskUnknown:
      return "unknown task number";
  }
  return "unknown";
}

const char* arm_block_words(ArmBlock block) {
  switch (block) {
    case ArmBlock::kStroke:
      return "a stroke is missing or cannot be";
    case ArmBlock::kPressure:
      return "a pressure is missing or cannot be";
    case ArmBlock::kSwash:
      return "a pump's swash is missing or not as commanded";
    case ArmBlock::kEngineSpeed:
      return "the engine's speed is missing";
    case ArmBlock::kOperator:
      return "the operator's frames are missing";
    case ArmBlock::kSpool:
      return "the valve's feedback is missing";
    case ArmBlock::kIdentity:
      return "the machine has another profile or DBC, or does not say";
    case ArmBlock::kBus:
      return "the bus is not active, or does not take the controller's frames";
    case ArmBlock::kMessages:
      return "messages with wrong CRCs, out of sequence or with values out of range";
    case ArmBlock::kUnreachable:
      return "the strokes give no pose";
    case ArmBlock::kCycle:
      return "control cycles are late";
    case ArmBlock::kManual:
      return "the operator drives by hand";
    case ArmBlock::kTaskNotAtRest:
      return "a task is chosen already: first none, then the task";
    case ArmBlock::kEnableNotFresh:
      return "enable is not given, or was not released before";
    case ArmBlock::kFaultLatched:
      return "a fault is latched: release enable, then give it again";
    case ArmBlock::kStopping:
      return "the controller was told to end";
    case ArmBlock::kPose:
      return "the body's pose is missing or cannot be";
    case ArmBlock::kTransmission:
      return "the transmission's feedback is missing or not as commanded";
    case ArmBlock::kNotCentred:
      return "a spool is not in its middle: release the levers";
    case ArmBlock::kValve:
      return "the valve does not do as it is told";
    case ArmBlock::kController:
      return "the controller's own check has failed";
    case ArmBlock::kSensorError:
      return "a sensor reports an error of its own";
    case ArmBlock::kTask:
      return "unknown task number";
  }
  return "unknown";
}

}  // namespace graben::runs
