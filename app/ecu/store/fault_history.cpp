// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/store/fault_history.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "app/ecu/store/byte_order.hpp"

namespace graben::ecu {
namespace {
constexpr std::size_t kFixedBytes = 20;
constexpr std::size_t kEntryBytes = 26;
constexpr std::size_t kLearntBytes = 2 + 4 * LearntRecord::kMost;
constexpr std::size_t kSiteBytes = 4;
static_assert(kFixedBytes + (FaultSet::kNumbers - 1) * kEntryBytes + kLearntBytes + kSiteBytes <=
                  kMostPayloadBytes,
              "or some fault has no room");
}  // namespace

int FaultHistory::stored() const {
  int count = 0;
  for (const FaultEntry& one : entry) {
    count += one.occurrences > 0 ? 1 : 0;
  }
  return count;
}

void FaultHistory::add(Fault fault, std::uint32_t at_s, std::uint32_t at_unix_s) {
  FaultEntry& one = of(fault);
  if (one.occurrences == 0) {
    one.first_s = at_s;
    one.first_unix_s = at_unix_s;
  }
  one.occurrences += one.occurrences < UINT32_MAX ? 1U : 0U;
  one.last_s = at_s;
  one.last_unix_s = at_unix_s;
  one.last_cycle = power_cycles;
}

void FaultHistory::follow(const FaultHistory& found, const FaultSet& cleared) {
  operation_s = found.operation_s;
  power_cycles = found.power_cycles;
  boot = found.boot;
  tokens = found.tokens;
  lost = found.lost;
  learnt = learnt.count > 0 ? learnt : found.learnt;
  left_site = left_site != 0 ? left_site : found.left_site;
  for (int number = 1; number < kFaultCount; ++number) {
    const auto fault = static_cast<Fault>(number);
    FaultEntry& own = of(fault);
    const FaultEntry before = cleared.has(fault) ? FaultEntry{} : found.of(fault);
    if (own.occurrences == 0) {
      own = before;
      continue;
    }
    own.last_cycle = found.power_cycles;
    own.last_s += found.operation_s;
    own.first_s = before.occurrences > 0 ? before.first_s : own.first_s + found.operation_s;
    own.first_unix_s = before.occurrences > 0 ? before.first_unix_s : own.first_unix_s;
    own.occurrences = before.occurrences > UINT32_MAX - own.occurrences
                          ? UINT32_MAX
                          : before.occurrences + own.occurrences;
  }
}

std::size_t write_history(const FaultHistory& history, std::uint8_t* payload) {
  ByteWriter to(payload, kMostPayloadBytes);
  to.u32(history.operation_s);
  to.u32(history.power_cycles);
  to.u32(history.boot);
  to.u16(history.tokens);
  to.u32(history.lost);
  to.u16(static_cast<std::uint16_t>(history.stored()));
  for (std::size_t i = 0; i < history.entry.size(); ++i) {
    const FaultEntry& one = history.entry[i];
    if (one.occurrences == 0) {
      continue;
    }
    to.u16(static_cast<std::uint16_t>(i));
    to.u32(one.occurrences);
    to.u32(one.first_s);
    to.u32(one.last_s);
    to.u32(one.first_unix_s);
    to.u32(one.last_unix_s);
    to.u32(one.last_cycle);
  }
  write_learnt(history.learnt, to);
  to.u32(history.left_site);
  return to.count();
}

bool read_history(const std::uint8_t* payload, std::size_t length, FaultHistory& history) {
  ByteReader from(payload, length);
  history = {};
  history.operation_s = from.u32();
  history.power_cycles = from.u32();
  history.boot = from.u32();
  history.tokens = from.u16();
  history.lost = from.u32();
  const int count = from.u16();
  for (int i = 0; i < count && from.good(); ++i) {
    const std::uint16_t number = from.u16();
    FaultEntry one;
    one.occurrences = from.u32();
    one.first_s = from.u32();
    one.last_s = from.u32();
    one.first_unix_s = from.u32();
    one.last_unix_s = from.u32();
    one.last_cycle = from.u32();
    // A later version may have more faults.
    if (number > 0 && number < kFaultCount) {
      history.entry[number] = one;
    }
  }
  // An earlier version ends here, or after that.
  history.learnt = from.left() > 0 ? read_learnt(from) : LearntRecord{};
  history.left_site = from.left() > 0 ? from.u32() : 0;
  return from.good();
}

std::uint32_t boot_mark() {
  const int file = ::open("/proc/sys/kernel/random/boot_id", O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return 0;
  }
  std::array<std::uint8_t, 64> text{};
  const ssize_t count = ::read(file, text.data(), text.size());
  ::close(file);
  return count > 0 ? crc32(text.data(), static_cast<std::size_t>(count)) : 0;
}

}  // namespace graben::ecu
