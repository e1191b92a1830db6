// Faults on the bus while the excavator digs: what is wrong is counted and moves nothing, what is
// missing ends in neutral spools.

#include <cmath>
#include <functional>

#include "app/cli/dig_bench.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/e2e.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben;
using cli::DigBench;
namespace bus = dbc::excavator;

const machines::ExcavatorMachine& machine() {
  static const machines::ExcavatorMachine loaded =
      machines::load_excavator(machines::find_profile("excavator_22t"));
  return loaded;
}

/// A dig under way for two seconds, all spools in use.
struct Digging {
  DigBench bench{machine(), Eigen::Vector3d(1.16, 1.25, 0.24), 1.0};
  TimeUs now_us = 0;

  Digging() {
    run(2 * kSecondUs);
    assert_int_equal(mode(), EcuMode::kActive);
    assert_true(bench.plant.spools_enabled());
  }
  void run(TimeUs duration_us) {
    for (const TimeUs end_us = now_us + duration_us; now_us < end_us;
         now_us += DigBench::kPeriod_us) {
      static_cast<void>(bench.step(now_us));
    }
  }
  EcuMode mode() const { return bench.ecu.outputs().status.mode; }
  Fault fault() const { return bench.ecu.outputs().status.fault; }
  bool neutral() const {
    const ExcavatorOutputs& outputs = bench.ecu.outputs();
    double opening = 0.0;
    for (const double duty : outputs.duty_ratio) {
      opening += std::abs(duty);
    }
    return !outputs.enable && opening == 0.0;
  }
};

bool keep(CanFrame&) { return true; }

/// Runs every frame of one message through `change` for this long.
void tamper(Digging& digging, std::uint32_t id, TimeUs duration_us,
            const std::function<bool(CanFrame&)>& change) {
  digging.bench.bus.set_fault_hook([id, &change](CanFrame& frame, const LoopbackPort*) {
    return frame.id == id ? change(frame) : keep(frame);
  });
  digging.run(duration_us);
  digging.bench.bus.set_fault_hook(nullptr);
}

struct Required {
  std::uint32_t id;
  Fault fault;
};
constexpr Required kRequired[] = {
    {bus::BoomStroke::kId, Fault::kStrokeMissing},
    {bus::ArmStroke::kId, Fault::kStrokeMissing},
    {bus::BucketStroke::kId, Fault::kStrokeMissing},
    {bus::BoomPressure::kId, Fault::kPressureMissing},
    {bus::ArmPressure::kId, Fault::kPressureMissing},
    {bus::BucketPressure::kId, Fault::kPressureMissing},
    {bus::PumpState::kId, Fault::kSwashMissing},
    {bus::EEC1::kId, Fault::kEngineSpeedMissing},
    {bus::OperatorCommand::kId, Fault::kOperatorMissing},
};

/// One lost frame is bridged; 50 ms without any required message ends in neutral, within that time,
/// and stays so when the message comes back.
void a_message_missing_for_50_ms_is_neutral(void**) {
  for (const Required& row : kRequired) {
    Digging digging;
    tamper(digging, row.id, DigBench::kPeriod_us, [](CanFrame&) { return false; });
    assert_int_equal(digging.mode(), EcuMode::kActive);
    digging.run(200 * kMillisecondUs);
    assert_int_equal(digging.mode(), EcuMode::kActive);
    // The last good frame lies up to one cycle time of its message back.
    tamper(digging, row.id, 50 * kMillisecondUs, [](CanFrame&) { return false; });
    assert_true(digging.neutral());
    assert_int_equal(digging.mode(), EcuMode::kFault);
    assert_int_equal(digging.fault(), row.fault);
    digging.run(500 * kMillisecondUs);
    assert_true(digging.neutral());
    assert_false(digging.bench.plant.spools_enabled());
  }
}

/// After a fault the operator has to let go and enable afresh.
void a_fault_is_left_by_re_arming_only(void**) {
  Digging digging;
  tamper(digging, bus::ArmStroke::kId, 100 * kMillisecondUs, [](CanFrame&) { return false; });
  assert_true(digging.neutral());
  digging.bench.release();
  digging.run(300 * kMillisecondUs);
  assert_int_equal(digging.mode(), EcuMode::kReady);
  digging.bench.enable_from(digging.now_us);
  digging.run(300 * kMillisecondUs);
  assert_int_equal(digging.mode(), EcuMode::kActive);
}

void released_enable_is_neutral_with_its_first_frame(void**) {
  Digging digging;
  digging.bench.release();
  digging.run(2 * DigBench::kPeriod_us);
  assert_true(digging.neutral());
  digging.run(DigBench::kPeriod_us);
  assert_false(digging.bench.plant.spools_enabled());
}

/// A boom stroke that is half a metre off, in a frame that is wrong in one way.
bus::BoomStroke wrong_stroke() {
  bus::BoomStroke message;
  message.boom_stroke_m = {0.5, dbc::RawState::kValid};
  return message;
}

struct Corruption {
  const char* name;
  std::function<bool(CanFrame&)> change;
  std::uint32_t LinkCounters::*counter;
};

const Corruption kCorruptions[] = {
    {"CRC",
     [](CanFrame& frame) {
       frame.data[2] = static_cast<std::uint8_t>(frame.data[2] ^ 0x40u);
       return true;
     },
     &LinkCounters::wrong_crc},
    {"length",
     [](CanFrame& frame) {
       frame.length = 7;
       return true;
     },
     &LinkCounters::wrong_length},
    {"remote",
     [](CanFrame& frame) {
       frame.remote = true;
       return true;
     },
     &LinkCounters::wrong_kind},
    {"counter",
     [jump = 0u](CanFrame& frame) mutable {
       // The right CRC over a counter that jumps ahead by 8 from frame to frame.
       jump += 7u;
       const auto counter = static_cast<std::uint8_t>(((frame.data[1] & 0x0Fu) + jump) % 15u);
       frame.data = wrong_stroke().encode();
       e2e_protect(frame.data, bus::BoomStroke::kDataId, counter);
       return true;
     },
     &LinkCounters::wrong_counter},
    {"range",
     [](CanFrame& frame) {
       // 3.21 m: a valid raw value beyond the signal's maximum of 3.2 m, counter and CRC right.
       const auto counter = static_cast<std::uint8_t>(frame.data[1] & 0x0Fu);
       frame.data[2] = 0xC8;
       frame.data[3] = 0xFA;
       e2e_protect(frame.data, bus::BoomStroke::kDataId, counter);
       return true;
     },
     &LinkCounters::out_of_range},
};

/// Each is counted under its name, its value never reaches the controller, and one alone does not
/// stop the work; 50 ms of them do.
void wrong_frames_are_counted_and_never_used(void**) {
  for (const Corruption& row : kCorruptions) {
    print_message("wrong %s\n", row.name);
    Digging digging;
    const double before_m = digging.bench.ecu.inputs().axis[kBoom].stroke_m.value;
    const std::uint32_t counted = digging.bench.ecu.link().*row.counter;
    tamper(digging, bus::BoomStroke::kId, DigBench::kPeriod_us, row.change);
    assert_int_equal(digging.bench.ecu.link().*row.counter, counted + 1);
    assert_near(digging.bench.ecu.inputs().axis[kBoom].stroke_m.value, before_m, 0.0);
    assert_int_equal(digging.mode(), EcuMode::kActive);
    tamper(digging, bus::BoomStroke::kId, 50 * kMillisecondUs, row.change);
    assert_near(digging.bench.ecu.inputs().axis[kBoom].stroke_m.value, before_m, 0.002);
    assert_true(digging.neutral());
    assert_int_equal(digging.fault(), Fault::kStrokeMissing);
  }
}

/// A flood of frames that are not ours changes nothing.
void foreign_frames_change_nothing(void**) {
  Digging digging;
  Digging undisturbed;
  digging.bench.bus.set_tap(nullptr);
  for (int n = 0; n < 50; ++n) {
    for (std::uint32_t k = 0; k < 120; ++k) {
      CanFrame frame;
      frame.id = 0x18FE0000u + k;
      frame.extended = true;
      frame.length = 8;
      digging.bench.bus.inject(frame);
    }
    digging.run(DigBench::kPeriod_us);
    undisturbed.run(DigBench::kPeriod_us);
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_near(digging.bench.plant.plant().strokes_m()[i],
                undisturbed.bench.plant.plant().strokes_m()[i], 0.0);
  }
}

/// The controller's process hangs while the operator lets go: what queued up meanwhile is stale,
/// and nothing moves on it.
void a_stalled_controller_does_not_act_on_old_frames(void**) {
  Digging digging;
  for (int n = 0; n < 14; ++n, digging.now_us += DigBench::kPeriod_us) {
    digging.bench.bus.set_time(digging.now_us);
    digging.bench.plant.step(digging.now_us);
    digging.bench.driver.step(digging.now_us);
  }
  digging.bench.release();
  digging.run(DigBench::kPeriod_us);
  assert_true(digging.neutral());
  assert_int_equal(digging.mode(), EcuMode::kFault);
}

/// A machine that names another profile is not moved, however long enable is asked for.
void another_machine_is_never_armed(void**) {
  DigBench bench(machine(), Eigen::Vector3d(1.16, 1.25, 0.24), 1.0);
  bench.bus.set_fault_hook([](CanFrame& frame, const LoopbackPort*) {
    if (frame.id == bus::MachineIdentity::kId) {
      frame.data[0] = static_cast<std::uint8_t>(frame.data[0] ^ 0x55u);
    }
    return true;
  });
  for (TimeUs now_us = 0; now_us < 3 * kSecondUs; now_us += DigBench::kPeriod_us) {
    static_cast<void>(bench.step(now_us));
    assert_false(bench.ecu.outputs().enable);
  }
  assert_int_equal(bench.ecu.outputs().status.mode, EcuMode::kSilent);
  assert_int_equal(bench.ecu.outputs().status.fault, Fault::kIdentityMismatch);
}

/// After neutral no cylinder runs on: what moves is the spool's closing and the oil's spring.
void neutral_stops_the_machine(void**) {
  Digging digging;
  digging.bench.release();
  digging.run(30 * kMillisecondUs);
  digging.run(kSecondUs);
  const auto stopped_m = digging.bench.plant.plant().strokes_m();
  digging.run(kSecondUs);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_near(digging.bench.plant.plant().strokes_m()[i], stopped_m[i],
                0.01 * machine().profile.geometry.cylinder[i].stroke_m);
  }
}

/// The controller's frames stop: the valve side closes by itself after its 100 ms.
void a_silent_controller_is_closed_by_the_valve_side(void**) {
  Digging digging;
  tamper(digging, bus::SpoolCommand::kId, 120 * kMillisecondUs, [](CanFrame&) { return false; });
  assert_false(digging.bench.plant.spools_enabled());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_message_missing_for_50_ms_is_neutral),
      cmocka_unit_test(a_fault_is_left_by_re_arming_only),
      cmocka_unit_test(released_enable_is_neutral_with_its_first_frame),
      cmocka_unit_test(wrong_frames_are_counted_and_never_used),
      cmocka_unit_test(foreign_frames_change_nothing),
      cmocka_unit_test(a_stalled_controller_does_not_act_on_old_frames),
      cmocka_unit_test(another_machine_is_never_armed),
      cmocka_unit_test(neutral_stops_the_machine),
      cmocka_unit_test(a_silent_controller_is_closed_by_the_valve_side),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
