// SPDX-License-Identifier: Apache-2.0
// A limit from outside in motion, both kinds, each task: in the cycle in which it is heard nothing
// is asked to be faster than it, and nothing in another direction.

#include <random>

#include "tests/unit/firmware/grading_dozer.hpp"
#include "tests/unit/firmware/task_machine.hpp"
#include "tests/unit/rounds.hpp"

using Memory = ControllerMemoryAccess;

constexpr std::uint8_t kSource = 3;
/// Speeds are products of the same numbers in another order.
constexpr double kRounding = 1e-9;

/// Each of them to its end.
const Eigen::Array4d kLevers{1.0, -1.0, 1.0, -1.0};

/// A word at random; every tenth is a stop that the operator has to end.
struct Words {
  std::mt19937 random;

  explicit Words(unsigned seed) : random(seed) {}
  [[nodiscard]] unsigned any(unsigned count) { return static_cast<unsigned>(random() % count); }
  [[nodiscard]] ExternalWord next() {
    ExternalWord word{ExternalLevel::kSlow, true, kSource, 0.005 * any(201), 0.25};
    const unsigned what = any(10);
    if (what < 4) {
      word.level = what < 2 ? ExternalLevel::kFree : ExternalLevel::kStop;
    }
    word.resumes = what != 2 || any(3) != 0;
    return word;
  }
};

double most_of(const ExternalWord& word) {
  return word.level == ExternalLevel::kFree   ? 1.0
         : word.level == ExternalLevel::kSlow ? word.speed_ratio
                                              : 0.0;
}

/// An excavator in motion, and who limits it.
struct Watched {
  test::TaskMachine machine;
  std::array<double, kDriveCount> lever_ratio{};
  Signal<ExternalWord> external;

  Watched(const TaskBook& book, const DriveVector& start) : machine(book, start) {}

  [[nodiscard]] ExcavatorInputs inputs() const {
    ExcavatorInputs inputs = machine.inputs();
    inputs.lever_ratio = test::fresh(lever_ratio, machine.now_us);
    inputs.external = external;
    inputs.external.stamp_us = machine.now_us;
    return inputs;
  }
  const ExcavatorOutputs& step() { return machine.step(inputs()); }
  void hear(const ExternalWord& word) { external = {word, Validity::kValid, 0}; }
};

DriveVector asked_mps(Watched& watched) {
  return DriveVector(Memory::last(watched.machine.controller).asked_mps.data());
}

DriveVector wanted_mps(const Watched& watched) {
  return DriveVector(watched.machine.outputs.status.wanted_velocity_mps.data());
}

/// Half a second under way, nobody limits it.
Watched under_way(Task task) {
  static const TaskProgram program = test::program_of(test::level_dig());
  DriveVector start = program.start;
  start[kBoom] -= task == Task::kProgram ? 0.0 : 0.1;
  Watched watched(test::book_of({program}), start);
  watched.machine.driver.task.value = task;
  repeat(5, [&] { watched.step(); });
  std::copy_n(kLevers.data(), kDriveCount, watched.lever_ratio.begin());
  repeat(task == Task::kProgram ? 300 : 50, [&] { watched.step(); });
  assert_int_equal(watched.machine.outputs.status.mode, EcuMode::kActive);
  assert_true(watched.machine.outputs.status.faults.empty());
  assert_true(wanted_mps(watched).norm() > 0.05);
  return watched;
}

/// The same machine's next cycle, if nobody had ever limited it.
Watched unlimited(Watched twin) {
  auto& memory = Memory::memory(twin.machine.controller);
  memory->inputs.external = {};
  memory.seal();
  twin.external = {};
  twin.step();
  return twin;
}

/// One direction, or none.
void assert_scaled(const DriveVector& limited, const DriveVector& full, double ratio) {
  assert_true((limited - ratio * full).norm() <= kRounding);
}

void assert_stopped(const ExcavatorOutputs& outputs) {
  assert_false(outputs.enable);
  for (const double duty : outputs.duty_ratio) {
    assert_near(duty, 0.0, 0.0);
  }
}

/// In the levers' tasks of what full levers ask for, else of what it would ask for now.
void check_cycle(const Watched& before, Watched& now, double most) {
  const Task task = before.machine.driver.task.value;
  if (!is_by_lever(task)) {
    const Watched twin = unlimited(before);
    const double ratio = wanted_mps(now).norm() / std::max(1e-12, wanted_mps(twin).norm());
    assert_true(ratio <= most + kRounding);
    assert_scaled(wanted_mps(now), wanted_mps(twin), ratio);
  }
  if (most <= 0.0) {
    assert_true(asked_mps(now).isZero(0.0));
    assert_near(now.machine.outputs.status.lambda, 0.0, 0.0);
  }
}

HandSpeed hand_speed(Watched& watched) {
  return Memory::memory(watched.machine.controller)->motion.hand.speed;
}

/// What full levers come to, in the order of HandSpeed.
HandSpeed full_levers(const ExcavatorProfile& profile, Task task) {
  HandSpeed most = travel_of(profile, drive_limits(profile).speed_out);
  if (task == Task::kCoordinated) {
    most.head<3>() << profile.dig_speed_mps, 0.0, profile.control.attitude_rate_max_radps;
  }
  return most;
}

/// The first two have their speed together.
void check_hand(const HandSpeed& speed, const HandSpeed& full, double most) {
  assert_true(speed.head<2>().norm() <= most * full.head<2>().norm() + kRounding);
  assert_true((speed.array() * kLevers >= 0.0).all());
  for (int i = 2; i < kDriveCount; ++i) {
    assert_true(std::abs(speed[i]) <= most * std::abs(full[i]) + kRounding);
  }
}

/// Four words, each for some cycles: none of them is faster than its word.
void hear_words(const Watched& base, const HandSpeed& full, Words& words) {
  Watched watched = base;
  for (int word = 0; word < 4; ++word) {
    watched.hear(words.next());
    const ExternalWord& said = watched.external.value;
    const double most = most_of(said);
    for (unsigned n = 1 + words.any(6); n > 0; --n) {
      const Watched before = watched;
      const ExcavatorOutputs& outputs = watched.step();
      if (said.level == ExternalLevel::kStop && !said.resumes) {
        assert_int_equal(outputs.status.fault, Fault::kExternalStop);
        assert_int_equal(outputs.status.mode, EcuMode::kFault);
        assert_stopped(outputs);
        return;
      }
      assert_int_equal(outputs.status.mode, EcuMode::kActive);
      check_cycle(before, watched, most);
      check_hand(hand_speed(watched), full, most);
      if (most < 0.99) {
        assert_int_equal(outputs.status.limit.kind, LimitKind::kExternalLimit);
        assert_int_equal(outputs.status.limit.index, kSource);
      }
    }
  }
}

TEST(an_excavator_is_never_faster_than_a_word_in_any_task) {
  Words words(2101);
  for (const Task task :
       {Task::kDig, Task::kProgram, Task::kJog, Task::kCoordinated, Task::kAssist}) {
    const Watched base = under_way(task);
    const HandSpeed most = full_levers(base.machine.profile, task);
    repeat(test::rounds(200, 10), [&] { hear_words(base, most, words); });
  }
}

/// The speed comes back at 1/s, and the step goes on where it was held.
TEST(an_excavator_gets_faster_no_sooner_than_it_may) {
  Watched watched = under_way(Task::kProgram);
  watched.hear({ExternalLevel::kStop, true, kSource, 1.0, 0.25});
  repeat(30, [&] { watched.step(); });
  assert_true(asked_mps(watched).isZero(0.0));
  const TaskProgress held = watched.machine.outputs.status.progress;
  const auto step_ratio = [&] {
    const double full_mps = wanted_mps(unlimited(watched)).norm();
    watched.step();
    return wanted_mps(watched).norm() / full_mps;
  };
  watched.hear({ExternalLevel::kFree, false, kSource, 1.0, 0.25});
  for (int n = 1; n <= 90; ++n) {
    assert_near(step_ratio(), 0.01 * n, 1e-6);
  }
  repeat(20, [&] { watched.step(); });
  assert_near(step_ratio(), 1.0, 1e-6);
  assert_int_not_equal(watched.machine.outputs.status.limit.kind, LimitKind::kExternalLimit);
  assert_int_equal(watched.machine.outputs.status.progress.step, held.step);
  assert_true(watched.machine.outputs.status.progress.share > held.share);
}

/// A stop may last: it is no stall, and nothing that has waited jumps.
TEST(a_long_stop_is_no_stall) {
  Watched watched = under_way(Task::kProgram);
  watched.hear({ExternalLevel::kStop, true, kSource, 1.0, 0.25});
  repeat(7000, [&] { watched.step(); });
  assert_int_equal(watched.machine.outputs.status.mode, EcuMode::kActive);
  assert_true(watched.machine.outputs.status.faults.empty());
}

/// Both have to come: the source's word and the operator's.
TEST(a_stop_for_the_operator_waits_for_him) {
  Watched watched = under_way(Task::kProgram);
  watched.hear({ExternalLevel::kStop, false, kSource, 1.0, 0.25});
  assert_stopped(watched.step());
  watched.lever_ratio = {};
  const auto after = [&](bool enable, ExternalLevel level) {
    watched.machine.driver.enable.value = enable;
    watched.machine.driver.task.value = Task::kNone;
    watched.hear({level, false, kSource, 1.0, 0.25});
    watched.step();
    return watched.machine.outputs.status.mode;
  };
  assert_int_equal(after(true, ExternalLevel::kFree), EcuMode::kFault);
  assert_int_equal(after(false, ExternalLevel::kStop), EcuMode::kFault);
  const unsigned external = 1U << static_cast<unsigned>(ArmBlock::kExternal);
  assert_true((watched.machine.outputs.status.why_not_armed & external) != 0);
  assert_int_equal(after(false, ExternalLevel::kFree), EcuMode::kReady);
  assert_true((watched.machine.outputs.status.why_not_armed & external) == 0);
  assert_int_equal(after(true, ExternalLevel::kSlow), EcuMode::kArmed);
}

TEST(a_silent_source_stops_an_excavator) {
  Watched watched = under_way(Task::kProgram);
  watched.hear({ExternalLevel::kFree, false, kSource, 1.0, 0.1});
  watched.step();
  ExcavatorInputs inputs;
  for (int n = 1; n <= 11; ++n) {
    inputs = watched.inputs();
    inputs.external.stamp_us -= n * 10 * kMillisecondUs;
    assert_int_equal(watched.machine.step(inputs).status.mode,
                     n <= 10 ? EcuMode::kActive : EcuMode::kFault);
  }
  assert_int_equal(watched.machine.outputs.status.fault, Fault::kExternalSilent);
  assert_stopped(watched.machine.outputs);
}

/// A dozer and who limits it.
struct WatchedDozer {
  test::Grading grading;
  Signal<ExternalWord> external;

  const DozerOutputs& step() {
    DozerInputs inputs = grading.next();
    inputs.external = external;
    inputs.external.stamp_us = grading.now_us;
    grading.step(inputs);
    return grading.outputs;
  }
  void hear(const ExternalWord& word) { external = {word, Validity::kValid, 0}; }
};

void hear_words(const WatchedDozer& base, Words& words) {
  WatchedDozer watched = base;
  const double full_mps = watched.grading.profile.travel.speed_desired_mps;
  for (int word = 0; word < 4; ++word) {
    watched.hear(words.next());
    const ExternalWord& said = watched.external.value;
    const double most_mps = most_of(said) * full_mps;
    for (unsigned n = 1 + words.any(6); n > 0; --n) {
      const DozerOutputs& outputs = watched.step();
      if (said.level == ExternalLevel::kStop && !said.resumes) {
        test::assert_stopped_by(Fault::kExternalStop, outputs);
        return;
      }
      assert_int_equal(outputs.status.mode, EcuMode::kActive);
      assert_true(outputs.status.wanted_speed_mps >= 0.0);
      assert_true(outputs.status.wanted_speed_mps <= most_mps + kRounding);
      assert_true(outputs.pump_ratio[kLeft] >= 0.0 && outputs.pump_ratio[kRight] >= 0.0);
      if (most_of(said) <= 0.0) {
        assert_near(outputs.status.wanted_blade_mps, 0.0, 0.0);
        assert_near(outputs.pump_ratio[kLeft], 0.0, 0.0);
        assert_near(outputs.blade_duty_ratio, 0.0, 0.0);
      }
      if (most_of(said) < 0.99) {
        assert_int_equal(outputs.status.limit.kind, LimitKind::kExternalLimit);
        assert_int_equal(outputs.status.limit.index, kSource);
      }
    }
  }
}

TEST(a_dozer_is_never_faster_than_a_word) {
  Words words(2102);
  WatchedDozer base;
  repeat(150, [&] { base.step(); });
  assert_int_equal(base.grading.outputs.status.mode, EcuMode::kActive);
  repeat(test::rounds(200, 10), [&] { hear_words(base, words); });
}
