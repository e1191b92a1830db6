#include "app/scope/server/frame_feed.hpp"

#include <utility>

#include "platform/loopback/candump_log.hpp"

namespace graben::scope {

FrameFeed::FrameFeed(std::size_t blocks_most) : ring_(blocks_most) {}

void FrameFeed::append(const CanFrame& frame, TimeUs stamp_us, const std::string& interface_name) {
  open_.text += candump_line(frame, stamp_us, interface_name);
  open_.text += '\n';
  ++open_.frames;
  if (open_.text.size() >= kLargestBlockBytes) {
    flush();
  }
}

void FrameFeed::flush() {
  if (open_.frames == 0) {
    return;
  }
  const std::size_t size = open_.text.size();
  // Taken out of the ring under the lock, given back to the heap after it.
  std::shared_ptr<const FrameBlock> oldest;
  {
    const std::lock_guard lock(mutex_);
    open_.sequence = blocks_;
    open_.frames_before = frames_;
    frames_ += open_.frames;
    oldest = std::exchange(ring_[blocks_ % ring_.size()],
                           std::make_shared<const FrameBlock>(std::move(open_)));
    ++blocks_;
  }
  open_ = FrameBlock{};
  // The next one will be about as long.
  open_.text.reserve(size + size / 8);
  wake();
}

void FrameFeed::wake() const {
  if (listener_) {
    listener_();
  }
}

FrameReader::FrameReader(const FrameFeed& feed) : feed_(&feed) {
  const std::lock_guard lock(feed.mutex_);
  sequence_ = feed.blocks_;
  frames_seen_ = feed.frames_;
}

std::shared_ptr<const FrameBlock> FrameReader::next() {
  const std::lock_guard lock(feed_->mutex_);
  if (sequence_ == feed_->blocks_) {
    return nullptr;
  }
  if (feed_->blocks_ - sequence_ > feed_->ring_.size()) {
    sequence_ = feed_->blocks_ - 1;
  }
  std::shared_ptr<const FrameBlock> block = feed_->ring_[sequence_ % feed_->ring_.size()];
  lost_ += block->frames_before - frames_seen_;
  frames_seen_ = block->frames_before + block->frames;
  ++sequence_;
  return block;
}

}  // namespace graben::scope
