// SPDX-License-Identifier: Apache-2.0
/// What the station hears.

#include "app/operate/ecu_listener.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "hal/link/dm1.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using dbc::RawState;
using operate::EcuListener;
using Dbc = EcuListener::Dbc;

template <class Message>
CanFrame frame_of(const Message& message) {
  CanFrame frame;
  frame.id = Message::kId;
  frame.length = Message::kLength;
  frame.data = message.encode();
  return frame;
}

CanFrame status_frame(Dbc::EcuStatus::Mode mode) {
  Dbc::EcuStatus status;
  status.mode = {mode, RawState::kValid};
  return frame_of(status);
}

CanFrame identity_frame(std::uint32_t version, std::uint32_t stamp) {
  Dbc::EcuIdentity identity;
  identity.dbc_version = {version, RawState::kValid};
  identity.stamp = {stamp, RawState::kValid};
  return frame_of(identity);
}

CanFrame trouble_frame(Fault fault) {
  Dbc::DM1 trouble;
  const std::uint32_t spn = kDm1FirstSpn + static_cast<std::uint32_t>(fault);
  trouble.spn_low = {spn & 0xFFFFU, RawState::kValid};
  trouble.spn_high = {spn >> 16U, RawState::kValid};
  return frame_of(trouble);
}

TEST(the_mode_holds_for_a_tenth_of_a_second) {
  EcuListener ecu;
  assert_false(ecu.mode(0).has_value());
  ecu.hear(status_frame(Dbc::EcuStatus::Mode::kArmed), kSecondUs);
  assert_true(ecu.mode(kSecondUs) == EcuMode::kArmed);
  assert_true(ecu.hears_ecu(kSecondUs + 99 * kMillisecondUs));
  assert_false(ecu.hears_ecu(kSecondUs + 100 * kMillisecondUs));
  assert_false(ecu.mode(kSecondUs + 100 * kMillisecondUs).has_value());
}

TEST(what_is_no_whole_data_frame_is_not_heard) {
  const CanFrame good = status_frame(Dbc::EcuStatus::Mode::kArmed);
  std::vector<CanFrame> bad(5, good);
  bad[0].extended = false;
  bad[1].remote = true;
  bad[2].error = true;
  bad[3].fd = true;
  bad[4].length = 7;
  EcuListener ecu;
  for (const CanFrame& frame : bad) {
    ecu.hear(frame, 0);
  }
  assert_false(ecu.hears_ecu(0));
  ecu.hear(good, 0);
  assert_true(ecu.hears_ecu(0));
}

TEST(a_stamp_is_repeated) {
  EcuListener ecu;
  assert_int_equal(ecu.echo().value, 0);
  ecu.hear(identity_frame(Dbc::kDbcVersion, 1234), 0);
  assert_int_equal(ecu.echo().value, 1234);
  assert_true(ecu.echo().state == RawState::kValid);
}

TEST(another_version_is_told) {
  EcuListener ecu;
  assert_false(ecu.other_version().has_value());
  ecu.hear(identity_frame(Dbc::kDbcVersion, 1), 0);
  assert_false(ecu.other_version().has_value());
  ecu.hear(identity_frame(Dbc::kDbcVersion - 1, 2), 0);
  assert_int_equal(*ecu.other_version(), Dbc::kDbcVersion - 1);
  Dbc::EcuIdentity none;
  ecu.hear(frame_of(none), 0);
  assert_true(ecu.other_version().has_value());
}

TEST(another_station_is_known_by_its_address) {
  EcuListener ecu;
  ecu.hear(status_frame(Dbc::EcuStatus::Mode::kReady), 0);
  ecu.hear(frame_of(Dbc::OperatorAxes{}), 0);
  assert_false(ecu.other_station().has_value());
  CanFrame command = frame_of(Dbc::OperatorCommand{});
  ecu.hear(command, 0);
  assert_int_equal(*ecu.other_station(), 0x81);
  // Another address, another priority: the same message.
  command.id = 0x18FF2742;
  ecu.hear(command, 0);
  assert_int_equal(*ecu.other_station(), 0x42);
}

TEST(strokes_grow_old) {
  EcuListener ecu;
  Dbc::BoomStroke boom;
  boom.boom_stroke_m = {1.25, RawState::kValid};
  Dbc::BucketStroke bucket;
  bucket.bucket_stroke_m = {0.0, RawState::kError};
  ecu.hear(frame_of(boom), 0);
  ecu.hear(frame_of(bucket), 0);
  assert_near(*ecu.strokes_m(0)[0], 1.25, 1e-9);
  assert_false(ecu.strokes_m(0)[1].has_value());
  assert_false(ecu.strokes_m(0)[2].has_value());
  assert_true(ecu.strokes_m(49 * kMillisecondUs)[0].has_value());
  assert_false(ecu.strokes_m(50 * kMillisecondUs)[0].has_value());
}

TEST(trouble_codes_are_kept_while_they_are_repeated) {
  EcuListener ecu;
  ecu.hear(frame_of(Dbc::DM1{}), 0);
  assert_true(ecu.faults(0).empty());
  ecu.hear(trouble_frame(Fault::kBlocked), 0);
  ecu.hear(trouble_frame(Fault::kStrokeMissing), kSecondUs);
  assert_int_equal(ecu.faults(kSecondUs).size(), 2);
  assert_int_equal(ecu.faults(1600 * kMillisecondUs).size(), 1);
  assert_true(ecu.faults(1600 * kMillisecondUs)[0] == Fault::kStrokeMissing);
}

TEST(several_faults_of_one_broadcast_are_all_heard) {
  // J1939-21: 14 bytes in 2 packets, DM1; J1939-73: lamps, then 3 codes, SPN 520193, 520202,
  // 520247.
  const std::array<std::array<std::uint8_t, 8>, 3> packets = {{
      {32, 14, 0, 2, 0xFF, 0xCA, 0xFE, 0x00},
      {1, 0x14, 0xFF, 0x01, 0xF0, 0xE9, 1, 0x0A},
      {2, 0xF0, 0xE9, 1, 0x37, 0xF0, 0xE9, 1},
  }};
  for (const bool is_whole : {true, false}) {
    EcuListener ecu;
    for (std::size_t i = 0; i < packets.size(); ++i) {
      CanFrame frame;
      frame.id = i == 0 ? 0x1CECFF82 : 0x1CEBFF82;
      frame.length = 8;
      frame.data = packets[i];
      if (is_whole || i != 1) {
        ecu.hear(frame, static_cast<TimeUs>(i) * 60 * kMillisecondUs);
      }
    }
    assert_int_equal(ecu.faults(kSecondUs).size(), is_whole ? 3 : 0);
    if (is_whole) {
      assert_true(ecu.faults(kSecondUs)[0] == static_cast<Fault>(1));
      assert_true(ecu.faults(kSecondUs)[2] == static_cast<Fault>(55));
    }
    assert_true(ecu.faults(2 * kSecondUs).empty());
  }
}
