// SPDX-License-Identifier: Apache-2.0
// Codecs that the build makes of a kind's own messages and the common ones (graben_dbc_codec).

#include <type_traits>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "loader_dbc.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace bus = graben::dbc::loader;
using graben::dbc::RawState;

// One type for what all buses share: its senders and receivers are written once.
static_assert(std::is_same_v<bus::EcuStatus, graben::dbc::excavator::EcuStatus>);
static_assert(std::is_same_v<bus::OperatorCommand, graben::dbc::excavator::OperatorCommand>);
static_assert(!std::is_same_v<bus::LiftCommand, graben::dbc::excavator::SpoolCommand>);

TEST(own_messages_have_what_follows_from_their_lines) {
  assert_int_equal(bus::kDbcVersion, 1);
  assert_int_equal(bus::kMessages.size(), 2 + 10);
  assert_int_equal(bus::LiftState::kId, 0x0CFF5080);
  assert_true(bus::LiftState::kProtected);
  assert_int_equal(bus::LiftState::kDataId, 0xFF50);
  // What is measured begins as 'not available', what is commanded as neutral.
  const bus::LiftState state;
  assert_int_equal(state.lift_stroke_m.state, RawState::kNotAvailable);
  const bus::LiftCommand command;
  assert_int_equal(command.enable.value, bus::LiftCommand::Enable::kOff);
  assert_near(command.lift_duty_ratio.value, 0.0, 0.0);
  assert_int_equal(command.lift_duty_ratio.state, RawState::kValid);
}

TEST(what_is_sent_is_received, bus::LiftState sent) {
  sent.lift_stroke_m = {0.75, RawState::kValid};
  sent.lift_spool_ratio = {-0.5, RawState::kValid};
  const bus::LiftState received = bus::LiftState::decode(sent.encode());
  assert_near(received.lift_stroke_m.value, 0.75, 1e-12);
  assert_near(received.lift_spool_ratio.value, -0.5, 1e-12);
}
