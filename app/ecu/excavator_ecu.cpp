#include "app/ecu/excavator_ecu.hpp"

namespace graben::ecu {
namespace {
/// A cycle takes all that is pending, up to the capacity of any queue of ours; a 500 kbit/s bus
/// brings some 75 of the shortest frames in 10 ms.
constexpr int kFramesPerBatch = 96;
constexpr int kBatchesPerCycle = 4;
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
}  // namespace

ExcavatorEcu::ExcavatorEcu(const ExcavatorProfile& profile, std::uint32_t profile_hash,
                           CanPort& port)
    : port_(port), controller_(profile) {
  diagnosis_.profile_hash = profile_hash;
}

void ExcavatorEcu::receive(TimeUs now_us) {
  std::array<CanFrame, kFramesPerBatch> frames;
  for (int batch = 0; batch < kBatchesPerCycle; ++batch) {
    const int count = port_.receive(frames.data(), kFramesPerBatch);
    for (int i = 0; i < count; ++i) {
      receiver_.accept(frames[static_cast<unsigned>(i)], now_us);
    }
    if (count < kFramesPerBatch) {
      return;
    }
  }
}

void ExcavatorEcu::flush_after_stall(TimeUs now_us) {
  if (has_stepped_ && now_us - last_us_ > kStalled_us) {
    // A port that does not open again stays silent; the signals then time out.
    static_cast<void>(port_.open());
  }
  last_us_ = now_us;
  has_stepped_ = true;
}

void ExcavatorEcu::step(TimeUs now_us, TimeUs last_cycle_us) {
  flush_after_stall(now_us);
  receive(now_us);
  inputs_ = receiver_.inputs();
  inputs_.same_machine = same_machine(receiver_.identity(), diagnosis_.profile_hash);
  outputs_ = controller_.step(inputs_, now_us);
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
