// SPDX-License-Identifier: Apache-2.0
// An area that is dug in layers, paused in the air, within a cut and with a full bucket in every
// way that there is: the dig goes on where it was.

#include <algorithm>
#include <array>
#include <optional>

#include "app/runs/excavator_rig.hpp"
#include "app/runs/scenarios.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/memory_access.hpp"

/// What is dug stays so, but for soil that has fallen in and is swept.
void assert_kept(const CutState& before, const CutState& now) {
  for (std::size_t strip = 0; strip < now.height_m.size(); ++strip) {
    for (std::size_t bin = 0; bin < now.height_m[strip].size(); ++bin) {
      assert_true(now.height_m[strip][bin] <=
                  std::max(before.height_m[strip][bin], static_cast<float>(kRough_m)));
    }
  }
}

/// A shipped task in loam, whose first cut is done.
struct Digging {
  explicit Digging(const char* task) {
    scenario.task = task;
    scenario.soil = "loam";
    const machines::SimulatedExcavator machine = runs::arranged(
        machines::load_simulated_excavator(machines::find_profile("excavator_12t")), scenario);
    const TaskProgram program = runs::planned_task(scenario, machine.profile).result.program;
    TaskBook book;
    book.program[0] = program;
    book.count = 1;
    rig.emplace(machine, book, program.start, 1.0);
    run_until([this] { return task_state().dig.phase == CutPhase::kCuts; });
  }

  [[nodiscard]] const TaskState& task_state() {
    auto& controller = ControllerMemoryAccess::controller(*rig->ecu);
    return ControllerMemoryAccess::memory(controller)->motion.task.state;
  }
  [[nodiscard]] const ExcavatorStatus& status() const { return rig->ecu->outputs().status; }
  [[nodiscard]] bool is_done() const { return status().progress.kind == StepKind::kDone; }
  void step() {
    now_us += runs::AutodigRig::kPeriod_us;
    rig->step(now_us);
  }
  template <class Reached>
  void run_until(Reached&& reached) {
    const TimeUs latest_us = now_us + 120 * kSecondUs;
    do {
      step();
      assert_true(now_us < latest_us);
    } while (!reached());
  }
  /// The operator asks for no task for so long, and then for it anew.
  void rest(TimeUs pause_us) {
    rig->driver.set_schedule(
        {{0, {true, OperatorMode::kAutomatic, Task::kNone, 0.0}},
         {now_us + pause_us, {true, OperatorMode::kAutomatic, Task::kProgram, 1.0}}});
    const TimeUs until_us = now_us + pause_us;
    run_until([&] { return now_us > until_us; });
  }
  /// He lets go of the deadman, and a second later gives enable and task anew.
  void begin_anew() {
    rig->enable_from(now_us + kSecondUs);
    run_until([this] { return status().mode != EcuMode::kActive; });
  }
  /// His frames do not come, which is a fault.
  void be_silent() {
    rig->driver.set_silent(true);
    run_until([this] { return status().mode == EcuMode::kFault; });
    rig->driver.set_silent(false);
    begin_anew();
  }
  /// He drives by hand for a while.
  void drive_by_hand() {
    rig->driver.set_schedule({{0, {false, OperatorMode::kManual, Task::kNone, 0.0}}});
    repeat(200, [this] { step(); });
    begin_anew();
  }
  /// What was dug is known when the task runs again, and until it cuts again. From `reached` on: a
  /// bucket that has cut is emptied before that.
  template <class Stop, class Reached>
  void goes_on_after(Stop&& stop, Reached&& reached) {
    run_until([&] { return reached() || is_done(); });
    if (is_done()) {
      return;
    }
    ++pauses;
    const auto before = task_state().dug;
    stop();
    run_until([this] { return status().mode == EcuMode::kActive && status().progress.runs; });
    const Dug& dug = task_state().dug;
    assert_true(dug.begun && dug.touched);
    assert_near(dug.zero_m, before.zero_m, 0.0);
    assert_kept(before.cuts, dug.cuts);
    bool emptied = !before.loaded;
    run_until([&] {
      assert_true(status().mode == EcuMode::kActive);
      emptied = emptied || status().progress.kind == StepKind::kDump;
      return task_state().dig.phase == CutPhase::kEnters || is_done();
    });
    assert_true(emptied);
    assert_kept(before.cuts, dug.cuts);
  }
  /// In the middle of a cut.
  [[nodiscard]] bool cuts() {
    return task_state().dig.phase == CutPhase::kCuts && task_state().dig.share > 0.4;
  }
  [[nodiscard]] bool lifts() { return task_state().dig.phase == CutPhase::kLifts; }
  [[nodiscard]] bool swings() const { return status().progress.kind == StepKind::kSwing; }
  [[nodiscard]] bool returns() const { return status().progress.kind == StepKind::kReturnToDig; }

  runs::TaskScenario scenario;
  std::optional<runs::AutodigRig> rig;
  TimeUs now_us = 0;
  int pauses = 0;
};

constexpr std::array kAreas = {"trench", "slope", "level", "bench", "truck_loading"};
/// One of each way to go on from a cut: along a wall, down a slope, beside a truck.
constexpr std::array kAreasFromWithin = {"trench", "slope", "truck_loading"};

/// The operator's frames come every 20 ms: a pause of one cycle is goes_on_where_it_was's.
TEST(a_dig_goes_on_in_every_area) {
  for (const char* task : kAreas) {
    Digging dig(task);
    const auto returns = [&] { return dig.returns(); };
    for (const int cycles : {2, 100}) {
      dig.goes_on_after([&] { dig.rest(cycles * runs::AutodigRig::kPeriod_us); }, returns);
    }
    dig.goes_on_after([&] { dig.be_silent(); }, returns);
    dig.goes_on_after([&] { dig.drive_by_hand(); }, [&] { return dig.swings(); });
    print_message("%s: %d pauses, %d cuts\n", task, dig.pauses, dig.task_state().dug.cuts.cuts);
    assert_true(dig.pauses >= 3);  // The smallest area has four cuts.
  }
}

/// It is lifted out and emptied first; so is a full bucket in the air.
TEST(a_dig_goes_on_from_within_the_ground) {
  for (const char* task : kAreasFromWithin) {
    Digging dig(task);
    dig.goes_on_after([&] { dig.rest(2 * runs::AutodigRig::kPeriod_us); },
                      [&] { return dig.cuts(); });
    dig.goes_on_after([&] { dig.rest(100 * runs::AutodigRig::kPeriod_us); },
                      [&] { return dig.swings(); });
    dig.goes_on_after([&] { dig.be_silent(); }, [&] { return dig.lifts(); });
    print_message("%s: %d pauses, %d cuts\n", task, dig.pauses, dig.task_state().dug.cuts.cuts);
    assert_true(dig.pauses >= 2);
  }
}
