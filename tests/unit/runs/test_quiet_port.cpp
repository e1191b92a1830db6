// SPDX-License-Identifier: Apache-2.0
/// What a machine's port loses of cycles that were late.

#include "app/runs/quiet_port.hpp"

#include "platform/loopback/loopback_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"

TEST(loses_what_is_sent_while_quiet_alone) {
  LoopbackBus bus;
  LoopbackPort& other = bus.attach();
  runs::QuietPort port(bus.attach());
  assert_true(other.open());
  assert_true(port.open());
  assert_true(port.state() == CanPortState::kActive);
  CanFrame frame;
  CanFrame heard;
  assert_true(port.send(frame));
  assert_int_equal(other.receive(&heard, 1), 1);

  port.set_quiet(true);
  assert_true(port.send(frame));
  assert_int_equal(other.receive(&heard, 1), 0);
  // It still hears.
  assert_true(other.send(frame));
  assert_int_equal(port.receive(&heard, 1), 1);

  port.set_quiet(false);
  assert_true(port.send(frame));
  assert_int_equal(other.receive(&heard, 1), 1);
}
