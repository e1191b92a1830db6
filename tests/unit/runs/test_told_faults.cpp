// SPDX-License-Identifier: Apache-2.0
// Faults of the plant by name and time.

#include <array>
#include <cstring>
#include <new>
#include <set>
#include <stdexcept>
#include <string>

#include "app/runs/code_text.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/grade_run.hpp"
#include "app/runs/plant_faults.hpp"
#include "firmware/safety/cycle.hpp"
#include "firmware/safety/fault_table.hpp"
#include "platform/loopback/loopback_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::runs;

std::string refusal(const std::string& text) {
  return graben::test::refusal_of(
      [&] { return PlantFaultSchedule<plant::ExcavatorFaults>(excavator_plant_faults(), {text}); });
}

/// What was told and never came is an error; what came and was not seen is said.
TEST(what_came_of_the_told_faults_is_said) {
  assert_true(told_faults_text({}, {}, 10.0, false).empty());
  assert_true(told_faults_text({"a@1"}, {}, 10.0, true).empty());
  assert_true(told_faults_text({"outside:slow=0.3@1"}, {}, 10.0, false).empty());
  assert_true(graben::test::has(told_faults_text({"a@1", "b@2"}, {}, 10.0, false),
                                "a@1, b@2: the controller did not see it"));
  assert_true(graben::test::has(
      graben::test::refusal_of([] {
        static_cast<void>(told_faults_text({"a@1", "b@20"}, {"b@20"}, 10.5, true));
      }),
      "--fault b@20: the run ended at 10.50 s, before it came"));
}

TEST(texts_are_read) {
  const ToldFault drift = told_fault("boom-stroke:drift=-0.01@2.5");
  assert_string_equal(drift.name.c_str(), "boom-stroke:drift");
  assert_true(drift.value == -0.01);
  assert_int_equal(drift.at_us, 2500000);
  assert_true(told_fault("swing-angle:frozen@0").value == 0.0);
}

TEST(wrong_texts_are_refused) {
  const struct {
    const char* text;
    const char* says;
  } cases[] = {{"boom-stroke:frozen", "no time"},
               {"boom-stroke:frozen@", "no time in seconds"},
               {"boom-stroke:frozen@-1", "a time from 0"},
               {"boom-stroke:frozen@1e9", "a time from 0"},
               {"boom-stroke:frozen@nan", "no time in seconds"},
               {"boom-stroke:step=x@1", "'x' is no number"},
               {"boom-stroke:step=@1", "'' is no number"},
               {"boom-stroke:step=1mm@1", "'1mm' is no number"},
               {"boom-stroke:frzen@1", "did you mean 'boom-stroke:frozen'?"},
               {"outside:slow@1", "above 0 and below 1"},
               {"outside:slow=1.5@1", "above 0 and below 1"},
               {"outside:silent@1", "no source was there before"},
               {"blade-stroke:frozen@1", "known: "}};
  for (const auto& tried : cases) {
    assert_non_null(std::strstr(refusal(tried.text).c_str(), tried.says));
  }
}

/// Each comes at its time, whatever the order in which they were told, and its mark says which.
TEST(faults_come_in_time) {
  LoopbackBus bus;
  LoopbackPort& machine = bus.attach();
  LoopbackPort& other = bus.attach();
  assert_true(machine.open() && other.open());
  plant::ExcavatorFaults faults;
  PlantFaultSchedule<plant::ExcavatorFaults> schedule(
      excavator_plant_faults(), {"arm-stroke:step=0.012@0.02", "boom-stroke:frozen@0.01"});
  std::array<CanFrame, 4> marks;
  const int expected[] = {0, 2, 1};
  for (int cycle = 0; cycle < 3; ++cycle) {
    schedule.apply(cycle * 10000, faults, machine);
    assert_int_equal(faults.axis[kBoom].stroke.stuck, cycle >= 1);
    assert_true(faults.axis[kArm].stroke.jump_m == (cycle >= 2 ? 0.012 : 0.0));
    const int count = other.receive(marks.data(), static_cast<int>(marks.size()));
    assert_int_equal(count, expected[cycle] != 0);
    if (count == 1) {
      assert_int_equal(marks[0].id, 0x7F0);
      assert_false(marks[0].extended);
      assert_int_equal(marks[0].data[0], expected[cycle]);
    }
  }
}

/// The switches, made on zeros, so that two alike are the same bytes.
template <class Faults>
class Switches {
 public:
  Switches() : faults(*new (bytes_.data()) Faults) {}
  ~Switches() { faults.~Faults(); }
  Switches(const Switches&) = delete;
  Switches& operator=(const Switches&) = delete;

  [[nodiscard]] std::string bytes() const {
    // The sets of frames point into themselves: which are silent is said in their place.
    const auto* const frames = reinterpret_cast<const char*>(&faults.frames);
    std::string bytes(bytes_.data(), frames);
    for (const std::uint32_t id : faults.frames.silent) {
      bytes.append(std::to_string(id));
    }
    return bytes.append(frames + sizeof(plant::FrameFaults), bytes_.data() + sizeof(Faults));
  }

 private:
  alignas(Faults) std::array<char, sizeof(Faults)> bytes_{};

 public:
  Faults& faults;
};

/// Every one of a table sets something that no other one sets.
template <class Faults>
void each_acts(const PlantFaultTable<Faults>& table) {
  std::set<std::string> seen = {Switches<Faults>().bytes()};
  for (const auto& [name, set] : table) {
    Switches<Faults> switches;
    set(switches.faults, 0.5);
    assert_true(seen.insert(switches.bytes()).second);
  }
}

TEST(every_name_acts) {
  each_acts(excavator_plant_faults());
  each_acts(dozer_plant_faults());
}

FaultSet only(Fault fault) {
  FaultSet faults;
  faults.add(fault);
  return faults;
}

/// The pilot pressure through a stop by a fault, in motion or at rest, until the operator has the
/// machine by hand and the fault is gone.
struct Stop {
  bool at_once = false;
  bool later = false;
  bool lasts = false;    ///< The fault gone.
  bool by_hand = false;  ///< In the operator's hands then.
};

Stop stop_by(Fault fault, const PilotState& before, bool in_motion) {
  const ModeState mode = in_motion ? ModeState{EcuMode::kFault, fault} : ModeState{EcuMode::kReady};
  Stop stop;
  PilotResult pressure = pilot(before, mode, only(fault), false, 0.01);
  stop.at_once = pressure.cut;
  for (int n = 0; n < 120; ++n) {
    pressure = pilot(pressure.state, mode, only(fault), false, 0.01);
  }
  stop.later = pressure.cut;
  stop.lasts = pilot(pressure.state, {EcuMode::kReady, Fault::kNone}, {}, false, 0.01).cut;
  stop.by_hand = pilot(pressure.state, {EcuMode::kReady, Fault::kNone}, {}, true, 0.01).cut;
  return stop;
}

/// What is told of each fault is what the controller does.
TEST(the_pilot_pressure_goes_and_comes_back_as_it_is_told) {
  const auto told = [](Fault fault, Fault like) {
    return std::strcmp(pilot_words(fault), pilot_words(like)) == 0;
  };
  for (int code = 0; code < kFaultCount; ++code) {
    const auto fault = static_cast<Fault>(code);
    if (fault_row(fault).reaction != Reaction::kStop) {
      assert_string_equal(pilot_words(fault), "");
      continue;
    }
    CycleMemory memory;
    if (fault == Fault::kMemoryCorrupt) {
      static_cast<void>(begin_cycle(memory, false, 0));
    }
    const Stop moving = stop_by(fault, memory.pilot, true);
    const Stop resting = stop_by(fault, memory.pilot, false);
    assert_true(moving.later);
    if (moving.by_hand) {
      assert_true(moving.at_once);
      assert_true(told(fault, resting.lasts && !resting.by_hand ? Fault::kUncommandedMotion
                                                                : Fault::kSpoolStuck));
    } else {
      assert_true(told(fault, moving.at_once ? Fault::kSpoolMissing : Fault::kStrokeMissing));
    }
  }
  assert_false(told(Fault::kSpoolStuck, Fault::kUncommandedMotion));
  assert_false(told(Fault::kSpoolMissing, Fault::kStrokeMissing));
  assert_false(told(Fault::kSpoolMissing, Fault::kSpoolStuck));
}

/// As `plant` has it, of the runs in memory.
TEST(a_fault_stops_a_run_in_memory) {
  const auto show = [](double, const std::string&) {};
  const machines::SimulatedExcavator excavator =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  DigOptions dig;
  dig.start_strokes_m = machines::dig_start(excavator.profile);
  dig.faults = {"boom-stroke:step=0.4@1.0"};
  const DigResult dug = run_dig(excavator, dig, show);
  assert_true(dug.end == DigEnd::kFault);
  assert_true(dug.samples.back().time_s > 1.0 && dug.samples.back().time_s < 1.3);
  const machines::SimulatedDozer dozer =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  GradeOptions grade;
  grade.faults = {"engine:runs=0@1.0"};
  const GradeResult graded = run_grade(dozer, grade, show);
  assert_true(graded.end == GradeEnd::kFault);
  assert_true(graded.samples.back().time_s > 0.99 && graded.samples.back().time_s < 1.5);
  grade.faults = {"boom-stroke:frozen@1"};
  assert_non_null(
      strstr(graben::test::refusal_of([&] { return run_grade(dozer, grade, show); }).c_str(),
             "\nknown: blade-spool:held"));
}

/// For the card of the report's page, which is read without the command line.
TEST(what_was_broken_is_named) {
  assert_string_equal(told_faults_subtitle({}).c_str(), "");
  assert_string_equal(told_faults_subtitle({"engine:runs=0@1.0", "boom-stroke:frozen@2"}).c_str(),
                      " | fault engine:runs=0@1.0, boom-stroke:frozen@2");
}

TEST(a_run_is_given_up_when_told) {
  const machines::SimulatedDozer dozer =
      machines::load_simulated_dozer(machines::find_profile("dozer_9t"));
  GradeOptions grade;
  grade.most_s = 1.0;
  const GradeResult result = run_grade(dozer, grade, [](double, const std::string&) {});
  assert_true(result.end == GradeEnd::kNotFinished);
  assert_near(result.samples.back().time_s, 1.0, 0.02);
}
