// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/frame_feed.hpp"

#include <algorithm>
#include <utility>

#include "platform/loopback/candump_log.hpp"

namespace graben::scope {

FrameFeed::FrameFeed(const Bounds& bounds) : bounds_(bounds) {}

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
  auto block = std::make_shared<FrameBlock>(std::move(open_));
  // Taken out under the lock, given back to the heap after it.
  std::deque<std::shared_ptr<const FrameBlock>> gone;
  {
    const std::lock_guard lock(mutex_);
    block->sequence = blocks_;
    block->frames_before = frames_;
    frames_ += block->frames;
    kept_bytes_ += size;
    kept_.push_back(std::move(block));
    ++blocks_;
    while (kept_.size() > 1 &&
           (kept_.size() > bounds_.kept_blocks || kept_bytes_ > bounds_.kept_bytes)) {
      kept_bytes_ -= kept_.front()->text.size();
      gone.push_back(std::move(kept_.front()));
      kept_.pop_front();
    }
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
  began_ = feed.blocks_;
  sequence_ = began_ - feed.kept_.size();
  frames_seen_ = feed.kept_.empty() ? feed.frames_ : feed.kept_.front()->frames_before;
}

std::shared_ptr<const FrameBlock> FrameReader::next() {
  const std::lock_guard lock(feed_->mutex_);
  if (sequence_ == feed_->blocks_) {
    return nullptr;
  }
  // What was there when it began may wait; what comes since then may do so for some seconds.
  const bool is_too_slow = feed_->blocks_ - std::max(sequence_, began_) > feed_->bounds_.lag_blocks;
  if (is_too_slow || feed_->blocks_ - sequence_ > feed_->kept_.size()) {
    sequence_ = feed_->blocks_ - 1;
  }
  std::shared_ptr<const FrameBlock> block =
      feed_->kept_[feed_->kept_.size() - (feed_->blocks_ - sequence_)];
  lost_ += block->frames_before - frames_seen_;
  frames_seen_ = block->frames_before + block->frames;
  ++sequence_;
  return block;
}

}  // namespace graben::scope
