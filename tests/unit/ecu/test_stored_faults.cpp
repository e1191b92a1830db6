// SPDX-License-Identifier: Apache-2.0
// Stored faults from the cycle to the record: what counts, when, and with which frame.

#include <cstdint>
#include <string>

#include "app/ecu/store/frozen_fault.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/ecu/fault_process.hpp"

using namespace graben::test::stored;

TEST(occurrences_times_and_power_cycles_are_counted) {
  MemoryDisk disk;
  {
    Process process(disk, 1);
    assert_true(holds(process.begin_text, "new, nothing was there; power cycle 1, "));
    make_ready(process);  // until 2 s
    process.pulse(kOne, 3.0);
    process.pulse(kOne, 3.0);  // from 8 s on
    process.run(10.0);
    process.end();
  }
  FaultEntry entry = stored(disk).history.of(kOne);
  assert_int_equal(entry.occurrences, 2);
  assert_int_equal(entry.first_s, 2);
  assert_int_equal(entry.last_s, 8);
  assert_int_equal(entry.first_unix_s, kNoon_s + 2);
  assert_int_equal(entry.last_unix_s, kNoon_s + 8);
  assert_int_equal(stored(disk).history.cycles_since(kOne), 0);
  {
    // A process that starts again is no power cycle.
    Process again(disk, 1);
    assert_true(holds(again.begin_text, "read; power cycle 1, "));
    make_ready(again);
    again.end();
  }
  {
    Process process(disk, 2);
    assert_true(holds(process.begin_text,
                      "read; power cycle 2, 0 h of operation, faults stored: 1, freeze frames: 1"));
    process.clock_is_known = false;
    make_ready(process);
    process.pulse(kOther, 1.0);
    process.end();
  }
  const StoredFaults found = stored(disk);
  assert_int_equal(found.history.operation_s, 24 + 2 + 4);
  assert_int_equal(found.history.cycles_since(kOne), 1);
  assert_int_equal(found.history.cycles_since(kOther), 0);
  assert_int_equal(found.history.of(kOther).last_s, 28);
  assert_int_equal(found.history.of(kOther).last_unix_s, 0);
  assert_int_equal(found.history.stored(), 2);
}

TEST(a_frame_is_from_half_a_second_before_to_a_fifth_after) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  process.sample.mode = EcuMode::kActive;
  process.sample.pressure_pa[2] = 2.5e6F;
  process.sample.duty_ratio[3] = -0.25F;
  process.sample.lambda = 0.75F;
  process.run(1.0);
  process.faults.add(kOne);
  process.sample.mode = EcuMode::kFault;
  process.run(10.0);
  const StoredFaults found = stored(disk);
  assert_int_equal(found.frames.size(), 1);
  const StoredFrame& frame = found.frames[0];
  assert_true(frame.fault == kOne && frame.kind == SampleKind::kExcavator);
  assert_int_equal(frame.operation_s, 3);
  assert_int_equal(frame.unix_s, kNoon_s + 3);
  assert_int_equal(frame.count, 36);
  assert_true(frame.sample[0].now_us >= -500'000 && frame.sample[0].now_us < -480'000);
  assert_true(frame.sample[35].now_us > 180'000 && frame.sample[35].now_us <= 200'000);
  for (std::size_t i = 0; i < frame.count; ++i) {
    const CycleSample& sample = frame.sample[i];
    assert_int_equal(sample.now_us, frame.sample[0].now_us + static_cast<TimeUs>(i) * 20'000);
    assert_true(sample.mode == (sample.now_us < 0 ? EcuMode::kActive : EcuMode::kFault));
    assert_near(sample.stroke[0], 3.0 + static_cast<double>(sample.now_us) / 1e6, 1e-6);
    assert_near(sample.pressure_pa[2], 2.5e6, 0.0);
    assert_near(sample.duty_ratio[3], -0.25, 0.0);
    assert_near(sample.lambda, 0.75, 0.0);
    assert_int_equal(sample.known, 1);
  }
}

TEST(the_last_faults_sample_is_at_hand_until_it_is_forgotten) {
  MemoryDisk disk;
  Process process(disk);
  assert_true(frozen_of(process.recorder().last()).fault == Fault::kNone);
  make_ready(process);
  process.pulse(kOne, 1.0);
  process.sample.pressure_pa[7] = 31.25e6F;
  process.sample.duty_ratio[3] = -0.25F;
  process.sample.lambda = 0.75F;
  process.sample.mode = EcuMode::kActive;
  process.pulse(kOther, 1.0);
  const j1939::FrozenSample frozen = frozen_of(process.recorder().last());
  assert_true(frozen.fault == kOther);
  // What was not measured is not told.
  assert_int_equal(frozen.word[1], j1939::kNoWord);
  assert_int_equal(frozen.word[11], j1939::kNoWord);
  assert_int_equal(frozen.word[15], 29'500);
  assert_int_equal(frozen.word[16], 39'500);
  assert_int_equal(frozen.mode, static_cast<int>(EcuMode::kActive));
  FaultSet all;
  all.add(kOther);
  process.recorder().forget(all, process.now_us);
  assert_true(frozen_of(process.recorder().last()).fault == Fault::kNone);
}

TEST(what_was_learnt_comes_back_with_the_profile_and_not_with_another) {
  MemoryDisk disk;
  LearntDrives learnt{};
  learnt[1] = {0.0125, -0.01};
  learnt[3].retract = -0.07;
  {
    Process process(disk);
    assert_true(holds(process.begin_text, "; what was learnt: new"));
    assert_true(process.rings().learnt.put(record_of(learnt)));
    process.run(1.0);
    process.end();
  }
  Process again(disk);
  assert_true(holds(again.begin_text, "; what was learnt: read"));
  LearntDrives found{};
  assert_true(learnt_from(again.keeper().history().learnt, found));
  assert_true(is_sound(found));
  for (std::size_t i = 0; i < found.size(); ++i) {
    assert_near(found[i].extend, learnt[i].extend, 1e-7);
    assert_near(found[i].retract, learnt[i].retract, 1e-7);
  }
  // A run that has learnt nothing yet takes nothing away.
  assert_true(again.rings().learnt.put(record_of(LearntDrives{})));
  again.run(1.0);
  again.end();
  assert_true(learnt_from(stored(disk).history.learnt, found));
  Process other(disk, 1, kProfile + 1);
  assert_true(holds(other.begin_text, "; what was learnt: new"));
  assert_int_equal(other.keeper().history().learnt.count, 0);
}

TEST(a_record_without_it_or_with_more_has_nothing_learnt) {
  FaultHistory history;
  history.operation_s = 77;
  history.of(kOne).occurrences = 3;
  history.learnt.count = LearntRecord::kMost;
  history.learnt.value.fill(0.01F);
  std::array<std::uint8_t, kMostPayloadBytes> payload{};
  const std::size_t length = write_history(history, payload.data());
  FaultHistory found;
  assert_true(read_history(payload.data(), length, found));
  assert_int_equal(found.learnt.count, LearntRecord::kMost);
  constexpr std::size_t kSiteBytes = 4;
  const std::size_t at = length - kSiteBytes - 2 - 4 * LearntRecord::kMost;
  // One of an earlier version ends before it; one that is cut is none.
  assert_true(read_history(payload.data(), at, found));
  assert_int_equal(found.of(kOne).occurrences, 3);
  assert_int_equal(found.learnt.count, 0);
  assert_true(read_history(payload.data(), length - kSiteBytes, found));
  assert_int_equal(found.learnt.count, LearntRecord::kMost);
  assert_int_equal(found.left_site, 0);
  for (const std::size_t left : {at + 1, at + 2, length - kSiteBytes - 1, length - 1}) {
    assert_false(read_history(payload.data(), left, found));
  }
  payload[at] = LearntRecord::kMost + 1;
  assert_true(read_history(payload.data(), length, found));
  assert_int_equal(found.learnt.count, 0);
}

TEST(a_sample_is_told_in_its_units) {
  FaultSample from;
  from.fault = kOne;
  from.sample.known = 0x0801;
  from.sample.stroke[0] = 1.2345F;
  from.sample.pressure_pa[7] = 31.25e6F;
  const j1939::FrozenSample frozen = frozen_of(from);
  assert_int_equal(frozen.word[0], 44'345);
  assert_int_equal(frozen.word[11], 31'250);
  assert_int_equal(frozen.word[4], j1939::kNoWord);
}

TEST(faults_that_come_together_have_each_their_frame) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  process.faults.add(kOne);
  process.faults.add(kOther);
  process.run(10.0);
  const StoredFaults found = stored(disk);
  assert_int_equal(found.frames.size(), 2);
  assert_true(found.frames[0].fault == kOne && found.frames[1].fault == kOther);
  assert_int_equal(found.frames[0].sample[0].now_us, found.frames[1].sample[0].now_us);
}

TEST(what_is_cleared_is_forgotten_on_the_disk_too_with_its_frame) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  process.pulse(kOne, 5.0);
  process.faults.add(kOther);
  process.run(5.0);
  assert_int_equal(process.recorder().stored()[static_cast<std::size_t>(kOne)], 1);
  assert_int_equal(stored(disk).frames.size(), 2);
  FaultSet cleared;
  cleared.add(kOne);
  cleared.add(kOther);
  assert_true(process.recorder().can_forget());
  process.recorder().forget(cleared, process.now_us);
  process.run(10.0);
  assert_int_equal(stored(disk).history.stored(), 0);
  assert_int_equal(stored(disk).frames.size(), 0);
  // One that is there has not come again by that; one that comes again has a new frame.
  process.faults.add(kOne);
  while (stored(disk).history.stored() == 0) {
    process.run(0.1);
  }
  assert_int_equal(stored(disk).frames.size(), 0);
  process.run(10.0);
  assert_int_equal(stored(disk).history.of(kOther).occurrences, 0);
  assert_int_equal(stored(disk).history.of(kOne).occurrences, 1);
  assert_int_equal(stored(disk).frames.size(), 1);
  assert_int_equal(stored(disk).frames[0].operation_s, 27);
  process.end();
  FaultRecorder again(nullptr);
  again.begin(stored(disk).history);
  assert_int_equal(again.stored()[static_cast<std::size_t>(kOne)], 1);
  assert_int_equal(again.stored()[static_cast<std::size_t>(kOther)], 0);
}

TEST(a_frame_of_what_was_cleared_is_in_the_way_of_none) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  process.run(10.0);
  process.faults.add(kOne);
  process.run(0.3);
  process.faults.remove(kOne);
  process.run(0.1);
  FaultSet cleared;
  cleared.add(kOne);
  process.recorder().forget(cleared, process.now_us);
  process.run(20.0);
  assert_int_equal(stored(disk).history.stored(), 0);
  process.pulse(kOne, 5.0);
  const StoredFaults found = stored(disk);
  assert_int_equal(found.frames.size(), 1);
  assert_int_equal(found.frames[0].operation_s, found.history.of(kOne).first_s);
}

TEST(a_frame_of_another_time_is_not_that_of_a_fault) {
  MemoryDisk disk;
  {
    Process process(disk, 1);
    make_ready(process);
    process.run(100.0);
    process.pulse(kOne, 5.0);
    process.end();
  }
  {
    Process other(disk, 2, kProfile + 1);
    make_ready(other);
    other.end();
  }
  Process process(disk, 3);
  assert_true(holds(process.begin_text, "faults stored: 0, freeze frames: 0"));
  make_ready(process);
  process.faults.add(kOne);
  while (stored(disk).history.stored() == 0) {
    process.run(0.1);
  }
  assert_int_equal(stored(disk).frames.size(), 0);
  process.run(1.0);
  assert_int_equal(stored(disk).frames.size(), 1);
}

TEST(a_history_whose_disk_comes_late_goes_on) {
  MemoryDisk disk;
  {
    Process process(disk, 1);
    make_ready(process);  // until 2 s
    process.pulse(kOne, 3.0);
    process.pulse(kOther, 3.0);
    process.end();  // at 14 s
  }
  disk.is_there = false;
  Process process(disk, 2);
  make_ready(process);
  process.pulse(kOne, 3.0);  // from 2 s on
  FaultSet cleared;
  cleared.add(kOther);
  process.recorder().forget(cleared, process.now_us);
  process.run(1.0);
  assert_true(process.keeper().is_failing());
  said().clear();
  disk.is_there = true;
  process.run(61.0);
  assert_false(process.keeper().is_failing());
  assert_true(holds(said(),
                    "store: the disk is there now: read; power cycle 2, 0 h of operation, "
                    "faults stored: 1, freeze frames: 1; what was learnt: new; damaged files: 0"));
  StoredFaults found = stored(disk);
  assert_true(found.history.operation_s >= 14 + 61 && found.history.operation_s <= 14 + 70);
  assert_int_equal(found.history.power_cycles, 2);
  assert_int_equal(found.history.stored(), 1);
  const FaultEntry& entry = found.history.of(kOne);
  assert_int_equal(entry.occurrences, 2);
  assert_true(entry.first_s == 2 && entry.last_s == 14 + 2);
  assert_true(entry.first_unix_s == kNoon_s + 2 && entry.last_unix_s == kNoon_s + 2);
  assert_int_equal(found.history.cycles_since(kOne), 0);
  assert_int_equal(found.frames.size(), 1);
  assert_int_equal(found.frames[0].operation_s, 14 + 2);
  assert_int_equal(process.recorder().stored()[static_cast<std::size_t>(kOne)], 2);
  assert_int_equal(process.recorder().stored()[static_cast<std::size_t>(kOther)], 0);
  // It goes and comes again: none is counted twice.
  disk.is_there = false;
  process.pulse(kOne, 10.0);
  disk.is_there = true;
  process.run(70.0);
  assert_int_equal(stored(disk).history.of(kOne).occurrences, 3);
  assert_int_equal(process.recorder().stored()[static_cast<std::size_t>(kOne)], 3);
  assert_int_equal(stored(disk).history.power_cycles, 2);
}

TEST(at_power_on_a_node_may_be_missing_for_a_while) {
  MemoryDisk disk;
  Process process(disk);
  process.faults.add(kOne);
  process.run(9.0);
  process.faults.remove(kOne);
  process.faults.add(kOther);
  process.run(9.0);
  process.end();
  assert_int_equal(stored(disk).history.of(kOne).occurrences, 0);
  assert_int_equal(stored(disk).history.of(kOther).occurrences, 1);
  assert_int_equal(stored(disk).history.of(kOther).first_s, 10);
}

TEST(what_goes_missing_at_the_end_is_no_fault) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  process.sample.mode = EcuMode::kStopping;
  process.faults.add(kOne);
  process.run(1.0);
  process.end();
  assert_int_equal(stored(disk).history.stored(), 0);
}

TEST(another_profile_is_another_machine) {
  MemoryDisk disk;
  {
    Process process(disk, 1);
    make_ready(process);
    process.pulse(kOne, 5.0);
    process.end();
  }
  Process other(disk, 2, kProfile + 1);
  assert_true(holds(other.begin_text, "new, what was there is of another profile; power cycle 1"));
  assert_true(holds(other.begin_text, "freeze frames of another profile: 1"));
  make_ready(other);
  other.end();
  assert_int_equal(stored(disk).history.stored(), 0);
  assert_int_equal(stored(disk).profile_hash, kProfile + 1);
  assert_int_equal(stored(disk).frames.size(), 0);
  // The same fault, whose own frame is not written yet, has not that of the other machine.
  other.faults.add(kOne);
  while (stored(disk).history.stored() == 0) {
    other.run(0.1);
  }
  assert_int_equal(stored(disk).frames.size(), 0);
  other.run(1.0);
  assert_int_equal(stored(disk).frames.size(), 1);
}

TEST(a_damaged_store_starts_and_names_its_files) {
  MemoryDisk disk;
  {
    Process process(disk, 1);
    make_ready(process);
    process.pulse(kOne, 5.0);
    process.end();
  }
  disk.file("faults.a")[40] ^= 1;
  assert_true(holds(Process(disk, 2).begin_text, "; damaged: faults.a (the other copy counts)"));
  disk.file("faults.b")[40] ^= 1;
  disk.file("frame-001.a")[40] ^= 1;
  Process process(disk, 2);
  assert_string_equal(process.begin_text.c_str(),
                      "new, what was there is damaged; power cycle 1, 0 h of operation, faults "
                      "stored: 0, freeze frames: 0; what was learnt: new; damaged: faults.a, "
                      "faults.b, frame-001.a");
  const StoredFaults found = stored(disk);
  assert_false(found.has_history);
  assert_int_equal(found.damaged.size(), 3);
  assert_string_equal(found.damaged[2].c_str(), "frame-001.a");
}
