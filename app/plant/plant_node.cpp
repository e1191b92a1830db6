#include "app/plant/plant_node.hpp"

#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::plant {
namespace {

namespace bus = dbc::excavator;
using dbc::Physical;
using dbc::RawState;

constexpr E2eConfig kCommandE2e{bus::SpoolCommand::kDataId, bus::SpoolCommand::kMaxDeltaCounter,
                                PlantNode::kCommandTimeoutUs};
// A cycle takes no more than this, so that a flood on the bus cannot stop the simulation.
constexpr int kFramesPerRead = 64;
constexpr int kReadsPerCycle = 64;
constexpr std::uint64_t kPumpCycles = bus::PumpState::kCycleTimeMs / 10;
constexpr std::uint64_t kIdentityCycles = bus::MachineIdentity::kCycleTimeMs / 10;

Physical valid(double value) { return {value, RawState::kValid}; }

bool all_valid(const bus::SpoolCommand& command) {
  return command.enable.state == RawState::kValid &&
         command.boom_duty_ratio.state == RawState::kValid &&
         command.arm_duty_ratio.state == RawState::kValid &&
         command.bucket_duty_ratio.state == RawState::kValid;
}

}  // namespace

PlantNode::PlantNode(const PlantProfile& profile, const ExcavatorPlant::AxisArray& start_strokes_m,
                     CanPort& port, std::uint32_t profile_hash)
    : plant_(profile, start_strokes_m),
      sensors_(profile.sensors, profile.sensor_errors ? std::optional(profile.seed) : std::nullopt),
      port_(port),
      sender_(port),
      profile_hash_(profile_hash) {}

void PlantNode::step(TimeUs now) {
  receive(now);
  if (command_alive_ && now - last_command_us_ >= kCommandTimeoutUs) {
    ++counters_.timeouts;
    command_alive_ = false;
    go_neutral();
  }
  plant_.advance(kCycleUs);
  send_axes(now);
  if (cycle_ % kPumpCycles == 0) {
    send_pumps(now);
  }
  if (cycle_ % kIdentityCycles == 0) {
    send_identity(now);
  }
  ++cycle_;
}

void PlantNode::receive(TimeUs now) {
  std::array<CanFrame, kFramesPerRead> frames;
  for (int read = 0; read < kReadsPerCycle; ++read) {
    const int count = port_.receive(frames.data(), kFramesPerRead);
    for (int i = 0; i < count; ++i) {
      const CanFrame& frame = frames[static_cast<std::size_t>(i)];
      if (frame.id == bus::SpoolCommand::kId) {
        take_command(frame, now);
      }
    }
    if (count < kFramesPerRead) {
      return;
    }
  }
}

void PlantNode::take_command(const CanFrame& frame, TimeUs now) {
  if (!frame.extended || frame.remote || frame.error || frame.fd ||
      frame.length != bus::SpoolCommand::kLength) {
    ++counters_.wrong_format;
    return;
  }
  if (!e2e_accepted(e2e_check(kCommandE2e, command_e2e_, frame.data, now))) {
    ++counters_.rejected;
    return;
  }
  ++counters_.accepted;
  command_alive_ = true;
  last_command_us_ = now;
  const bus::SpoolCommand command = bus::SpoolCommand::decode(frame.data);
  if (!all_valid(command) || command.enable.value != bus::SpoolCommand::Enable::kOn) {
    go_neutral();
    return;
  }
  enabled_ = true;
  plant_.set_duty({command.boom_duty_ratio.value, command.arm_duty_ratio.value,
                   command.bucket_duty_ratio.value},
                  true);
}

void PlantNode::go_neutral() {
  enabled_ = false;
  plant_.set_duty({}, false);
}

Physical PlantNode::stroke(std::size_t axis) const {
  if (stroke_state_[axis] != RawState::kValid) {
    return {0.0, stroke_state_[axis]};
  }
  return valid(sensors_.stroke_m(axis, plant_.strokes_m()[axis]));
}

void PlantNode::send_axes(TimeUs now) {
  sender_.send(bus::BoomStroke{stroke(kBoom)}, now);
  sender_.send(bus::ArmStroke{stroke(kArm)}, now);
  sender_.send(bus::BucketStroke{stroke(kBucket)}, now);
  send_pressures(now);
}

void PlantNode::send_pressures(TimeUs now) {
  const auto cap = plant_.cap_pressures_pa();
  const auto rod = plant_.rod_pressures_pa();
  std::array<Physical, kAxisCount> cap_shown;
  std::array<Physical, kAxisCount> rod_shown;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    cap_shown[i] = valid(sensors_.cap_pressure_pa(i, cap[i]));
    rod_shown[i] = valid(sensors_.rod_pressure_pa(i, rod[i]));
  }
  sender_.send(bus::BoomPressure{cap_shown[kBoom], rod_shown[kBoom]}, now);
  sender_.send(bus::ArmPressure{cap_shown[kArm], rod_shown[kArm]}, now);
  sender_.send(bus::BucketPressure{cap_shown[kBucket], rod_shown[kBucket]}, now);
}

void PlantNode::send_pumps(TimeUs now) {
  const PlantProfile& profile = plant_.profile();
  sender_.send(bus::PumpState{valid(profile.swash_ratio[0]), valid(profile.swash_ratio[1])}, now);
  // One engine drives both pumps at the same speed.
  sender_.send(bus::EEC1{valid(profile.machine.pump[0].rated_speed_radps)}, now);
}

void PlantNode::send_identity(TimeUs now) {
  bus::MachineIdentity message;
  message.profile_hash = {profile_hash_, RawState::kValid};
  message.dbc_version = {bus::kDbcVersion, RawState::kValid};
  sender_.send(message, now);
}

}  // namespace graben::plant
