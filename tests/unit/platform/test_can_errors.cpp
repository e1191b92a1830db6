// SPDX-License-Identifier: Apache-2.0
// What each report of the controller makes of the port's state.

#include "platform/linux/can_frames.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using State = CanPortState;

can_frame error_frame(canid_t classes, unsigned controller_status = 0) {
  can_frame frame{};
  frame.can_id = CAN_ERR_FLAG | classes;
  frame.can_dlc = CAN_ERR_DLC;
  frame.data[1] = static_cast<std::uint8_t>(controller_status);
  return frame;
}

can_frame controller_report(unsigned status) { return error_frame(CAN_ERR_CRTL, status); }

constexpr State kOpenStates[] = {State::kActive, State::kErrorPassive, State::kBusOff};

TEST(bus_off_and_restart) {
  for (const State from : kOpenStates) {
    assert_int_equal(next_state(from, error_frame(CAN_ERR_BUSOFF)), State::kBusOff);
    assert_int_equal(next_state(from, error_frame(CAN_ERR_RESTARTED)), State::kActive);
    assert_int_equal(next_state(from, controller_report(CAN_ERR_CRTL_ACTIVE)), State::kActive);
  }
}

TEST(passive_in_either_direction) {
  for (const unsigned status : {CAN_ERR_CRTL_RX_PASSIVE, CAN_ERR_CRTL_TX_PASSIVE,
                                CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_WARNING,
                                CAN_ERR_CRTL_TX_PASSIVE | CAN_ERR_CRTL_ACTIVE}) {
    assert_int_equal(next_state(State::kActive, controller_report(status)), State::kErrorPassive);
    assert_int_equal(next_state(State::kErrorPassive, controller_report(status)),
                     State::kErrorPassive);
  }
}

TEST(a_warning_is_error_active) {
  for (const unsigned status : {CAN_ERR_CRTL_RX_WARNING, CAN_ERR_CRTL_TX_WARNING}) {
    assert_int_equal(next_state(State::kActive, controller_report(status)), State::kActive);
    assert_int_equal(next_state(State::kErrorPassive, controller_report(status)), State::kActive);
  }
}

TEST(bus_off_is_not_left_by_less) {
  for (const unsigned status : {CAN_ERR_CRTL_RX_WARNING, CAN_ERR_CRTL_TX_WARNING,
                                CAN_ERR_CRTL_RX_PASSIVE, CAN_ERR_CRTL_TX_PASSIVE}) {
    assert_int_equal(next_state(State::kBusOff, controller_report(status)), State::kBusOff);
  }
}

TEST(the_worse_of_two_reports_holds) {
  const auto after = [](State from, canid_t classes, unsigned status) {
    return next_state(from, error_frame(classes, status));
  };
  assert_int_equal(after(State::kActive, CAN_ERR_BUSOFF | CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE),
                   State::kBusOff);
  assert_int_equal(after(State::kBusOff, CAN_ERR_BUSOFF | CAN_ERR_RESTARTED, 0), State::kBusOff);
  assert_int_equal(after(State::kBusOff, CAN_ERR_RESTARTED | CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE),
                   State::kErrorPassive);
  assert_int_equal(
      after(State::kBusOff, CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE | CAN_ERR_CRTL_RX_PASSIVE),
      State::kErrorPassive);
}

TEST(single_faults_change_nothing) {
  for (const State from : kOpenStates) {
    for (const canid_t classes : {CAN_ERR_ACK, CAN_ERR_TX_TIMEOUT, CAN_ERR_PROT, CAN_ERR_BUSERROR,
                                  CAN_ERR_TRX, CAN_ERR_LOSTARB}) {
      // Byte 1 means nothing outside its class.
      assert_int_equal(next_state(from, error_frame(classes, 0xFF)), from);
    }
    assert_int_equal(next_state(from, controller_report(0)), from);
    assert_int_equal(next_state(from, controller_report(CAN_ERR_CRTL_RX_OVERFLOW)), from);
    assert_int_equal(next_state(from, controller_report(CAN_ERR_CRTL_TX_OVERFLOW)), from);
  }
}

TEST(a_data_frame_of_the_same_bits_changes_nothing) {
  for (const State from : kOpenStates) {
    for (const canid_t id : {CAN_ERR_BUSOFF, CAN_ERR_CRTL, CAN_ERR_RESTARTED}) {
      can_frame frame = error_frame(id, CAN_ERR_CRTL_TX_PASSIVE);
      frame.can_id = id | CAN_EFF_FLAG;
      assert_int_equal(next_state(from, frame), from);
      assert_false(reports_lost_frames(frame));
    }
  }
}

TEST(closed_and_down_are_left_by_opening_only) {
  for (const State from : {State::kClosed, State::kDown}) {
    assert_int_equal(next_state(from, error_frame(CAN_ERR_BUSOFF)), from);
    assert_int_equal(next_state(from, error_frame(CAN_ERR_RESTARTED)), from);
    assert_int_equal(next_state(from, controller_report(CAN_ERR_CRTL_ACTIVE)), from);
  }
}

TEST(lost_frames_are_told_from_other_reports) {
  assert_true(reports_lost_frames(controller_report(CAN_ERR_CRTL_RX_OVERFLOW)));
  assert_true(
      reports_lost_frames(controller_report(CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_RX_WARNING)));
  assert_false(reports_lost_frames(controller_report(CAN_ERR_CRTL_TX_OVERFLOW)));
  assert_false(reports_lost_frames(error_frame(CAN_ERR_PROT, CAN_ERR_CRTL_RX_OVERFLOW)));
}

TEST(the_classes_asked_for_are_those_understood) {
  for (const canid_t wanted : {CAN_ERR_BUSOFF, CAN_ERR_RESTARTED, CAN_ERR_CRTL, CAN_ERR_ACK,
                               CAN_ERR_TX_TIMEOUT, CAN_ERR_PROT}) {
    assert_true((kCanErrorClasses & wanted) != 0);
  }
  assert_int_equal(kCanErrorClasses & (CAN_ERR_LOSTARB | CAN_ERR_BUSERROR), 0);
}
