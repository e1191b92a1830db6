// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a source hears or makes, on its way to the pages: candump lines in blocks, the newest ten
/// minutes of them within a bound. One producer, which never waits for a reader; any number of
/// readers, each with a place of its own. A reader begins with the oldest block that is kept, so
/// that who comes late, or again, sees what was. One that falls behind what comes by more than some
/// seconds goes on with the newest, and what it missed is counted.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben::scope {

/// Some whole candump lines, each with its end.
struct FrameBlock {
  std::string text;
  std::uint64_t frames_before = 0;  ///< In all blocks before this one.
  std::uint32_t frames = 0;
  std::uint64_t sequence = 0;  ///< From 0.
};

/// How often a producer hands over what it has.
inline constexpr TimeUs kFlushPeriodUs = 40 * kMillisecondUs;

class FrameFeed {
 public:
  /// How far a reader may fall behind, in blocks (250 are ten seconds of flushes); how much is kept
  /// for those who come, in blocks (ten minutes of flushes) and bytes of text.
  struct Bounds {
    std::size_t lag_blocks = 250;
    std::size_t kept_blocks = 15000;
    std::size_t kept_bytes = std::size_t{48} * 1024 * 1024;
  };

  FrameFeed() : FrameFeed(Bounds{}) {}
  explicit FrameFeed(const Bounds& bounds);

  // ---- For the producer, from one thread.

  /// Adds a frame to the block that is being filled. The stamp is what the log shows. A block that
  /// has become large (kLargestBlockBytes) is handed over by itself.
  void append(const CanFrame& frame, TimeUs stamp_us, const std::string& interface_name);
  /// Hands over what was added since the last time; does nothing if that is nothing. To be called
  /// about every kFlushPeriodUs of real time.
  void flush();

  // ---- For any thread.

  /// Tells the listener that there is something to look at: after a flush by itself; a source
  /// calls it when its state has changed.
  void wake() const;
  /// Who is told, from the thread that calls flush() or wake(). To be set before there is one.
  void on_change(std::function<void()> listener) { listener_ = std::move(listener); }

  /// Of this many bytes a block is handed over unasked, which bounds what is sent at once.
  static constexpr std::size_t kLargestBlockBytes = 64 * 1024;

 private:
  friend class FrameReader;

  std::function<void()> listener_;
  FrameBlock open_;  ///< The producer's alone.

  mutable std::mutex mutex_;
  Bounds bounds_;
  std::deque<std::shared_ptr<const FrameBlock>> kept_;  ///< Oldest first.
  std::size_t kept_bytes_ = 0;
  std::uint64_t blocks_ = 0;  ///< Handed over in all.
  std::uint64_t frames_ = 0;  ///< The same, in frames.
};

/// One reader's place. Begins with the oldest that is kept. For one thread; must not outlive the
/// feed.
class FrameReader {
 public:
  explicit FrameReader(const FrameFeed& feed);

  /// The next block; none if there is no new one.
  [[nodiscard]] std::shared_ptr<const FrameBlock> next();
  /// Frames that this reader missed since it began.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  const FrameFeed* feed_;
  std::uint64_t sequence_;     ///< Of the block that is next.
  std::uint64_t began_;        ///< Of the first that came after it began.
  std::uint64_t frames_seen_;  ///< Or lost, or before it began.
  std::uint64_t lost_ = 0;
};

}  // namespace graben::scope
