#pragma once
/// What a source hears or makes, on its way to the pages: candump lines in blocks, in a ring of
/// fixed size. One producer, which never waits for a reader; any number of readers, each with a
/// place of its own. A reader that the ring has overtaken goes on with the newest block, and what
/// it missed is counted.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

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
  /// A quarter of a thousand blocks are ten seconds of flushes.
  explicit FrameFeed(std::size_t blocks_most = 250);

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

  /// Of this many bytes a block is handed over unasked, which bounds the ring's memory.
  static constexpr std::size_t kLargestBlockBytes = 64 * 1024;

 private:
  friend class FrameReader;

  std::function<void()> listener_;
  FrameBlock open_;  ///< The producer's alone.

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<const FrameBlock>> ring_;
  std::uint64_t blocks_ = 0;  ///< Handed over in all.
  std::uint64_t frames_ = 0;  ///< The same, in frames.
};

/// One reader's place. Begins behind what is there: with what comes next. For one thread; must not
/// outlive the feed.
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
  std::uint64_t frames_seen_;  ///< Or lost, or before it began.
  std::uint64_t lost_ = 0;
};

}  // namespace graben::scope
