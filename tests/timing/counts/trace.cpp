// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/counts/trace.hpp"

namespace graben::timing {
namespace {

constexpr std::uint32_t kMark = 0x54435247;  // "GRCT"
constexpr unsigned kByte = 8;
constexpr std::uint64_t kExtended = 1U << 29U;
constexpr std::uint64_t kRemote = 1U << 30U;
constexpr std::uint64_t kError = 1U << 31U;
constexpr std::uint8_t kFd = 0x80;

bool put(std::FILE* file, std::uint64_t value, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) {
    if (std::fputc(static_cast<int>((value >> (kByte * i)) & 0xFFU), file) == EOF) {
      return false;
    }
  }
  return true;
}

template <class Number>
bool get(std::FILE* file, unsigned bytes, Number& value) {
  std::uint64_t sum = 0;
  for (unsigned i = 0; i < bytes; ++i) {
    const int byte = std::fgetc(file);
    if (byte == EOF) {
      return false;
    }
    sum |= static_cast<std::uint64_t>(byte) << (kByte * i);
  }
  value = static_cast<Number>(sum);
  return true;
}

bool put_frame(std::FILE* file, const CanFrame& frame) {
  const std::uint64_t id = frame.id | (frame.extended ? kExtended : 0U) |
                           (frame.remote ? kRemote : 0U) | (frame.error ? kError : 0U);
  return put(file, id, 4) && put(file, frame.length | (frame.fd ? kFd : 0U), 1) &&
         std::fwrite(frame.data.data(), 1, frame.data.size(), file) == frame.data.size();
}

bool get_frame(std::FILE* file, CanFrame& frame) {
  std::uint32_t id = 0;
  unsigned length = 0;
  if (!get(file, 4, id) || !get(file, 1, length)) {
    return false;
  }
  frame.id = id & (kExtended - 1U);
  frame.extended = (id & kExtended) != 0U;
  frame.remote = (id & kRemote) != 0U;
  frame.error = (id & kError) != 0U;
  frame.fd = (length & kFd) != 0U;
  frame.length = static_cast<std::uint8_t>(length & (kFd - 1U));
  return std::fread(frame.data.data(), 1, frame.data.size(), file) == frame.data.size();
}

/// A count that has to fit.
bool get_count(std::FILE* file, unsigned bytes, int most, int& count) {
  return get(file, bytes, count) && count <= most;
}

bool put_answers(std::FILE* file, const TraceCycle& cycle) {
  bool written = put(file, static_cast<std::uint64_t>(cycle.states), 1);
  for (unsigned i = 0; i < static_cast<unsigned>(cycle.states); ++i) {
    written = written && put(file, static_cast<std::uint64_t>(cycle.state[i]), 1);
  }
  written = written && put(file, static_cast<std::uint64_t>(cycle.opens), 1);
  for (unsigned i = 0; i < static_cast<unsigned>(cycle.opens); ++i) {
    written = written && put(file, cycle.opened[i] ? 1U : 0U, 1);
  }
  return written;
}

bool get_answers(std::FILE* file, TraceCycle& cycle) {
  bool there = get_count(file, 1, TraceCycle::kMostAnswers, cycle.states);
  for (unsigned i = 0; there && i < static_cast<unsigned>(cycle.states); ++i) {
    there = get(file, 1, cycle.state[i]);
  }
  there = there && get_count(file, 1, TraceCycle::kMostAnswers, cycle.opens);
  for (unsigned i = 0; there && i < static_cast<unsigned>(cycle.opens); ++i) {
    there = get(file, 1, cycle.opened[i]);
  }
  return there;
}

}  // namespace

bool write(std::FILE* file, const TraceStart& start) {
  return put(file, kMark, 4) && put(file, static_cast<std::uint64_t>(start.setup), 1) &&
         put(file, start.profile_hash, 4) && put(file, start.cycles, 4);
}

bool read(std::FILE* file, TraceStart& start) {
  std::uint32_t mark = 0;
  unsigned setup = 0;
  const bool there = get(file, 4, mark) && mark == kMark && get(file, 1, setup) &&
                     setup < kSetups && get(file, 4, start.profile_hash) &&
                     get(file, 4, start.cycles);
  start.setup = static_cast<Setup>(setup);
  return there;
}

bool write(std::FILE* file, const TraceCycle& cycle) {
  bool written = put(file, static_cast<std::uint64_t>(cycle.now_us), 8) &&
                 put_answers(file, cycle) && put(file, cycle.refused, 4) &&
                 put(file, static_cast<std::uint64_t>(cycle.frames), 2);
  for (unsigned i = 0; i < static_cast<unsigned>(cycle.frames); ++i) {
    written = written && put_frame(file, cycle.frame[i]);
  }
  return written && put(file, cycle.mode, 1);
}

bool read(std::FILE* file, TraceCycle& cycle) {
  bool there = get(file, 8, cycle.now_us) && get_answers(file, cycle) &&
               get(file, 4, cycle.refused) &&
               get_count(file, 2, TraceCycle::kMostFrames, cycle.frames);
  for (unsigned i = 0; there && i < static_cast<unsigned>(cycle.frames); ++i) {
    there = get_frame(file, cycle.frame[i]);
  }
  return there && get(file, 1, cycle.mode);
}

}  // namespace graben::timing
