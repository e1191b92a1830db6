// SPDX-License-Identifier: Apache-2.0
// Stored faults from the cycle to the record: what counts, when, with which frame, and what it
// wears.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/ecu/store/fault_keeper.hpp"
#include "app/ecu/store/fault_recorder.hpp"
#include "app/ecu/store/stored_faults.hpp"
#include "platform/linux/allocation_counter.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/ecu/memory_disk.hpp"

namespace {

using namespace graben::ecu;
using graben::test::MemoryDisk;

constexpr TimeUs kCycleUs = 10 * kMillisecondUs;
constexpr TimeUs kWorkUs = 100 * kMillisecondUs;
constexpr std::uint32_t kProfile = 0xABCDEF01;
constexpr std::uint32_t kNoon_s = 1'800'000'000;
constexpr Fault kOne = Fault::kStrokeMissing;
constexpr Fault kOther = Fault::kSwashMissing;

std::string& said() {
  static std::string lines;
  return lines;
}

/// A controller's process on a disk: cycles, and the store's thread beside it, every 100 ms.
class Process {
 public:
  explicit Process(MemoryDisk& disk, std::uint32_t boot = 1, std::uint32_t profile = kProfile)
      : store_(disk, profile),
        keeper_(store_, *rings_, SampleKind::kExcavator, [](const char* line) { said() += line; }) {
    begin_text = keeper_.begin(now_us, boot);
  }

  void cycle() {
    sample.now_us = now_us;
    sample.stroke[0] = static_cast<float>(now_us) / 1e6F;
    sample.known = 1;
    recorder_.look(sample, faults);
    if (now_us % kWorkUs == 0) {
      keeper_.work(now_us, wall());
    }
    now_us += kCycleUs;
  }
  void run(double seconds) {
    repeat(std::lround(seconds * 100.0), [&] { cycle(); });
  }
  /// The store's thread alone; nothing comes.
  void idle(double seconds) {
    repeat(std::lround(seconds * 10.0), [&] {
      now_us += kWorkUs;
      keeper_.work(now_us, wall());
    });
  }
  void pulse(Fault fault, double seconds) {
    faults.add(fault);
    run(seconds);
    faults.remove(fault);
    run(seconds);
  }
  void end() { keeper_.finish(now_us, wall()); }
  [[nodiscard]] const FaultKeeper& keeper() const { return keeper_; }
  [[nodiscard]] FaultRings& rings() { return *rings_; }

  CycleSample sample;
  FaultSet faults;
  TimeUs now_us = 0;
  bool clock_is_known = true;
  std::string begin_text;

 private:
  [[nodiscard]] std::uint32_t wall() const {
    return clock_is_known ? kNoon_s + static_cast<std::uint32_t>(now_us / kSecondUs) : 0;
  }

  Store store_;
  std::unique_ptr<FaultRings> rings_ = std::make_unique<FaultRings>();
  FaultKeeper keeper_;
  FaultRecorder recorder_{*rings_};
};

/// One that has been ready, as after power-on.
void make_ready(Process& process) {
  process.sample.mode = EcuMode::kReady;
  process.run(2.0);
}

StoredFaults stored(MemoryDisk& disk) { return read_stored_faults(disk); }

bool holds(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

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
  // A frame that is another machine's is not shown beside it.
  assert_int_equal(stored(disk).frames.size(), 0);
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
                      "stored: 0, freeze frames: 0; damaged: faults.a, faults.b, frame-001.a");
  const StoredFaults found = stored(disk);
  assert_false(found.has_history);
  assert_int_equal(found.damaged.size(), 3);
  assert_string_equal(found.damaged[2].c_str(), "frame-001.a");
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

TEST(a_thread_that_does_not_come_loses_what_is_counted) {
  MemoryDisk disk;
  Process process(disk);
  make_ready(process);
  FaultRecorder recorder(process.rings());
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
    FaultEvent event{static_cast<Fault>(1 + pulses % (kFaultCount - 1)), process.now_us};
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
  FaultRecorder recorder(process.rings());
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
    assert_false(read_history(bytes.data(), shorter, history));
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
