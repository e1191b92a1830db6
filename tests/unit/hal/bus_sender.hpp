// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A transmitter with everything that one call needs, and what it has sent.

#include <algorithm>
#include <limits>

#include "firmware/numeric/constants.hpp"
#include "hal/buses/dozer_bus.hpp"
#include "hal/buses/excavator_bus.hpp"
#include "hal/link/e2e.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

inline constexpr TimeUs kStartUs = 3'000'000;
inline constexpr TimeUs kPeriodUs = 10'000;
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Transmitter>
struct Sender {
  Transmitter transmitter;
  typename Transmitter::Outputs outputs;
  EcuDiagnosis diagnosis;
  typename Transmitter::Frames out{};
  int count = 0;

  void call(TimeUs now) { count = transmitter.frames(outputs, diagnosis, now, out); }
  // So many cycles from this time on.
  void cycles(int many, TimeUs from = kStartUs) {
    for (int n = 0; n < many; ++n) {
      call(from + n * kPeriodUs);
    }
  }

  template <class Message>
  const CanFrame* find() const {
    for (int i = 0; i < count; ++i) {
      if (out[static_cast<std::size_t>(i)].id == Message::kId) {
        return &out[static_cast<std::size_t>(i)];
      }
    }
    return nullptr;
  }

  template <class Message>
  Message sent() const {
    const CanFrame* frame = find<Message>();
    assert_non_null(frame);
    return Message::decode(frame->data);
  }
};

// How often each of `Messages` was sent in 10 s, and the most frames at once; exact, or with a
// scheduler that is up to `jitter_us` early or late.
template <class Transmitter, class... Messages>
std::array<int, sizeof...(Messages) + 1> sent_in_10_s(TimeUs jitter_us) {
  Sender<Transmitter> sender;
  std::array<int, sizeof...(Messages) + 1> tally{};
  for (int cycle = 0; cycle < 1000; ++cycle) {
    const TimeUs deviation_us = cycle == 0 ? 0 : (cycle % 3 - 1) * jitter_us;
    sender.call(kStartUs + cycle * kPeriodUs + deviation_us);
    std::size_t i = 0;
    ((tally[i++] += sender.template find<Messages>() != nullptr ? 1 : 0), ...);
    tally.back() = std::max(tally.back(), sender.count);
  }
  return tally;
}

// A receiver must accept every frame of the message after its three of synchronisation.
template <class Transmitter, class Message>
void check_protection() {
  constexpr int kCycles = Message::kCycleTimeMs * kMillisecondUs / kPeriodUs;
  Sender<Transmitter> sender;
  const E2eConfig config{Message::kDataId, 1, 4 * kCycles * kPeriodUs, kCycles * kPeriodUs};
  E2eState state;
  for (int cycle = 0; cycle < 100; ++cycle) {
    const TimeUs now = kStartUs + cycle * kPeriodUs;
    sender.call(now);
    const CanFrame* frame = sender.template find<Message>();
    assert_int_equal(frame != nullptr, cycle % kCycles == 0);
    if (frame != nullptr) {
      assert_int_equal(frame->data[1] & 0xF, cycle / kCycles % 15);
      const E2eCheck check = e2e_check(config, state, frame->data, now);
      assert_int_equal(check, cycle < 2 * kCycles ? E2eCheck::kSynchronising : E2eCheck::kOk);
    }
  }
}

// The cut is asked for with and without enable, and nothing else asks for it.
template <class Transmitter, class SpoolCommand>
void check_pilot_cut() {
  Sender<Transmitter> unknown;
  unknown.outputs.pilot_cut = true;
  unknown.call(kStartUs);
  assert_int_equal(unknown.template sent<SpoolCommand>().pilot_cut.state,
                   dbc::RawState::kNotAvailable);
  for (const bool enable : {false, true}) {
    for (const bool cut : {false, true}) {
      Sender<Transmitter> sender;
      sender.outputs.enable = enable;
      sender.outputs.pilot_cut = cut;
      sender.outputs.pilot_known = true;
      sender.call(kStartUs);
      const auto command = sender.template sent<SpoolCommand>();
      assert_int_equal(command.pilot_cut.state, dbc::RawState::kValid);
      assert_int_equal(command.pilot_cut.value == SpoolCommand::PilotCut::kOn, cut);
      assert_int_equal(command.enable.value == SpoolCommand::Enable::kOn, enable);
    }
  }
}

}  // namespace graben::test
