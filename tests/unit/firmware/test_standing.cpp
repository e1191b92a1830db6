#include "firmware/safety/status.hpp"

#include "firmware/safety/fault_table.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/flip_bit.hpp"

namespace {

using namespace graben;

constexpr EcuMode kModes[] = {EcuMode::kSilent, EcuMode::kReady,    EcuMode::kArmed,
                              EcuMode::kActive, EcuMode::kStopping, EcuMode::kFault};

FaultSet only(Fault fault) {
  FaultSet faults;
  faults.add(fault);
  return faults;
}

void the_first_fault_is_named(void**) {
  assert_int_equal(first_of({}), Fault::kNone);
  assert_int_equal(first_of({Fault::kNone, Fault::kNone}), Fault::kNone);
  assert_int_equal(first_of({Fault::kNone, Fault::kBusOff, Fault::kStrokeMissing}), Fault::kBusOff);
}

void a_mode_that_changed_in_memory_is_a_fault(void**) {
  const Guarded<ModeState> armed(ModeState{EcuMode::kArmed, Fault::kNone, true});
  assert_int_equal(stored_mode(armed).mode, EcuMode::kArmed);
  assert_true(stored_mode(armed).may_arm);
  for (std::size_t bit = 0; bit < 8 * sizeof(armed); ++bit) {
    Guarded<ModeState> flipped = armed;
    test::flip_bit(flipped, bit);
    assert_int_equal(stored_mode(flipped).mode, EcuMode::kFault);
    assert_int_equal(stored_mode(flipped).fault, Fault::kMemoryCorrupt);
    assert_false(stored_mode(flipped).may_arm);
  }
}

void each_part_of_the_request_has_its_source(void**) {
  const ModeRequest nothing = mode_request(Fault::kNone, {}, false, false);
  assert_int_equal(nothing.fault, Fault::kNone);
  assert_false(nothing.enable || nothing.automatic || nothing.has_task || nothing.centred ||
               nothing.stop);
  CommonValid valid;
  valid.enable = true;
  assert_true(mode_request(Fault::kNone, valid, false, false).enable);
  valid = {};
  valid.automatic = true;
  assert_true(mode_request(Fault::kNone, valid, false, false).automatic);
  for (const Task task : {Task::kDig, Task::kGrade}) {
    valid = {};
    valid.task = task;
    assert_true(mode_request(Fault::kNone, valid, false, false).has_task);
  }
  assert_true(mode_request(Fault::kNone, {}, true, false).centred);
  assert_false(mode_request(Fault::kNone, {}, true, false).stop);
  assert_true(mode_request(Fault::kNone, {}, false, true).stop);
  assert_int_equal(mode_request(Fault::kBusOff, {}, false, false).fault, Fault::kBusOff);
}

/// Any fault by which the spools do not obey, latched or there now, in any mode.
void a_spool_that_does_not_obey_cuts_the_pilot(void**) {
  for (const EcuMode mode : kModes) {
    for (int code = 0; code < kFaultCount; ++code) {
      const auto fault = static_cast<Fault>(code);
      assert_int_equal(pilot({}, {mode, Fault::kNone}, only(fault)).cut, cuts_pilot(fault));
      assert_int_equal(pilot({}, {mode, fault}, {}).cut, cuts_pilot(fault));
    }
  }
}

/// It lasts after the fault has gone where the machine was stopped by it, or by something else at
/// the same time; a stuck spool's wherever it was seen.
void the_cut_is_kept_after_its_cause(void**) {
  const auto kept = [](EcuMode mode, Fault latched, const FaultSet& faults) {
    return pilot({}, {mode, latched}, faults).state.kept_cut;
  };
  assert_true(kept(EcuMode::kFault, Fault::kUncommandedMotion, {}));
  assert_true(kept(EcuMode::kFault, Fault::kBusOff, only(Fault::kValveNotFollowing)));
  assert_false(kept(EcuMode::kFault, Fault::kBusOff, only(Fault::kStrokeMissing)));
  assert_true(kept(EcuMode::kReady, Fault::kNone, only(Fault::kSpoolStuck)));
  assert_true(kept(EcuMode::kSilent, Fault::kBusOff, only(Fault::kSpoolStuck)));
  // The echo of a valve that is only just being enabled by hand is no disobedience.
  assert_false(kept(EcuMode::kSilent, Fault::kValveNotFollowing, only(Fault::kValveNotFollowing)));
}

/// Nothing but arming again gives the pressure back.
void only_arming_ends_the_cut(void**) {
  for (const EcuMode mode : kModes) {
    const PilotResult result = pilot({true, true}, {mode, Fault::kNone}, {});
    assert_int_equal(result.cut, !in_motion(mode));
    assert_int_equal(result.state.kept_cut, !in_motion(mode));
  }
  assert_false(pilot({}, {EcuMode::kReady, Fault::kNone}, {}).state.kept_cut);
}

/// What an earlier process asked for is not known until this one has armed or asked itself.
void the_pilot_is_known_from_arming_or_a_cut(void**) {
  for (const EcuMode mode : kModes) {
    assert_int_equal(pilot({}, {mode, Fault::kNone}, {}).state.known, in_motion(mode));
    assert_true(pilot({false, true}, {mode, Fault::kNone}, {}).state.known);
    assert_true(pilot({}, {mode, Fault::kNone}, only(Fault::kSpoolStuck)).state.known);
  }
}

void what_stopped_it_is_named_before_what_slows(void**) {
  CommonValid valid;
  valid.faults = only(Fault::kPressureMissing);
  valid.degraded = only(Fault::kPressureMissing);
  const MachineStatus slow = describe({EcuMode::kActive, Fault::kNone}, {}, valid);
  assert_int_equal(slow.mode, EcuMode::kActive);
  assert_int_equal(slow.fault, Fault::kPressureMissing);
  assert_int_equal(slow.why_not_armed, 0);
  const MachineStatus stopped = describe({EcuMode::kFault, Fault::kBusOff}, {}, valid);
  assert_int_equal(stopped.fault, Fault::kBusOff);
  assert_true(stopped.faults.has(Fault::kBusOff) && stopped.faults.has(Fault::kPressureMissing));
  assert_int_equal(describe({}, {}, {}).fault, Fault::kNone);
  assert_true(describe({}, {}, {}).faults.empty());
}

/// The request's fault is there now and blocks; the latched one was, and only says so.
void what_blocks_is_what_is_there(void**) {
  ModeRequest request;
  request.automatic = true;
  request.fault = Fault::kCycleStalled;
  const MachineStatus status = describe({EcuMode::kFault, Fault::kBusOff}, request, {});
  const auto blocks = [&status](ArmBlock block) {
    return (status.why_not_armed & (1U << static_cast<unsigned>(block))) != 0U;
  };
  assert_true(status.faults.has(Fault::kCycleStalled) && status.faults.has(Fault::kBusOff));
  assert_true(blocks(ArmBlock::kCycle) && blocks(ArmBlock::kFaultLatched));
  assert_false(blocks(ArmBlock::kBus));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_first_fault_is_named),
      cmocka_unit_test(a_mode_that_changed_in_memory_is_a_fault),
      cmocka_unit_test(each_part_of_the_request_has_its_source),
      cmocka_unit_test(a_spool_that_does_not_obey_cuts_the_pilot),
      cmocka_unit_test(the_cut_is_kept_after_its_cause),
      cmocka_unit_test(only_arming_ends_the_cut),
      cmocka_unit_test(the_pilot_is_known_from_arming_or_a_cut),
      cmocka_unit_test(what_stopped_it_is_named_before_what_slows),
      cmocka_unit_test(what_blocks_is_what_is_there),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
