// SPDX-License-Identifier: Apache-2.0
// Every fault of the simulation, on each kind of machine: it makes the controller do what its row
// says, it can be taken back, and the machine works again.

#include <algorithm>
#include <vector>

#include "tests/unit/scope/sim_watch.hpp"

using scope::SimReaction;
using test::json;
using test::SimWatch;

constexpr double kReacts_s = 3.0;
constexpr double kWorksAgain_s = 5.0;

bool reacts_as(const json& fault, SimReaction reaction) {
  return fault["reaction"] == scope::reaction_words(reaction);
}

/// Says which row it is, and what was there, where something is not as it should be.
class Row {
 public:
  Row(SimWatch& sim, const json& fault) : sim_(sim), fault_(fault), id_(fault["id"]) {}

  /// How much is not as it should be.
  int try_it(double reacts_s) {
    sim_.wish({{"do", "restart"}});
    sim_.run(0.1);
    check(sim_.run_to_active(2.0), "does not begin to work");
    sim_.run(2.5);
    check(sim_.bus.mode == EcuMode::kActive && sim_.bus.fault == Fault::kNone,
          "does not work undisturbed");
    sim_.bus.forget();
    rejected_before_ = sim_.bus.rejected;
    sim_.fault(id_, true);
    look_at_reaction(reacts_s);
    take_it_back();
    work_again();
    return failures_;
  }

 private:
  void look_at_reaction(double reacts_s) {
    if (reacts_as(fault_, SimReaction::kStops)) {
      stops(reacts_s);
    } else if (reacts_as(fault_, SimReaction::kStopsUnheard)) {
      stops_unheard();
    } else if (reacts_as(fault_, SimReaction::kLetsGo)) {
      check(sim_.run_until(0.05, [&] { return sim_.bus.mode == EcuMode::kReady; }), "goes on");
      check(sim_.bus.commands_neutral && sim_.bus.fault == Fault::kNone, "not neutral");
    } else if (reacts_as(fault_, SimReaction::kRefused)) {
      refuses();
    } else if (reacts_as(fault_, SimReaction::kSlower)) {
      const bool slower =
          sim_.run_until(reacts_s, [&] { return sim_.bus.was_degraded && sim_.bus.named_fault; });
      check(slower && !sim_.bus.left_active, "not slower, or stopped");
    } else {
      goes_on();
    }
  }

  void stops(double reacts_s) {
    const bool stopped = sim_.run_until(reacts_s, [&] { return sim_.bus.mode == EcuMode::kFault; });
    check(stopped && sim_.bus.fault != Fault::kNone, "does not stop with a fault");
    sim_.run(0.05);
    check(sim_.bus.commands_neutral, "not neutral");
    sim_.run(0.5);
    check(sim_.bus.mode == EcuMode::kFault && sim_.bus.commands_neutral, "does not stay stopped");
  }

  /// Nothing opens any more, whatever the bus still carries; afterwards it says that it stopped.
  void stops_unheard() {
    sim_.run(0.2);
    // In a babble the valve side is not heard either.
    check(sim_.bus.valve_closed || id_ == "babble", "the valve side is still open");
    sim_.run(1.5);
    sim_.fault(id_, false);
    sim_.run(0.6);
    check(sim_.bus.commands_neutral && sim_.bus.valve_closed, "opens again by itself");
    check(sim_.bus.mode != EcuMode::kActive && sim_.bus.mode != EcuMode::kArmed, "armed again");
    check(sim_.bus.why_not_armed != 0, "does not say why");
  }

  void refuses() {
    constexpr auto kNotAtRest = 1U << static_cast<unsigned>(ArmBlock::kTaskNotAtRest);
    sim_.run(1.0);
    sim_.bus.forget();
    bool armed = false;
    sim_.run_until(kReacts_s, [&] {
      armed = armed || sim_.bus.mode == EcuMode::kArmed || sim_.bus.mode == EcuMode::kActive;
      return false;
    });
    check(!armed && sim_.bus.commands_neutral, "arms");
    check((sim_.bus.why_not_armed & kNotAtRest) != 0, "does not say why");
  }

  void goes_on() {
    const bool counts = reacts_as(fault_, SimReaction::kIgnored);
    sim_.run(kReacts_s);
    check(!sim_.bus.left_active && !sim_.bus.named_fault, "does not go on");
    const bool counted = sim_.bus.rejected > rejected_before_;
    check(counted == counts, "counted where it should not be, or not where it should");
    const bool shows = sim_.bus.widest_gap_us == 2 * SimWatch::kCycle_us || sim_.bus.short_ids > 0;
    check(counts || shows, "nothing of it was on the bus");
  }

  void take_it_back() {
    if (fault_["once"]) {
      check(sim_.state()["faults"].empty(), "happens once and is not over");
      return;
    }
    // What stopped without being heard was taken back already.
    const bool is_on = sim_.state()["faults"] == json::array({id_});
    check(is_on || reacts_as(fault_, SimReaction::kStopsUnheard), "not on");
    sim_.fault(id_, false);
    sim_.run(0.02);
    check(sim_.state()["faults"].empty(), "still on");
  }

  void work_again() {
    sim_.wish({{"do", "clear"}});
    sim_.run(0.05);
    check(sim_.run_to_active(kWorksAgain_s), "does not work again");
    // Over 2 s it may still be slower because of what it was.
    sim_.run(2.0);
    sim_.bus.forget();
    sim_.run(0.5);
    check(!sim_.bus.left_active && !sim_.bus.named_fault && !sim_.bus.was_degraded,
          "does not go on as before");
    check(!sim_.bus.backwards, "time went backwards");
  }

  void check(bool is_right, const char* what) {
    if (!is_right) {
      ++failures_;
      print_error("%s: %s: %s (mode %d, fault %d, rejected %u, before %u)\n",
                  fault_["reaction"].get<std::string>().c_str(), id_.c_str(), what,
                  static_cast<int>(sim_.bus.mode), static_cast<int>(sim_.bus.fault),
                  sim_.bus.rejected, rejected_before_);
    }
  }

  SimWatch& sim_;
  const json& fault_;
  std::string id_;
  std::uint32_t rejected_before_ = 0;
  int failures_ = 0;
};

void try_all(const char* task, const std::vector<int>& numbers) {
  SimWatch sim(task);
  int failures = 0;
  const json setup = sim.session.setup();
  std::vector<int> tried;
  for (const json& fault : setup["faults"]) {
    tried.push_back(fault["number"]);
    // The blade moves now and then, a displacement is told another one where the design's slope
    // changes.
    const bool is_slow = setup["task"] == "grade" &&
                         (fault["id"] == "stroke-stuck" || fault["id"] == "displacement-stuck");
    // A row that is red does not hide the next.
    failures += Row(sim, fault).try_it(is_slow ? 15.0 : kReacts_s);
  }
  assert_int_equal(failures, 0);
  assert_true(tried == numbers);
}

TEST(of_the_digging_excavator) {
  try_all("dig", {1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 13, 14, 15, 16, 17, 18, 19, 20,
                  21, 22, 24, 26, 27, 28, 29, 33, 34, 35, 36, 37, 38, 41, 42, 43, 46, 47});
}

TEST(of_the_excavator_with_swing) {
  try_all("autodig", {1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 13, 14, 15, 16, 17, 18, 19, 20,
                      21, 22, 24, 26, 27, 28, 29, 33, 34, 35, 36, 37, 38, 41, 42, 43, 46, 47});
}

TEST(of_the_dozer) {
  try_all("grade", {1,  2,  3,  4,  6,  7,  8,  9,  10, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                    22, 24, 26, 27, 28, 29, 33, 34, 35, 36, 38, 39, 40, 41, 42, 43, 46, 47});
}

/// What is broken twice: a controller that is killed and finds its bus down when it starts again.
TEST(two_at_once) {
  for (const char* first : {"controller-killed", "bus-down"}) {
    const char* second = first == std::string("bus-down") ? "controller-killed" : "bus-down";
    SimWatch sim("dig");
    assert_true(sim.run_to_active(kReacts_s));
    sim.fault(first, true);
    sim.fault(second, true);
    sim.run(3.0);
    assert_true(sim.bus.valve_closed);
    sim.wish({{"do", "clear"}});
    sim.run(0.05);
    assert_true(sim.run_to_active(kWorksAgain_s));
  }
}
