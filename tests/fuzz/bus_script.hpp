// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controller's whole cycle on a bus that a script of bytes spoils: frames, time, the port.
///
/// A script is a row of steps, each a byte that says which and the bytes that it needs; what is
/// missing is 0. Between its steps a partner sends what a sound machine would (bus_partner.hpp).
/// After the script all is well again, and the controller has to become Active.
///
/// What is kept in tests/fuzz/corpus/fuzz_bus grows by, in build/fuzz: `tests/fuzz/libfuzz_bus
/// -merge=1 -use_counters=0 ../../tests/fuzz/corpus/fuzz_bus corpus/fuzz_bus`.

#include <algorithm>

#include "tests/fuzz/bus_run.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace graben::test {

inline constexpr int kMostCycles = 600;
inline constexpr int kLongestWait = 80;

enum class Step : std::uint8_t {
  kRun = 0,       ///< cycles: of 10 ms
  kFollow = 1,    ///< cycles: all is well, the operator leads to Active, so many cycles in it
  kOperator = 2,  ///< bits: enable, manual, task; upper five: speed
  kTime = 3,      ///< milliseconds, cycles: of that length
  kReplace = 4,   ///< message, mask, a byte for each of its bits: in every frame of it from here on
  kMute = 5,      ///< two bytes, a bit for each message
  kProtected = 6,  ///< message, counter skip and number, payload: frames beside the regular ones
  kRaw = 7,        ///< id (4), flags and length, data (8): any frame
  kOurs = 8,       ///< message, flags and length, data (8): the same with an id that is received
  kSpoil = 9,      ///< message, frames and masquerade, byte and its change
  kReplay = 10,    ///< number of frames
  kPort = 11,      ///< event, number
  kMend = 12,      ///< nothing more is spoilt
  kPush = 13,      ///< axis, speed: of a cylinder that nobody asked to move
  kFlood = 14,     ///< message or none, number: of frames with a wrong CRC
  kAgain = 15,     ///< as kRun
};
inline constexpr unsigned kSteps = 16;

class Script {
 public:
  Script(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  [[nodiscard]] bool ended() const { return at_ >= size_; }
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  dbc::Payload payload() {
    dbc::Payload bytes{};
    std::generate(bytes.begin(), bytes.end(), [this] { return byte(); });
    return bytes;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

template <class Kind>
class Player {
 public:
  Player(const std::uint8_t* data, std::size_t size) : script_(data, size), run_(Kind::shipped()) {}

  std::string play() {
    while (!script_.ended() && cycles_ < kMostCycles && wrong_.empty()) {
      step(static_cast<Step>(script_.byte() % kSteps));
    }
    return wrong_.empty() ? run_.recover() : wrong_;
  }

 private:
  void cycles(int count, TimeUs elapsed_us) {
    for (int n = 0; n < count && cycles_ < kMostCycles && wrong_.empty(); ++n) {
      ++cycles_;
      wrong_ = run_.cycle(elapsed_us);
    }
  }

  void mend() {
    run_.port.mend();
    run_.partner.mend();
  }

  void follow(int count) {
    mend();
    int active = 0;
    for (int n = 0; n < kLongestWait && active < count && wrong_.empty(); ++n) {
      run_.partner.lead_to_active();
      cycles(1, BusRun<Kind>::kPeriod_us);
      active += run_.is_active() ? 1 : 0;
    }
  }

  void set_operator() {
    const unsigned bits = script_.byte();
    run_.partner.hand = {(bits & 1U) != 0U, (bits & 2U) == 0U, (bits & 4U) != 0U,
                         1.0 - static_cast<double>(bits >> 3U) / 31.0};
  }

  void replace() {
    typename BusPartner<Kind>::Replacement& to =
        run_.partner.replaced[script_.byte() % kInputMessages];
    to.mask = script_.byte();
    for (unsigned i = 0; i < to.payload.size(); ++i) {
      to.payload[i] = ((to.mask >> i) & 1U) != 0U ? script_.byte() : std::uint8_t{0};
    }
  }

  void put_protected() {
    const unsigned message = script_.byte() % kInputMessages;
    const unsigned counts = script_.byte();
    const dbc::Payload payload = script_.payload();
    for (unsigned n = 0; n <= counts >> 5U; ++n) {
      run_.partner.put_protected(message, payload, static_cast<std::uint8_t>(counts & 0x0FU));
    }
  }

  void put_raw(std::uint32_t id) {
    const unsigned flags = script_.byte();
    CanFrame frame;
    frame.id = id;
    frame.extended = (flags & 0x10U) == 0U;
    frame.remote = (flags & 0x20U) != 0U;
    frame.error = (flags & 0x40U) != 0U;
    frame.fd = (flags & 0x80U) != 0U;
    frame.length = static_cast<std::uint8_t>(8U - (flags & 0x0FU) % 9U);
    frame.data = script_.payload();
    run_.port.put(frame);
  }

  void put_any() {
    std::uint32_t id = 0;
    for (int n = 0; n < 4; ++n) {
      id = (id << 8U) | script_.byte();
    }
    put_raw(id & 0x1FFFFFFFU);
  }

  void spoil() {
    typename BusPartner<Kind>::Spoil& to = run_.partner.spoilt[script_.byte() % kInputMessages];
    const unsigned counts = script_.byte();
    to = {static_cast<int>(counts & 0x7FU), script_.byte(), script_.byte(), counts >= 0x80U};
  }

  void port_event() {
    const unsigned event = script_.byte();
    const auto state = static_cast<CanPortState>((event >> 4U) % 5U);
    ScriptedPort& port = run_.port;
    switch (event % 8U) {
      case 0:
        port.shown = state;
        break;
      case 1:
        port.next_shown = state;
        break;
      case 2:
        port.opens = (event & 0x10U) != 0U;
        break;
      case 3:
        port.refuses_all = (event & 0x10U) == 0U;
        break;
      default:
        port.refuses = script_.byte();
    }
  }

  void flood() {
    const unsigned message = script_.byte() % (kInputMessages + 1);
    CanFrame frame;
    frame.length = 8;
    frame.id = message < kInputMessages ? input_message<Kind>(message).id : 0U;
    for (int n = script_.byte(); n > 0; --n) {
      run_.port.put(frame);
    }
  }

  void step(Step step) {
    switch (step) {
      case Step::kRun:
      case Step::kAgain:
        cycles(1 + script_.byte() % 64, BusRun<Kind>::kPeriod_us);
        break;
      case Step::kFollow:
        follow(1 + script_.byte() % 64);
        break;
      case Step::kOperator:
        set_operator();
        break;
      case Step::kTime: {
        const TimeUs elapsed_us = script_.byte() % 101 * kMillisecondUs;
        cycles(1 + script_.byte() % 8, elapsed_us);
        break;
      }
      case Step::kReplace:
        replace();
        break;
      case Step::kMute:
        run_.partner.muted = script_.byte();
        run_.partner.muted =
            static_cast<std::uint16_t>(run_.partner.muted | (script_.byte() % 8U) << 8U);
        break;
      case Step::kProtected:
        put_protected();
        break;
      case Step::kRaw:
        put_any();
        break;
      case Step::kOurs:
        put_raw(input_message<Kind>(script_.byte()).id);
        break;
      case Step::kSpoil:
        spoil();
        break;
      case Step::kReplay:
        run_.partner.replay(script_.byte() % 65U);
        break;
      case Step::kPort:
        port_event();
        break;
      case Step::kMend:
        mend();
        break;
      case Step::kPush:
        run_.partner.body.pushed_mps[script_.byte() % Kind::kPushed] =
            static_cast<double>(static_cast<std::int8_t>(script_.byte())) / 100.0;
        break;
      case Step::kFlood:
        flood();
        break;
    }
  }

  Script script_;
  BusRun<Kind> run_;
  int cycles_ = 0;
  std::string wrong_;
};

template <class Kind>
std::string play(const std::uint8_t* data, std::size_t size) {
  static std::uint64_t& scripts = tally("scripts");
  ++scripts;
  return Player<Kind>(data, size).play();
}

inline std::vector<Bytes> script_seeds() {
  const auto byte = [](Step step) { return static_cast<std::uint8_t>(step); };
  const std::uint8_t follow = byte(Step::kFollow);
  const std::uint8_t run = byte(Step::kRun);
  const auto active_then = [&](std::initializer_list<std::uint8_t> steps) {
    Bytes bytes{follow, 20};
    bytes.insert(bytes.end(), steps);
    bytes.insert(bytes.end(), {run, 20});
    return bytes;
  };
  return {
      {follow, 60},
      active_then({byte(Step::kOperator), 4, run, 10, byte(Step::kOperator), 5}),
      active_then(
          {byte(Step::kTime), 60, 0, run, 5, byte(Step::kTime), 16, 3, byte(Step::kTime), 5, 3}),
      active_then({byte(Step::kReplace), 0, 4, 0x40, run, 3, byte(Step::kReplace), 8, 0, run, 3}),
      active_then({byte(Step::kReplace), 10, 0x0C, 0, 0x90, run, 8}),
      active_then({byte(Step::kMute), 1, 0, run, 8, byte(Step::kMute), 0, 1, run, 8}),
      active_then(
          {byte(Step::kProtected), 0, 0x22, 0xFF, 0xFF, 0x00, 0x50, 0xFF, 0xFF, 0xFF, 0xFF}),
      active_then({byte(Step::kRaw), 0x0C, 0xFF, 0x20, 0x80, 0x20, 1, 2, 3, 4, 5, 6, 7, 8}),
      active_then({byte(Step::kOurs), 9, 0, 1, 2, 3, 4, 2, 0xFF, 0xFF, 0xFF, run, 5}),
      active_then({byte(Step::kSpoil), 8, 2, 3, 1, run, 5, byte(Step::kSpoil), 0, 0x83, 2, 0}),
      active_then({byte(Step::kReplay), 30, run, 2, byte(Step::kReplay), 9}),
      active_then(
          {byte(Step::kPort), 0x30, run, 4, byte(Step::kPort), 0x12, byte(Step::kPort), 4, 3}),
      active_then({byte(Step::kPort), 0x21, run, 4, byte(Step::kMend)}),
      active_then({byte(Step::kPush), 1, 60, run, 30, byte(Step::kMend)}),
      active_then({byte(Step::kFlood), 11, 255, run, 2, byte(Step::kFlood), 3, 4}),
  };
}

}  // namespace graben::test
