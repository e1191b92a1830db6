// SPDX-License-Identifier: Apache-2.0
#include "app/plant/canopen_parts.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

constexpr std::uint32_t kNmt = 0x000;
constexpr std::uint32_t kEmergency = 0x080;
constexpr std::uint32_t kTpdo1 = 0x180;
constexpr std::uint32_t kHeartbeat = 0x700;
constexpr std::uint8_t kStart = 0x01;
constexpr std::uint8_t kBootUp = 0x00;
constexpr std::uint8_t kPreOperational = 0x7F;
constexpr std::uint8_t kOperational = 0x05;

constexpr double kStep_m = 10e-6;
constexpr double kHundredth_rad = 1.7453292519943295e-4;
constexpr double kTenthBar_pa = 1e4;
constexpr std::uint8_t kNotValid = 0x01;
/// In the error register.
constexpr std::uint8_t kGenericError = 0x01;

/// Low byte first, two's complement.
void put(std::int64_t value, std::size_t first, std::size_t bytes, CanFrame& frame) {
  for (std::size_t n = 0; n < bytes; ++n) {
    frame.data[first + n] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * n));
  }
}

CanFrame frame_of(std::uint32_t id, std::uint8_t length, std::uint8_t bus) {
  CanFrame frame;
  frame.id = id;
  frame.extended = false;
  frame.length = length;
  frame.bus = bus;
  return frame;
}

}  // namespace

CanopenParts::CanopenParts(const ExcavatorPlantProfile& profile)
    : encoders_(profile.sold.encoders),
      transmitters_(profile.sold.transmitters),
      bus_(profile.sold.silent ? std::uint8_t{1} : kAnyBus) {
  if (encoders_) {
    add(kEncoder, kAxisCount);
  }
  if (profile.sold.inclinometers) {
    slopes_.emplace(profile);
    add(kInclinometer, kImuCount);
  }
  if (transmitters_) {
    add(kTransmitter, 2 * kAxisCount);
  }
}

void CanopenParts::add(std::uint8_t first, std::uint8_t count) {
  for (std::uint8_t n = 0; n < count; ++n) {
    nodes_.push_back({static_cast<std::uint8_t>(first + n)});
  }
}

void CanopenParts::take(const CanFrame& frame) {
  const bool starts = frame.id == kNmt && !frame.extended && !frame.remote && frame.length == 2 &&
                      frame.data[0] == kStart;
  for (Node& node : nodes_) {
    const bool meant = frame.data[1] == node.id || frame.data[1] == 0;
    node.operational = node.operational || (starts && meant && node.booted);
  }
}

void CanopenParts::measure(std::uint8_t id, const ExcavatorPlant& plant,
                           const ExcavatorFaults& faults, FaultySensors& sensors, CanFrame& frame) {
  if (id < kInclinometer) {
    const std::size_t axis = id - kEncoder;
    const dbc::Physical stroke =
        sensors.stroke(axis, plant.strokes_m()[faults.stroke_from[axis]], faults.axis[axis].stroke);
    put(std::lround(std::max(0.0, stroke.value) / kStep_m), 0, 4, frame);
  } else if (id < kTransmitter) {
    put(std::lround(slopes_->slope_rad(id - kInclinometer) / kHundredth_rad), 0, 2, frame);
    put(0, 2, 2, frame);
  } else {
    const std::size_t axis = (id - kTransmitter) / 2;
    const bool rod = (id - kTransmitter) % 2 != 0;
    const dbc::Physical shown =
        rod ? sensors.rod_pressure(axis, plant.rod_pressures_pa()[axis], faults.axis[axis].rod)
            : sensors.cap_pressure(axis, plant.cap_pressures_pa()[axis], faults.axis[axis].cap);
    const bool works = shown.state == dbc::RawState::kValid;
    put(std::lround(shown.value / kTenthBar_pa), 0, 2, frame);
    frame.data[2] = works ? std::uint8_t{0} : kNotValid;
  }
}

std::vector<CanFrame> CanopenParts::report(const ExcavatorPlant& plant,
                                           const ExcavatorFaults& faults, FaultySensors& sensors,
                                           std::uint64_t cycle) {
  std::vector<CanFrame> frames;
  if (slopes_) {
    slopes_->look(plant);
  }
  const bool reboots = reboots_done_ != faults.sold.reboots;
  reboots_done_ = faults.sold.reboots;
  const bool tells = emergency_told_ != faults.sold.emergency;
  emergency_told_ = faults.sold.emergency;
  for (Node& node : nodes_) {
    if (reboots && node.id == faults.sold.reboots_node) {
      node = {node.id};
    }
    if (!node.booted || cycle % kHeartbeatCycles == node.id % kHeartbeatCycles) {
      const std::uint8_t alive = node.operational ? kOperational : kPreOperational;
      frames.push_back(frame_of(kHeartbeat + node.id, 1, bus_));
      frames.back().data[0] = node.booted ? alive : kBootUp;
      node.booted = true;
    }
    if (tells && node.id == faults.sold.emergency_node) {
      frames.push_back(frame_of(kEmergency + node.id, 8, bus_));
      put(faults.sold.emergency, 0, 2, frames.back());
      frames.back().data[2] = faults.sold.emergency == 0 ? std::uint8_t{0} : kGenericError;
    }
    if (node.operational) {
      frames.push_back(frame_of(kTpdo1 + node.id, node.id < kTransmitter ? 4 : 3, bus_));
      measure(node.id, plant, faults, sensors, frames.back());
    }
  }
  return frames;
}

}  // namespace graben::plant
