// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A tool on a J1939 bus, written from the public layouts (J1939-21: ids, TP.CM, TP.DT,
/// acknowledgment; J1939-73: lamps and trouble codes) and from nothing of ours: what it makes of
/// frames is what another maker's would. It fails where a sender breaks a rule.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "hal/can_frame.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

class J1939Reader {
 public:
  struct Code {
    std::uint32_t spn;
    unsigned fmi, method, count;
  };
  /// A message that is whole, of one frame or of many.
  struct Message {
    std::uint32_t pgn;
    unsigned sender, receiver;
    long long at_us;
    std::vector<unsigned> bytes;
    std::size_t packets = 0;  ///< 0: a frame of its own.

    [[nodiscard]] unsigned lamp(unsigned number) const { return bytes[0] >> 2U * number & 3U; }
    [[nodiscard]] bool protect() const { return lamp(0) == 1; }
    [[nodiscard]] bool amber() const { return lamp(1) == 1; }
    [[nodiscard]] bool red() const { return lamp(2) == 1; }
    /// Trouble codes of DM1 and DM2; four bytes of 0 are none.
    [[nodiscard]] std::vector<Code> codes() const {
      std::vector<Code> all;
      for (std::size_t at = 2; at + 4 <= bytes.size(); at += 4) {
        const unsigned third = bytes[at + 2];
        const unsigned fourth = bytes[at + 3];
        const Code code{bytes[at] | bytes[at + 1] << 8U | third / 32U << 16U, third % 32U,
                        fourth / 128U, fourth % 128U};
        // One code is followed by two bytes of 0xFF, which are none.
        if (code.spn != 0 || code.fmi != 0) {
          all.push_back(code);
        }
      }
      return all;
    }
  };

  void hear(const CanFrame& frame) {
    assert_true(frame.extended && !frame.remote && frame.length == 8);
    const unsigned format = frame.id / 0x10000U % 0x100U;
    const unsigned specific = frame.id / 0x100U % 0x100U;
    const unsigned page = frame.id / 0x1000000U % 4U;
    const unsigned sender = frame.id % 0x100U;
    const bool is_pdu1 = format < 240;
    const std::uint32_t pgn = page * 0x10000U + format * 0x100U + (is_pdu1 ? 0 : specific);
    const unsigned receiver = is_pdu1 ? specific : 255U;
    std::vector<unsigned> bytes(frame.data.begin(), frame.data.end());
    ++frames;
    if (pgn == 60416 || pgn == 60160) {
      // As the plan of the bus has it: 50 ms apart, and so 20 in any second.
      assert_true(frame.stamp_us - transport_us_ >= 50'000);
      transport_us_ = frame.stamp_us;
    }
    if (pgn == 60416) {
      assert_int_equal(frame.id / 0x4000000U, 7);
      connection({pgn, sender, receiver, frame.stamp_us, bytes});
    } else if (pgn == 60160) {
      assert_int_equal(frame.id / 0x4000000U, 7);
      packet({pgn, sender, receiver, frame.stamp_us, bytes});
    } else {
      messages.push_back({pgn, sender, receiver, frame.stamp_us, bytes});
    }
  }

  /// Those of a group, in their order.
  [[nodiscard]] std::vector<Message> of(std::uint32_t pgn) const {
    std::vector<Message> all;
    for (const Message& one : messages) {
      if (one.pgn == pgn) {
        all.push_back(one);
      }
    }
    return all;
  }

  std::vector<Message> messages;
  std::vector<Message> controls;  ///< TP.CM but announcements.
  std::size_t frames = 0;
  long long most_gap_us = 0;  ///< Between packets to one receiver.

 private:
  struct Session {
    std::uint32_t pgn = 0;
    std::size_t size = 0, packets = 0, next = 1;
    long long at_us = 0;
    std::vector<unsigned> bytes;
  };

  void connection(const Message& told) {
    const std::vector<unsigned>& b = told.bytes;
    if (b[0] != 16 && b[0] != 32) {
      controls.push_back(told);
      return;
    }
    Session begun;
    begun.pgn = b[5] + b[6] * 0x100U + b[7] * 0x10000U;
    begun.size = b[1] + b[2] * 0x100U;
    begun.packets = b[3];
    begun.at_us = told.at_us;
    assert_true(begun.size > 8 && begun.size <= 1785);
    assert_int_equal(begun.packets, (begun.size + 6) / 7);
    assert_int_equal(b[4], 255);
    assert_int_equal(b[0] == 32, told.receiver == 255);
    // A sender has one announcement at a time.
    assert_true(sessions_.count(told.receiver) == 0);
    sessions_[told.receiver] = begun;
    if (b[0] == 16) {
      controls.push_back(told);
    }
  }

  void packet(const Message& told) {
    assert_int_equal(sessions_.count(told.receiver), 1);
    Session& of = sessions_[told.receiver];
    assert_int_equal(told.bytes[0], of.next);
    if (told.receiver == 255) {
      const long long gap_us = told.at_us - of.at_us;
      assert_true(gap_us >= 50'000 && gap_us <= 200'000);
    }
    if (told.receiver != 255 && of.next > 1) {
      most_gap_us = std::max(most_gap_us, told.at_us - of.at_us);
    }
    of.at_us = told.at_us;
    for (std::size_t i = 1; i < 8; ++i) {
      if (of.bytes.size() < of.size) {
        of.bytes.push_back(told.bytes[i]);
      } else {
        assert_int_equal(told.bytes[i], 255);
      }
    }
    if (of.next++ == of.packets) {
      messages.push_back({of.pgn, told.sender, told.receiver, told.at_us, of.bytes, of.packets});
      sessions_.erase(told.receiver);
    }
  }

  long long transport_us_ = -1'000'000;
  std::map<unsigned, Session> sessions_;  ///< By receiver.
};

}  // namespace graben::test
