// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Another bus than ours as a table: which signal of which message goes where, which command comes
/// from where, and what protects each. A bus profile (app/machines/buses) is read into one.
///
///   value = (raw as a number) * scale + offset, in the SI unit of its place
///
/// Everything has a fixed size; the table is constant once it is read. Its reader has seen to it
/// that indices, bits and counts are within it.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_rules.hpp"

namespace graben {

inline constexpr std::size_t kMostTableReceived = 16;
inline constexpr std::size_t kMostTableSources = 64;
inline constexpr std::size_t kMostTableSent = 8;
inline constexpr std::size_t kMostTableSinks = 40;
inline constexpr std::size_t kMostTableNodes = 12;

/// Where a signal lies. Motorola: `start_bit` is that of the highest bit, as a DBC counts them.
struct BitField {
  std::uint8_t start_bit = 0;
  std::uint8_t width = 0;  ///< 1 .. 32.
  bool motorola = false;
  bool is_signed = false;
};

/// The bits' number; and the payload with the low `width` bits of `raw` in their place.
[[nodiscard]] std::int64_t raw_of(const BitField& field, const std::array<std::uint8_t, 8>& data);
void put_raw(const BitField& field, std::int64_t raw, std::array<std::uint8_t, 8>& data);
/// True if all bits are among the first `length` bytes.
[[nodiscard]] bool lies_within(const BitField& field, unsigned length);

/// How frames of a message are told from old or foreign ones.
enum class TableProtection : std::uint8_t {
  kNone = 0,     ///< Kind, length, range, rate and pace.
  kCounter = 1,  ///< And a counter that goes on with every frame.
  kE2e = 2,      ///< CRC and counter as our own (hal/link/e2e.hpp).
};

/// What a received value is; each counts drives or pumps by `index`.
enum class SourcePlace : std::uint8_t {
  kStroke = 0,       ///< m, of an axis.
  kJointAngle = 1,   ///< rad, of an axis, as excavator_profile.hpp counts them.
  kCapPressure = 2,  ///< Pa, of an axis.
  kRodPressure = 3,
  kSpool = 4,        ///< Share of the travel, -1 .. 1, of an axis.
  kSlope = 5,        ///< rad against the horizontal, of a link or the platform (SlopeLink).
  kSwash = 6,        ///< Share of full, of a pump.
  kEngineSpeed = 7,  ///< rad/s.
  kCondition = 8,    ///< The valve side acts on our enable only where all of these hold.
  kMerit = 9,        ///< Within its range the sender trusts what else is in its message.
  /// Most share of full speed that somebody outside leaves; at 0 and below the machine stops until
  /// the operator arms again.
  kSpeedLimit = 10,
};

/// What has a slope. The links are counted as the axes.
enum SlopeLink : std::uint8_t { kBoomSlope = 0, kArmSlope = 1, kBucketSlope = 2, kBodySlope = 3 };
inline constexpr std::size_t kSlopeCount = 4;

/// What a sent value is.
enum class SinkPlace : std::uint8_t {
  kConstant = 0,  ///< `offset`, whatever else is.
  kEnable = 1,    ///< 1 where the duties count, else 0.
  kPilotCut = 2,  ///< 1 where the pilot pressure is to be cut, else 0.
  kDuty = 3,      ///< -1 .. 1, of an axis.
  kExtend = 4,    ///< 0 .. 1, as far as the duty extends.
  kRetract = 5,   ///< 0 .. 1, as far as it retracts.
  kSwash = 6,     ///< Share of full, of a pump.
  kFlow = 7,      ///< 0 .. 1, as far as the duty goes, either way.
  kSide = 8,      ///< Which way: 0 neither, 1 it extends, 2 it retracts.
};

inline constexpr std::int64_t kNoSpecial = -1;
inline constexpr std::uint8_t kNoNode = 0xFF;
inline constexpr int kMostNodeId = 127;

/// A node of CANopen whose messages count only while it says that it is operational.
struct TableNode {
  std::uint8_t id = 0;
  std::uint8_t bus = kAnyBus;
  TimeUs timeout_us = 0;  ///< Of its heartbeat.
};

/// A signal that is received.
struct TableSource {
  BitField bits;
  SourcePlace place = SourcePlace::kStroke;
  std::uint8_t index = 0;
  bool adds = false;  ///< To what an earlier signal of its message has put into the same place.
  double scale = 1.0;
  double offset = 0.0;
  double least = 0.0;  ///< Allowed; of a condition, where it holds.
  double most = 0.0;
  double rate_ps = 0.0;  ///< It can't change faster; 0: not judged.
  std::int64_t error_raw = kNoSpecial;
  std::int64_t missing_raw = kNoSpecial;  ///< 'Not available'.
};

/// A message that is received; its rule for admission stands beside it.
struct TableMessage {
  std::uint8_t bus = kAnyBus;  ///< Which of several it has to come on.
  TableProtection protection = TableProtection::kNone;
  BitField counter;
  std::uint8_t most_steps = 1;  ///< That the counter may go on between two frames.
  TimeUs period_us = 0;
  TimeUs timeout_us = 0;  ///< Silent for longer, its signals are 'not available'.
  bool slow = false;  ///< Its signals count as fresh up to there, as old as the core may find them.
  std::uint8_t node = kNoNode;  ///< Of the table's nodes, the one that sends it.
  std::uint8_t first = 0;       ///< Its signals among the sources.
  std::uint8_t count = 0;
};

/// A signal that is sent.
struct TableSink {
  BitField bits;
  SinkPlace place = SinkPlace::kConstant;
  std::uint8_t index = 0;
  double scale = 1.0;
  double offset = 0.0;
  double least = 0.0;  ///< Of an extend, retract or flow: what any that is not 0 begins at.
};

/// A message that is sent.
struct TableSend {
  SendRule rule;
  bool extended = true;
  std::uint8_t length = 8;
  std::uint8_t bus = kAnyBus;
  TableProtection protection = TableProtection::kNone;
  BitField counter;
  std::uint8_t fill = 0;    ///< Of bytes where no signal is.
  bool commands = false;    ///< It moves metal: a lost one leaves the machine without a command.
  bool has_enable = false;  ///< Sent at once where enable changes, beside its period.
  std::uint8_t first = 0;   ///< Its signals among the sinks.
  std::uint8_t count = 0;
};

struct BusTable {
  std::array<MessageRule, kMostTableReceived> rule{};
  std::array<TableMessage, kMostTableReceived> message{};
  std::size_t message_count = 0;
  std::array<TableSource, kMostTableSources> source{};
  std::size_t source_count = 0;
  std::array<TableSend, kMostTableSent> send{};
  std::size_t send_count = 0;
  std::array<TableSink, kMostTableSinks> sink{};
  std::size_t sink_count = 0;
  std::array<TableNode, kMostTableNodes> node{};
  std::size_t node_count = 0;
  bool own_frames = false;      ///< The machine's end speaks our DBC beside it.
  bool has_engine = false;      ///< A source is the engine's speed.
  bool has_slopes = false;      ///< Sources are the links' slopes, of which joint angles are made.
  bool has_body_slope = false;  ///< And the platform's; without it, it counts as level.
  bool has_cut = false;         ///< A sink is the pilot cut.
  std::uint8_t bus_count = 0;   ///< Of buses that its messages are told apart by; 0: any number.

  [[nodiscard]] constexpr bool empty() const { return message_count + send_count == 0; }
};

/// `parts` of a machine on the bus that the table says; null or empty: on ours alone.
[[nodiscard]] BusParts with_table(BusParts parts, const BusTable* table);

/// In a port's list of ids: one of 11 bits.
inline constexpr std::uint32_t kStandardId = 0x80000000U;

using TableIds =
    std::array<std::uint32_t, kMostTableReceived + kMostTableSent + 2 * kMostTableNodes>;

/// The ids of a table's frames, received, sent, and its nodes' heartbeats and emergencies, for a
/// port's filters; 0 where there is none.
[[nodiscard]] TableIds table_ids(const BusTable& table);

}  // namespace graben
