#include "app/ecu/excavator_ecu.hpp"

#include <algorithm>
#include <limits>

#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::ecu {
namespace {
/// A cycle takes all that is pending, up to the capacity of any queue of ours; a 500 kbit/s bus
/// brings some 75 of the shortest frames in 10 ms.
constexpr int kFramesPerBatch = 96;
constexpr int kBatchesPerCycle = 4;
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
constexpr TimeUs kOpenAgain_us = 200 * kMillisecondUs;
constexpr TimeUs kStillPassive_us = kSecondUs;

BusState bus_state(CanPortState state) {
  switch (state) {
    case CanPortState::kActive:
      return BusState::kActive;
    case CanPortState::kErrorPassive:
      return BusState::kPassive;
    case CanPortState::kBusOff:
      return BusState::kOff;
    case CanPortState::kClosed:
    case CanPortState::kDown:
      break;
  }
  return BusState::kDown;
}
}  // namespace

ExcavatorEcu::ExcavatorEcu(const ExcavatorProfile& profile, std::uint32_t profile_hash,
                           CanPort& port)
    : port_(port), controller_(profile) {
  diagnosis_.profile_hash = profile_hash;
}

void ExcavatorEcu::receive(TimeUs now_us, bool stale) {
  std::array<CanFrame, kFramesPerBatch> frames;
  for (int batch = 0; batch < kBatchesPerCycle; ++batch) {
    const int count = port_.receive(frames.data(), kFramesPerBatch);
    for (int i = 0; i < count && !stale; ++i) {
      receiver_.accept(frames[static_cast<unsigned>(i)], now_us);
    }
    if (count < kFramesPerBatch) {
      return;
    }
  }
}

bool ExcavatorEcu::is_stalled(TimeUs now_us) {
  const bool stalled = has_stepped_ && now_us - last_us_ > kStalled_us;
  last_us_ = now_us;
  has_stepped_ = true;
  return stalled;
}

void ExcavatorEcu::watch_bus(TimeUs now_us, BusState before) {
  // What it was before the port was read counts too: each state is seen for one cycle at least.
  bus_ = std::max(before, bus_state(port_.state()));
  if (bus_ == BusState::kPassive && !needs_open_) {
    // It mostly comes back by itself; but the frame that says so can be lost.
    open_from_us_ = now_us + kStillPassive_us;
  }
  needs_open_ = needs_open_ || bus_ != BusState::kActive;
}

void ExcavatorEcu::open_again(TimeUs now_us, bool stalled) {
  const bool is_back = bus_ == BusState::kActive;
  if (stalled || (needs_open_ && (is_back || now_us >= open_from_us_))) {
    // A port that does not open again stays silent; the signals then time out.
    needs_open_ = !port_.open();
    open_from_us_ = now_us + kOpenAgain_us;
  }
}

void ExcavatorEcu::gather_inputs(TimeUs now_us) {
  inputs_ = receiver_.inputs();
  inputs_.same_machine = receiver_.same_machine(diagnosis_.profile_hash);
  inputs_.link.bus = bus_;
  inputs_.link.message_faults = receiver_.message_faults(now_us);
  inputs_.link.out_of_range = receiver_.take_out_of_range();
  inputs_.link.dropped_cycles = dropped_cycles_;
  inputs_.link.stop_requested = stop_requested_;
}

void ExcavatorEcu::send(const ExcavatorTransmitter::Frames& frames, int count) {
  for (int i = 0; i < count; ++i) {
    const CanFrame& frame = frames[static_cast<unsigned>(i)];
    const bool sent = port_.send(frame);
    diagnosis_.dropped_frames += sent ? 0U : 1U;
    if (frame.id == dbc::excavator::SpoolCommand::kId) {
      const bool at_end = dropped_cycles_ == std::numeric_limits<int>::max();
      dropped_cycles_ = sent ? 0 : dropped_cycles_ + (at_end ? 0 : 1);
    }
  }
}

void ExcavatorEcu::step(TimeUs now_us, TimeUs last_cycle_us) {
  const bool stalled = is_stalled(now_us);
  const BusState before = bus_state(port_.state());
  // What waited through a stall or a lost bus is not fresh; the controller has stopped then anyway.
  receive(now_us, stalled || needs_open_);
  watch_bus(now_us, before);
  gather_inputs(now_us);
  outputs_ = controller_.step(inputs_, now_us);
  diagnosis_.cycle_time_us = last_cycle_us;
  diagnosis_.rejected_frames = rejected(receiver_.total());
  ExcavatorTransmitter::Frames frames;
  const int count = transmitter_.frames(outputs_, diagnosis_, now_us, frames);
  send(frames, count);
  // Only now: opening may wait for the kernel, and the neutral frame must not wait for it.
  open_again(now_us, stalled);
}

}  // namespace graben::ecu
