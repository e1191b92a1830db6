// SPDX-License-Identifier: Apache-2.0
// What stored faults cost and stand: wear, a disk that is full, a thread that is late, no heap,
// bytes that are no record.

#include <array>
#include <cmath>
#include <cstdint>

#include "platform/linux/allocation_counter.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/ecu/fault_process.hpp"

using namespace graben::test::stored;

TEST(without_a_store_it_is_counted_until_the_end) {
  FaultRecorder recorder(nullptr);
  CycleSample sample;
  sample.mode = EcuMode::kReady;
  for (int i = 0; i < 1000; ++i) {
    FaultSet faults;
    if (i % 2 == 0) {
      faults.add(kOne);
    }
    recorder.look(sample, faults);
    sample.now_us += kCycleUs;
  }
  assert_int_equal(recorder.stored()[static_cast<std::size_t>(kOne)], 126);
  FaultSet cleared;
  cleared.add(kOne);
  recorder.forget(cleared, sample.now_us);
  assert_int_equal(recorder.stored()[static_cast<std::size_t>(kOne)], 0);
}

TEST(a_full_disk_is_said_once_and_tried_again) {
  MemoryDisk disk;
  said().clear();
  Process process(disk);
  disk.is_full = true;
  make_ready(process);
  process.pulse(kOne, 90.0);
  assert_string_equal(said().c_str(),
                      "store: memory: No space left on device; control goes on, nothing is stored; "
                      "tried again each minute");
  assert_true(process.keeper().is_failing());
  assert_true(process.keeper().failures() >= 2 && process.keeper().failures() <= 4);
  disk.is_full = false;
  process.run(61.0);
  assert_false(process.keeper().is_failing());
  assert_int_equal(stored(disk).history.of(kOne).occurrences, 1);
}

TEST(a_fault_that_comes_and_goes_takes_no_frame_of_another) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  repeat(1000, [&] { process.pulse(kOne, 0.1); });
  process.faults.add(kOther);
  // The budget is empty, and its last 8 are not for frames.
  process.run(1200.0);
  const StoredFaults found = stored(disk);
  assert_int_equal(found.history.of(kOne).occurrences, 1000);
  assert_int_equal(found.history.lost, 0);
  assert_int_equal(found.frames.size(), 2);
}

namespace {

/// Both copies of its history are there; a new file has no room any more.
void fill_up(MemoryDisk& disk, Process& process) {
  said().clear();
  make_ready(process);
  process.pulse(kOther, 5.0);
  disk.takes_no_new = true;
  process.pulse(kOne, 5.0);
  assert_int_equal(stored(disk).history.of(kOne).occurrences, 1);
  assert_int_equal(stored(disk).frames.size(), 1);
}

}  // namespace

TEST(a_frame_without_room_waits_and_stops_no_history) {
  MemoryDisk disk;
  Process process(disk);
  fill_up(disk, process);
  assert_true(process.keeper().is_failing());
  assert_string_equal(said().c_str(),
                      "store: memory: No space left on device; a freeze frame waits, tried again "
                      "each minute");
  process.pulse(kOther, 5.0);
  assert_int_equal(stored(disk).history.of(kOther).occurrences, 2);
  assert_true(process.keeper().is_failing());
  disk.takes_no_new = false;
  process.run(70.0);
  assert_false(process.keeper().is_failing());
  assert_int_equal(stored(disk).frames.size(), 2);
  assert_int_equal(stored(disk).history.lost, 0);
}

TEST(a_frame_that_failed_and_was_cleared_fails_no_more) {
  MemoryDisk disk;
  Process process(disk);
  fill_up(disk, process);
  FaultSet cleared;
  cleared.add(kOne);
  process.recorder().forget(cleared, process.now_us);
  process.run(1.0);
  assert_false(process.keeper().is_failing());
}

TEST(an_end_while_a_frame_fails_writes_the_history_and_says_what_is_lost) {
  MemoryDisk disk;
  Process process(disk);
  fill_up(disk, process);
  process.pulse(kOther, 0.3);
  process.end();
  assert_int_equal(stored(disk).history.of(kOther).occurrences, 2);
  assert_true(holds(said(), "store: freeze frames lost with the end: 1"));
  assert_int_equal(process.keeper().dropped(), 1);
}

TEST(a_thread_that_does_not_come_loses_what_is_counted) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  FaultRecorder recorder(&process.rings());
  CycleSample sample;
  sample.mode = EcuMode::kReady;
  for (int i = 0; i < 400; ++i) {
    FaultSet faults;
    faults.add(i % 2 == 0 ? kOne : kOther);
    recorder.look(sample, faults);
    sample.now_us += kCycleUs;
  }
  assert_int_equal(process.rings().events.dropped(), 400 - 128);
  const std::uint32_t dropped = process.keeper().dropped();
  process.end();
  assert_int_equal(stored(disk).history.lost, dropped);
  assert_int_equal(stored(disk).history.of(kOne).occurrences, 64);
}

// The bound that the manual has, against the worst that a machine can do.
TEST(a_day_of_faults_that_come_and_go_stays_within_the_budget) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  const int before = disk.writes;
  std::uint32_t pulses = 0;
  while (process.now_us < kDayUs) {
    // Each second others of 60 faults, without the cycles between.
    FaultEvent event{static_cast<Fault>(1 + pulses % (kFaultCount - 1)), process.now_us, {}};
    static_cast<void>(process.rings().events.put(event));
    if (FreezeFrame* const frame = process.rings().frames.place()) {
      frame->faults = {};
      frame->faults.add(event.fault);
      frame->came_us = process.now_us;
      frame->count = 1;
      process.rings().frames.put();
    }
    ++pulses;
    process.idle(1.0);
  }
  process.end();
  assert_true(disk.writes - before <= kMostWritesADay);
  assert_true(disk.writes - before > kMostWritesADay * 9 / 10);
  assert_int_equal(stored(disk).history.of(kOne).occurrences,
                   (pulses + kFaultCount - 2) / (kFaultCount - 1));
}

TEST(a_process_that_starts_again_and_again_stops_writing) {
  MemoryDisk disk;
  for (std::uint32_t start = 0; start < 300; ++start) {
    Process process(disk, start + 1);
    process.sample.mode = EcuMode::kReady;
    process.run(0.2);
    process.faults.add(static_cast<Fault>(1 + start % 40));
    process.run(2.0);
    // As often as not it is killed.
    if (start % 2 == 0) {
      process.end();
    }
  }
  // 300 lives of 2.2 s are 11 minutes, of which none lasted until a write came back.
  assert_true(disk.writes <= kMostTokens);
  assert_int_equal(stored(disk).history.tokens, 0);
}

TEST(the_control_thread_takes_no_heap) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  FaultRecorder recorder(&process.rings());
  const ExcavatorInputs in;
  ExcavatorOutputs out;
  out.status.mode = EcuMode::kReady;
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 100; ++i) {
    out.status.faults = {};
    out.status.faults.add(i % 20 < 10 ? kOne : kOther);
    recorder.look(sample_of(in, out, i * kCycleUs), out.status.faults);
  }
  assert_int_equal(allocation_count(), before);
}

TEST(a_sample_has_what_was_valid_of_each_kind) {
  ExcavatorInputs in;
  ExcavatorOutputs out;
  in.axis[1].stroke_m = {0.5, Validity::kValid, 0};
  in.axis[2].rod_pressure_pa = {1e6, Validity::kValid, 0};
  in.axis[0].cap_pressure_pa = {3e6, Validity::kError, 0};
  in.swing.angle_rad = {std::nan(""), Validity::kValid, 0};
  in.swing.right_pressure_pa = {2e6, Validity::kValid, 0};
  out.duty_ratio = {0.1, 0.2, 0.3, 0.4};
  out.status.lambda = 0.5;
  out.status.mode = EcuMode::kActive;
  const CycleSample sample = sample_of(in, out, 7);
  assert_int_equal(sample.known, 1U << 1U | 1U << (4U + 5U) | 1U << (4U + 7U));
  assert_near(sample.stroke[1], 0.5, 1e-7);
  assert_near(sample.pressure_pa[5], 1e6, 0.1);
  assert_near(sample.pressure_pa[7], 2e6, 0.1);
  assert_near(sample.pressure_pa[0], 0.0, 0.0);
  assert_near(sample.duty_ratio[3], 0.4, 1e-7);
  assert_true(sample.mode == EcuMode::kActive && sample.now_us == 7);
  assert_string_equal(sample_names(SampleKind::kExcavator).pressure[5], "bucket_rod_pa");

  DozerInputs dozer;
  DozerOutputs driven;
  dozer.blade_stroke_m = {0.2, Validity::kValid, 0};
  dozer.track[1].line_pressure_pa = {4e6, Validity::kValid, 0};
  driven.blade_duty_ratio = -0.3;
  driven.pump_ratio = {0.6, 0.7};
  const CycleSample graded = sample_of(dozer, driven, 0);
  assert_int_equal(graded.known, 1U | 1U << 5U);
  assert_near(graded.duty_ratio[0], -0.3, 1e-7);
  assert_near(graded.duty_ratio[3], 0.7, 1e-7);
  assert_string_equal(sample_names(SampleKind::kDozer).duty[3], "right_pump");
  assert_null(sample_names(SampleKind::kDozer).stroke[2]);
}

TEST(bytes_that_are_no_record_are_refused) {
  std::array<std::uint8_t, kMostPayloadBytes> bytes{};
  FaultHistory history;
  history.add(kOne, 3, 4);
  const std::size_t length = write_history(history, bytes.data());
  assert_true(read_history(bytes.data(), length, history));
  assert_int_equal(history.of(kOne).last_unix_s, 4);
  for (std::size_t shorter = 0; shorter < length; ++shorter) {
    // Without its last four bytes it is one of an earlier version, which knew of no place that was
    // left, and without two more of one that knew of nothing learnt.
    const bool is_earlier = shorter == length - 4 || shorter == length - 6;
    assert_true(read_history(bytes.data(), shorter, history) == is_earlier);
  }
  StoredFrame frame;
  frame.fault = kOther;
  frame.count = 2;
  frame.sample[1].now_us = -20'000;
  const std::size_t whole = write_frame(frame, bytes.data());
  assert_true(read_frame(bytes.data(), whole, frame));
  assert_true(frame.fault == kOther && frame.sample[1].now_us == -20'000);
  for (std::size_t shorter = 0; shorter < whole; ++shorter) {
    assert_false(read_frame(bytes.data(), shorter, frame));
  }
  bytes[2] = 9;
  assert_false(read_frame(bytes.data(), whole, frame));
}
