// SPDX-License-Identifier: Apache-2.0
// Frames and filters between the kernel's form and ours; stamps.

#include "platform/linux/can_frames.hpp"

#include "platform/linux/can_frames.hpp"
#include "tests/unit/cmocka_cpp.hpp"

can_frame kernel_frame(canid_t id, std::uint8_t length) {
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = length;
  for (unsigned i = 0; i < CAN_MAX_DLEN; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(0xA0 + i);
  }
  return frame;
}

/// There and back it is the same, apart from the stamp.
void round_trip(const CanFrame& frame) {
  can_frame raw{};
  assert_true(to_socketcan(frame, raw));
  const CanFrame back = from_socketcan(raw, 0);
  assert_int_equal(back.id, frame.id);
  assert_int_equal(back.extended, frame.extended);
  assert_int_equal(back.remote, frame.remote);
  assert_int_equal(back.length, frame.length);
  assert_true(back.data == frame.data);
}

TEST(a_29_bit_frame_comes_in) {
  const CanFrame frame = from_socketcan(kernel_frame(0x18FF5027U | CAN_EFF_FLAG, 8), 1234);
  assert_int_equal(frame.id, 0x18FF5027);
  assert_true(frame.extended);
  assert_false(frame.remote || frame.error || frame.fd);
  assert_int_equal(frame.length, 8);
  assert_int_equal(frame.data[0], 0xA0);
  assert_int_equal(frame.data[7], 0xA7);
  assert_int_equal(frame.stamp_us, 1234);
}

TEST(bytes_beyond_the_length_are_zero) {
  const CanFrame three = from_socketcan(kernel_frame(1U | CAN_EFF_FLAG, 3), 0);
  assert_int_equal(three.length, 3);
  assert_int_equal(three.data[2], 0xA2);
  assert_int_equal(three.data[3], 0);
  assert_int_equal(from_socketcan(kernel_frame(1U | CAN_EFF_FLAG, 0), 0).data[0], 0);
  assert_int_equal(from_socketcan(kernel_frame(1U | CAN_EFF_FLAG, 9), 0).length, 8);
  const CanFrame remote = from_socketcan(kernel_frame(1U | CAN_EFF_FLAG | CAN_RTR_FLAG, 8), 0);
  assert_true(remote.remote);
  assert_int_equal(remote.length, 8);
  assert_int_equal(remote.data[0], 0);
}

TEST(flags_are_no_part_of_the_id) {
  const CanFrame standard = from_socketcan(kernel_frame(0x7FF, 8), 0);
  assert_int_equal(standard.id, 0x7FF);
  assert_false(standard.extended);
  // An 11-bit frame has no more bits, whatever the kernel left above them.
  assert_int_equal(from_socketcan(kernel_frame(0x1FFFFFFF, 8), 0).id, 0x7FF);
  assert_int_equal(from_socketcan(kernel_frame(0xFFFFFFFF, 8), 0).id, 0x1FFFFFFF);
  const CanFrame error = from_socketcan(kernel_frame(CAN_ERR_FLAG | 0x2000, 8), 0);
  assert_true(error.error);
  assert_int_equal(error.id, 0x2000);
}

TEST(frames_go_out_as_they_are) {
  CanFrame frame;
  frame.length = 8;
  frame.data = {1, 2, 3, 4, 5, 6, 7, 8};
  frame.id = CAN_EFF_MASK;
  round_trip(frame);
  can_frame raw{};
  assert_true(to_socketcan(frame, raw));
  assert_int_equal(raw.can_id, 0x9FFFFFFFU);
  frame.id = 0;
  frame.length = 0;
  frame.data = {};
  round_trip(frame);
  frame.remote = true;
  frame.length = 5;
  round_trip(frame);
  frame.extended = false;
  frame.id = CAN_SFF_MASK;
  round_trip(frame);
  assert_true(to_socketcan(frame, raw));
  assert_int_equal(raw.can_id, 0x400007FFU);
}

TEST(what_cannot_be_sent_is_refused) {
  can_frame raw = kernel_frame(0x55, 4);
  const can_frame before = raw;
  CanFrame good;
  good.length = 8;
  const auto refused = [&raw, good](auto&& spoil) {
    CanFrame frame = good;
    spoil(frame);
    return !to_socketcan(frame, raw);
  };
  assert_true(refused([](CanFrame& f) { f.id = CAN_EFF_MASK + 1; }));
  assert_true(refused([](CanFrame& f) {
    f.extended = false;
    f.id = CAN_SFF_MASK + 1;
  }));
  assert_true(refused([](CanFrame& f) { f.length = 9; }));
  assert_true(refused([](CanFrame& f) { f.fd = true; }));
  assert_true(refused([](CanFrame& f) { f.error = true; }));
  assert_memory_equal(&raw, &before, sizeof raw);
  assert_false(refused([](CanFrame&) {}));
}

/// As the kernel compares (include/uapi/linux/can.h, struct can_filter).
bool passes(const can_filter& filter, canid_t id) {
  return (id & filter.can_mask) == (filter.can_id & filter.can_mask);
}

/// Of a 29-bit id: page, PGN and source address.
constexpr unsigned kIdentityBits = 26;

TEST(a_filter_passes_its_message_in_its_form_only) {
  for (const std::uint32_t id : {0x18FF5027U, 0U, 0x1FFFFFFFU, 0x7FFU}) {
    const can_filter filter = message_filter(id);
    assert_true(passes(filter, id | CAN_EFF_FLAG));
    assert_false(passes(filter, id));
    assert_false(passes(filter, id | CAN_EFF_FLAG | CAN_RTR_FLAG));
    for (unsigned bit = 0; bit < CAN_EFF_ID_BITS; ++bit) {
      // The three highest bits are the priority, which is the sender's.
      assert_int_equal(passes(filter, (id ^ (1U << bit)) | CAN_EFF_FLAG), bit >= kIdentityBits);
    }
    // Neither the inverted sense nor the class of error frames slips in with a bad id.
    assert_int_equal(message_filter(id | CAN_INV_FILTER | CAN_ERR_FLAG).can_id, filter.can_id);
    assert_int_equal(filter.can_mask & CAN_ERR_FLAG, 0);
  }
}

TEST(accelerations_of_two_makers_pass_at_their_priority) {
  const can_filter filter = message_filter(0x0CF02DE2);
  assert_true(passes(filter, 0x08F02DE2U | CAN_EFF_FLAG));
  assert_false(passes(filter, 0x08F02DE3U | CAN_EFF_FLAG));
}

TEST(source_fe_passes_any_sender) {
  const can_filter filter = message_filter(0x0CF004FE);
  for (const std::uint32_t id : {0x0CF00400U, 0x18F00401U, 0x0CF004FEU}) {
    assert_true(passes(filter, id | CAN_EFF_FLAG));
    assert_false(passes(filter, id));
  }
  assert_false(passes(filter, 0x0CF00500U | CAN_EFF_FLAG));
}

TEST(eleven_bits_have_no_priority) {
  const can_filter filter = message_filter(0x80000000U | 0x1FEU);
  assert_true(passes(filter, 0x1FEU));
  assert_false(passes(filter, 0x100U));
  assert_false(passes(filter, 0x5FEU));
}

constexpr TimeUs kWallUs = 1'700'000'000'000'000;

TEST(a_stamp_keeps_its_age) {
  ReceiveStamp stamp;
  stamp.set_now(5'000'000, kWallUs);
  assert_int_equal(stamp.now_us(), 5'000'000);
  assert_int_equal(stamp.monotonic_us(kWallUs), 5'000'000);
  assert_int_equal(stamp.monotonic_us(kWallUs - 1), 4'999'999);
  assert_int_equal(stamp.monotonic_us(kWallUs - 8'000), 4'992'000);
  assert_int_equal(stamp.monotonic_us(kWallUs - kSecondUs), 4'000'000);
}

TEST(an_impossible_age_becomes_now) {
  ReceiveStamp stamp;
  stamp.set_now(5'000'000, kWallUs);
  assert_int_equal(stamp.monotonic_us(kWallUs + 1), 5'000'000);
  assert_int_equal(stamp.monotonic_us(kWallUs - kSecondUs - 1), 5'000'000);
  assert_int_equal(stamp.monotonic_us(0), 5'000'000);
}

TEST(no_stamp_is_believed_after_a_step_until_the_queue_was_empty) {
  for (const TimeUs step_us : {TimeUs{1'001}, TimeUs{-1'001}, TimeUs{500'000}}) {
    ReceiveStamp stamp;
    stamp.set_now(5'000'000, kWallUs);
    stamp.set_now(5'010'000, kWallUs + 10'000 + step_us);
    assert_int_equal(stamp.monotonic_us(kWallUs + 5'000 + step_us), 5'010'000);
    stamp.set_now(5'020'000, kWallUs + 20'000 + step_us);
    assert_int_equal(stamp.monotonic_us(kWallUs + 15'000 + step_us), 5'020'000);
    stamp.queue_is_empty();
    assert_int_equal(stamp.monotonic_us(kWallUs + 15'000 + step_us), 5'015'000);
  }
}

TEST(slewing_is_no_step) {
  for (const TimeUs slew_us : {TimeUs{1'000}, TimeUs{-1'000}}) {
    ReceiveStamp stamp;
    stamp.set_now(5'000'000, kWallUs);
    stamp.set_now(5'010'000, kWallUs + 10'000 + slew_us);
    assert_int_equal(stamp.monotonic_us(kWallUs + 5'000 + slew_us), 5'005'000);
  }
}
