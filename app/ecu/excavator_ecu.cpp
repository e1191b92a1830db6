#include "app/ecu/excavator_ecu.hpp"

namespace graben::ecu {
namespace {
/// More frames than a 500 kbit/s bus can carry in 10 ms (some 75 of the shortest): a cycle takes
/// what one cycle can bring, never more.
constexpr int kFramesPerCycle = 96;
}  // namespace

ExcavatorEcu::ExcavatorEcu(const ExcavatorProfile& profile, std::uint32_t profile_hash,
                           CanPort& port)
    : port_(port), controller_(profile) {
  diagnosis_.profile_hash = profile_hash;
}

void ExcavatorEcu::receive(TimeUs now_us) {
  std::array<CanFrame, kFramesPerCycle> frames;
  const int count = port_.receive(frames.data(), kFramesPerCycle);
  for (int i = 0; i < count; ++i) {
    receiver_.accept(frames[static_cast<unsigned>(i)], now_us);
  }
}

void ExcavatorEcu::step(TimeUs now_us, TimeUs last_cycle_us) {
  receive(now_us);
  outputs_ = controller_.step(receiver_.inputs(), now_us);
  diagnosis_.cycle_time_us = last_cycle_us;
  diagnosis_.rejected_frames = rejected(receiver_.total());
  ExcavatorTransmitter::Frames frames;
  const int count = transmitter_.frames(outputs_, diagnosis_, now_us, frames);
  for (int i = 0; i < count; ++i) {
    if (!port_.send(frames[static_cast<unsigned>(i)])) {
      ++dropped_;
    }
  }
}

}  // namespace graben::ecu
