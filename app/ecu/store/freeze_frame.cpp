// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/freeze_frame.hpp"

#include <algorithm>
#include <cmath>

#include "app/ecu/store/byte_order.hpp"

namespace graben::ecu {
namespace {

constexpr std::size_t kFixedBytes = 14;
constexpr std::size_t kSampleBytes =
    2 + 1 + 1 + 2 + 4 * (kSampleStrokes + kSamplePressures + kSampleDuties + 1);
static_assert(kFixedBytes + kFrameSamples * kSampleBytes <= kMostPayloadBytes, "or none is stored");

template <class Sample, class Each>
void for_each_number(Sample& sample, const Each& each) {
  for (auto& value : sample.stroke) {
    each(value);
  }
  for (auto& value : sample.pressure_pa) {
    each(value);
  }
  for (auto& value : sample.duty_ratio) {
    each(value);
  }
  each(sample.lambda);
}

}  // namespace

std::size_t write_frame(const StoredFrame& frame, std::uint8_t* payload) {
  ByteWriter to(payload, kMostPayloadBytes);
  to.u16(static_cast<std::uint16_t>(frame.fault));
  to.u8(static_cast<std::uint8_t>(frame.kind));
  to.u8(kSampleEvery);
  to.u32(frame.operation_s);
  to.u32(frame.unix_s);
  to.u16(static_cast<std::uint16_t>(frame.count));
  for (std::size_t i = 0; i < frame.count; ++i) {
    const CycleSample& sample = frame.sample[i];
    // A stall leaves samples that are older than this can say.
    const TimeUs ms = std::max<TimeUs>(sample.now_us / kMillisecondUs, INT16_MIN);
    to.u16(static_cast<std::uint16_t>(static_cast<std::int16_t>(std::min<TimeUs>(ms, INT16_MAX))));
    to.u8(static_cast<std::uint8_t>(sample.mode));
    to.u8(0);
    to.u16(sample.known);
    for_each_number(sample, [&](float value) { to.f32(value); });
  }
  return to.count();
}

bool read_frame(const std::uint8_t* payload, std::size_t length, StoredFrame& frame) {
  ByteReader from(payload, length);
  frame.fault = static_cast<Fault>(from.u16());
  const std::uint8_t kind = from.u8();
  frame.kind = static_cast<SampleKind>(kind);
  static_cast<void>(from.u8());
  frame.operation_s = from.u32();
  frame.unix_s = from.u32();
  frame.count = from.u16();
  if (!from.good() || frame.count > kFrameSamples ||
      kind > static_cast<std::uint8_t>(SampleKind::kDozer)) {
    return false;
  }
  bool finite = true;
  for (std::size_t i = 0; i < frame.count; ++i) {
    CycleSample& sample = frame.sample[i];
    sample.now_us = static_cast<std::int16_t>(from.u16()) * kMillisecondUs;
    sample.mode = static_cast<EcuMode>(from.u8());
    static_cast<void>(from.u8());
    sample.known = from.u16();
    for_each_number(sample, [&](float& value) {
      value = from.f32();
      finite = finite && std::isfinite(value);
    });
  }
  return from.good() && finite;
}

}  // namespace graben::ecu
