// SPDX-License-Identifier: Apache-2.0
/// What lies between the source and the pages: what a reader gets, and what it is told it missed.

#include "app/scope/server/frame_feed.hpp"

#include <atomic>
#include <thread>

#include "tests/unit/cmocka_cpp.hpp"

using scope::FrameBlock;
using scope::FrameFeed;
using scope::FrameReader;

constexpr std::size_t kBlocks = 4;
constexpr std::size_t kKept = 6;
constexpr FrameFeed::Bounds kBounds{kBlocks, kKept, 1 << 20};

CanFrame frame(std::uint8_t byte = 0) {
  CanFrame result;
  result.id = 0x18FF2080U;
  result.length = 1;
  result.data[0] = byte;
  return result;
}

void feed_blocks(FrameFeed& feed, int blocks, int frames_each) {
  for (int i = 0; i < blocks; ++i) {
    repeat(frames_each, [&] { feed.append(frame(), 0, "can0"); });
    feed.flush();
  }
}

TEST(lines_are_candump) {
  FrameFeed feed;
  FrameReader reader(feed);
  feed.append(frame(0xA5), 1234567890123456, "vcan0");
  CanFrame error = frame(1);
  error.id = 4;
  error.error = true;
  error.extended = false;
  feed.append(error, 1000001, "can1");
  CanFrame basic = frame(2);
  basic.id = 0x7F;
  basic.extended = false;
  feed.append(basic, 0, "can1");
  feed.flush();
  assert_string_equal(reader.next()->text.c_str(),
                      "(1234567890.123456) vcan0 18FF2080#A5\n"
                      "(0000000001.000001) can1 20000004#01\n"
                      "(0000000000.000000) can1 07F#02\n");
}

TEST(nothing_comes_before_the_flush) {
  FrameFeed feed;
  FrameReader reader(feed);
  feed.append(frame(), 0, "can0");
  assert_null(reader.next().get());
  feed.flush();
  assert_int_equal(reader.next()->frames, 1);
  assert_null(reader.next().get());
  feed.flush();
  assert_null(reader.next().get());
}

TEST(who_comes_late_sees_what_is_kept) {
  FrameFeed feed(kBounds);
  feed_blocks(feed, 3, 5);
  FrameReader early(feed);
  for (std::uint64_t i = 0; i < 3; ++i) {
    assert_int_equal(early.next()->sequence, i);
  }
  assert_null(early.next().get());
  feed_blocks(feed, static_cast<int>(kKept), 7);
  FrameReader late(feed);
  for (std::uint64_t i = 3; i < 3 + kKept; ++i) {
    const auto block = late.next();
    assert_int_equal(block->sequence, i);
    assert_int_equal(block->frames_before, 15 + 7 * (i - 3));
  }
  assert_null(late.next().get());
  assert_int_equal(late.lost(), 0);
}

TEST(who_comes_and_is_too_slow_loses_what_goes) {
  FrameFeed feed(kBounds);
  feed_blocks(feed, static_cast<int>(kKept), 1);
  FrameReader late(feed);
  assert_int_equal(late.next()->sequence, 0);
  feed_blocks(feed, 2, 1);
  assert_int_equal(late.next()->sequence, kKept + 1);
  assert_int_equal(late.lost(), kKept);
}

TEST(what_is_kept_is_bounded_in_bytes_too) {
  FrameFeed feed(FrameFeed::Bounds{kBlocks, 1000, 10 * 38});
  feed_blocks(feed, 50, 1);
  FrameReader late(feed);
  std::size_t bytes = 0;
  int blocks = 0;
  for (auto block = late.next(); block; block = late.next(), ++blocks) {
    bytes += block->text.size();
  }
  assert_in_range(blocks, 2, 49);
  assert_in_range(bytes, 1, 10 * 38);
}

TEST(a_full_ring_loses_nothing) {
  FrameFeed feed(kBounds);
  FrameReader reader(feed);
  feed_blocks(feed, kBlocks, 3);
  for (std::size_t i = 0; i < kBlocks; ++i) {
    assert_int_equal(reader.next()->sequence, i);
  }
  assert_int_equal(reader.lost(), 0);
}

TEST(an_overtaken_reader_gets_the_newest_and_the_count) {
  FrameFeed feed(kBounds);
  FrameReader slow(feed);
  FrameReader quick(feed);
  for (std::size_t i = 0; i < kBlocks + 1; ++i) {
    feed_blocks(feed, 1, 3);
    assert_int_equal(quick.next()->sequence, i);
  }
  assert_int_equal(slow.next()->sequence, kBlocks);
  assert_int_equal(slow.lost(), 3 * kBlocks);
  assert_null(slow.next().get());
  assert_int_equal(quick.lost(), 0);
  // What it missed stays counted, and the next miss comes on top.
  feed_blocks(feed, 2 * kBlocks, 2);
  assert_int_equal(slow.next()->frames, 2);
  assert_int_equal(slow.lost(), 3 * kBlocks + 2 * (2 * kBlocks - 1));
}

TEST(a_large_block_goes_by_itself) {
  FrameFeed feed;
  FrameReader reader(feed);
  for (std::size_t bytes = 0; bytes < FrameFeed::kLargestBlockBytes; bytes += 20) {
    feed.append(frame(), 0, "can0");
  }
  const auto block = reader.next();
  assert_non_null(block.get());
  assert_true(block->text.size() >= FrameFeed::kLargestBlockBytes);
  assert_true(block->text.size() < FrameFeed::kLargestBlockBytes + 100);
}

TEST(the_listener_hears_of_each_flush_and_wake) {
  FrameFeed feed;
  int calls = 0;
  feed.on_change([&calls] { ++calls; });
  feed.flush();
  assert_int_equal(calls, 0);
  feed_blocks(feed, 2, 1);
  assert_int_equal(calls, 2);
  feed.wake();
  assert_int_equal(calls, 3);
}

/// What is read and what is missed is all there was, whatever the threads' pace.
TEST(every_frame_is_read_or_counted) {
  FrameFeed feed(FrameFeed::Bounds{8, 8, 1 << 20});
  FrameReader reader(feed);
  constexpr int kRounds = 20000;
  std::atomic<bool> done{false};
  std::thread producer([&] {
    feed_blocks(feed, kRounds, 3);
    done = true;
  });
  std::uint64_t read = 0;
  for (bool last = false; !last;) {
    last = done;
    while (const std::shared_ptr<const FrameBlock> block = reader.next()) {
      read += block->frames;
    }
  }
  producer.join();
  assert_int_equal(read + reader.lost(), 3 * kRounds);
}
