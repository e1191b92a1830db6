// SPDX-License-Identifier: Apache-2.0
// The checks of the reactions N, L, D and I, and of arming refused.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/runs/code_text.hpp"
#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"
#include "tests/faults/trial.hpp"

namespace graben::faults {
namespace {

/// From detection to neutral frames on the bus, and from the start of any fault to a trouble code.
constexpr TimeUs kToNeutral_us = 20 * kMillisecondUs;
constexpr TimeUs kReported_us = kSecondUs;
/// An interface that is back is opened again within 200 ms.
constexpr TimeUs kOpensAgain_us = 200 * kMillisecondUs;
/// The valve side closes by itself after 100 ms; it looks every cycle.
constexpr TimeUs kValveCloses_us = 110 * kMillisecondUs;
/// With the fault, then without it and with enable still held; together several of the oil's
/// periods.
constexpr TimeUs kWith_us = 700 * kMillisecondUs;
/// From neutral, or from the pilot cut, until every spool is in its deadband.
constexpr TimeUs kCloses_us = 150 * kMillisecondUs;
constexpr TimeUs kWithout_us = 700 * kMillisecondUs;
constexpr double kMostMoved_share = 0.01;
/// A machine that drives, after it was told to be neutral. The worst of 20 seeds of all rows
/// (2026-11): 0.75 s and 0.20 m; with a pump held at the wrong side and the brake closed at once,
/// 0.91 s and 0.13 m.
constexpr TimeUs kRests_us = 1200 * kMillisecondUs;
constexpr double kRolls_m = 0.30;
/// On a curve the sheared ground below its tracks springs back: 0.0202 m at most.
constexpr double kMovesAtRest_m = 0.025;

double ms(TimeUs time_us) { return static_cast<double>(time_us) * 1e-3; }

/// Where the machine of a seed is after each cycle when nothing disturbs its task.
template <class Kind>
class Undisturbed {
 public:
  explicit Undisturbed(std::uint64_t seed)
      : scenery_(Kind::scenery_of(seed)), rig_(scenery_, LoopbackBus::kQueueCapacity) {}

  const typename Kind::PlaceArray& places_m(TimeUs at_us) {
    const auto cycle = static_cast<std::size_t>(at_us / kCycle_us);
    while (places_m_.size() <= cycle) {
      // As Trial::work() has it.
      if (rig_.now_us == 200 * kMillisecondUs) {
        rig_.ask(true, Task::kNone);
      } else if (rig_.now_us == 300 * kMillisecondUs) {
        rig_.ask(true, Kind::kTask);
      }
      rig_.step();
      places_m_.push_back(Kind::places_m(rig_.plant.plant()));
    }
    return places_m_[cycle];
  }

 private:
  typename Kind::Scenery scenery_;
  Rig<Kind> rig_;
  std::vector<typename Kind::PlaceArray> places_m_;
};

template <class Kind>
Undisturbed<Kind>& undisturbed(std::uint64_t seed) {
  static std::map<std::uint64_t, Undisturbed<Kind>> runs;
  return runs.try_emplace(seed, seed).first->second;
}

}  // namespace

template <class Kind>
unsigned Trial<Kind>::farthest_place(TimeUs after_us) const {
  const auto here_m = Kind::places_m(rig->plant.plant());
  const auto& then_m = undisturbed<Kind>(seed_).places_m(rig->at_us() + after_us);
  unsigned farthest = 0;
  for (unsigned i = 1; i < Kind::kPlaces; ++i) {
    if (std::abs(then_m[i] - here_m[i]) > std::abs(then_m[farthest] - here_m[farthest])) {
      farthest = i;
    }
  }
  return farthest;
}

template <class Kind>
void Trial<Kind>::await_detection(const Stop& stop) {
  const TimeUs most_us = std::max(stop.detect_us, kValveCloses_us) + 2 * kCycle_us;
  const TimeUs until_us = stop.since_us + most_us;
  const auto look = [&] {
    if (detected_us_ < 0 && rig->ecu && rig->ecu_on && rig->mode() != EcuMode::kActive) {
      const FaultSet& faults = rig->outputs().status.faults;
      bool is_it = stop.any.empty();
      for (const Fault fault : stop.any) {
        if (faults.has(fault)) {
          outcome.codes.add(fault);
          is_it = true;
        }
      }
      detected_us_ = is_it ? rig->at_us() : -1;
    }
    if (neutral_us_ < 0) {
      neutral_us_ = rig->record.first_neutral_us(stop.since_us, Kind::kCommandFrames);
      const TimeUs closed_us = rig->valve_closed_us;
      const bool closed_first =
          closed_us >= stop.since_us && (neutral_us_ < 0 || closed_us < neutral_us_);
      if (!stop.bus_carries && closed_first) {
        neutral_us_ = closed_us;
        outcome.by_valve = true;
      }
    }
  };
  look();
  while ((detected_us_ < 0 || neutral_us_ < 0) && rig->now_us <= until_us) {
    rig->step();
    look();
  }
}

template <class Kind>
void Trial<Kind>::stay_stopped(const Stop& stop) {
  rig->run(kCloses_us);
  check(rig->closing->has_begun(), "the spools have not closed while the fault was there");
  rig->run(kWith_us - kCloses_us);
  if (stop.cure) {
    stop.cure();
  }
  // What the bus could not carry has a second to be said when it does again.
  rig->run(stop.bus_carries ? kWithout_us : kOpensAgain_us + kReported_us);
  check(rig->record.all_neutral(neutral_us_), "a command that is not neutral after the first one");
  check(!rig->enabled(), "the valve side is still enabled");
  check(!in_motion(rig->mode()), "armed or active again with the enable held");
}

template <class Kind>
void Trial<Kind>::judge_closing(bool brake_at_once) {
  const ClosingWatch<Kind>& closing = *rig->closing;
  check(closing.has_begun(), "the spools never closed");
  outcome.beyond_share = closing.beyond_share();
  outcome.creep_share = closing.creep_share();
  check(closing.beyond_share() <= kMostMoved_share,
        fmt::format("{:.2f} % of a stroke beyond what closing allows",
                    100.0 * closing.beyond_share()));
  check(closing.creep_share() <= kMostMoved_share,
        fmt::format("creeps by {:.2f} % of a stroke", 100.0 * closing.creep_share()));
  if (Kind::rolling(rig->plant.plant())) {
    judge_rolling(closing.rolling(), brake_at_once);
  }
  rig->closing.reset();
}

template <class Kind>
void Trial<Kind>::judge_rolling(const RollingWatch& rolling, bool brake_at_once) {
  outcome.rest_us = rolling.rest_us();
  outcome.rolled_m = rolling.rolled_m();
  check(rolling.rests() && rolling.rest_us() <= kRests_us && rolling.rolled_m() <= kRolls_m,
        fmt::format("rolls for {} ms, {:.2f} m", ms(rolling.rest_us()), rolling.rolled_m()));
  check(rolling.moved_at_rest_m() <= kMovesAtRest_m,
        fmt::format("moves by {:.3f} m after it stood", rolling.moved_at_rest_m()));
  const auto& commands = rig->record.commands;
  check(!commands.empty() && commands.back().brake, "does not ask for its brake at rest");
  const TimeUs brake_us = rig->record.first_brake_us(neutral_us_);
  check(!brake_at_once || (brake_us >= 0 && brake_us - detected_us_ <= kToNeutral_us),
        "does not ask for its brake at once");
}

template <class Kind>
void Trial<Kind>::expect_reported(Fault fault, TimeUs since_us, TimeUs from_us) {
  check(rig->record.status_named(fault, since_us),
        fmt::format("the status frame never says '{}'", runs::fault_words(fault)));
  check(rig->record.dm1_named(fault, since_us, from_us + kReported_us),
        fmt::format("no DM1 of '{}' within 1 s", runs::fault_words(fault)));
}

template <class Kind>
void Trial<Kind>::expect_stop(const Stop& stop) {
  detected_us_ = -1;
  neutral_us_ = -1;
  if (!rig->closing) {
    rig->closing.emplace(stop.disobeying);
  }
  await_detection(stop);
  check(detected_us_ >= 0 && detected_us_ - stop.since_us <= stop.detect_us,
        fmt::format("not detected within {} ms (mode {}, '{}')", ms(stop.detect_us),
                    static_cast<int>(rig->mode()),
                    rig->ecu ? runs::fault_words(rig->outputs().status.fault) : "no controller"));
  check(neutral_us_ >= 0, "no neutral command");
  if (detected_us_ < 0 || neutral_us_ < 0) {
    saw("none");
    rig->closing.reset();
    return;
  }
  outcome.to_detection_us = std::max(outcome.to_detection_us, detected_us_ - stop.since_us);
  outcome.detection_to_neutral_us =
      std::max({outcome.detection_to_neutral_us, TimeUs{0}, neutral_us_ - detected_us_});
  outcome.to_neutral_us = std::max(outcome.to_neutral_us, neutral_us_ - stop.since_us);
  check(!stop.bus_carries || neutral_us_ - detected_us_ <= kToNeutral_us,
        fmt::format("{} ms from detection to neutral", ms(neutral_us_ - detected_us_)));
  check(stop.neutral_us == 0 || neutral_us_ - stop.since_us <= stop.neutral_us,
        fmt::format("{} ms to neutral", ms(neutral_us_ - stop.since_us)));
  check(stop.bus_carries || neutral_us_ - stop.since_us <= kValveCloses_us,
        fmt::format("{} ms until the valve side closed or was told to",
                    ms(neutral_us_ - stop.since_us)));
  const TimeUs back_us = rig->now_us + kWith_us + kOpensAgain_us;
  stay_stopped(stop);
  judge_closing(stop.brake_at_once);
  if (!stop.any.empty()) {
    // Where the bus carries nothing, the second runs from when it does again.
    for (Fault fault = outcome.codes.first(); fault != Fault::kNone;) {
      const bool latched =
          rig->outputs().status.fault == fault || rig->record.status_named(fault, detected_us_);
      if (latched) {
        expect_reported(fault, detected_us_, stop.bus_carries ? detected_us_ : back_us);
        break;
      }
      fault = outcome.codes.after(fault);
      check(fault != Fault::kNone,
            fmt::format("none of the fault's codes is in the status frame; it says '{}'",
                        runs::fault_words(rig->outputs().status.fault)));
    }
  }
  check(!stop.pilot_cut || rig->record.any_pilot_cut(detected_us_), "no pilot cut asked for");
  saw(stop.latches ? "N L" : "N");
  check(!stop.latches || rig->mode() == EcuMode::kFault || rig->mode() == EcuMode::kSilent,
        "not latched");
  expect_arms_again();
}

template <class Kind>
void Trial<Kind>::expect_arms_again() {
  rig->ask(false, Task::kNone);
  // The machine names itself once a second, and the windows of wrong frames have to run empty.
  const bool ready = rig->run_until(3 * kSecondUs, [this] {
    return rig->mode() == EcuMode::kReady && rig->outputs().status.fault == Fault::kNone;
  });
  check(ready, fmt::format("not Ready after letting go ('{}')",
                           runs::fault_words(rig->outputs().status.fault)));
  rig->run(50 * kMillisecondUs);
  rig->ask(true, Task::kNone);
  rig->run(100 * kMillisecondUs);
  check(rig->mode() == EcuMode::kArmed,
        fmt::format("not Armed by a fresh enable ('{}', why not {:x})",
                    runs::fault_words(rig->outputs().status.fault),
                    rig->outputs().status.why_not_armed));
  rig->ask(true, Kind::kTask);
  rig->run(100 * kMillisecondUs);
  check(rig->mode() == EcuMode::kActive && rig->enabled(), "not Active after re-arming");
}

template <class Kind>
void Trial<Kind>::expect_slower(const Slowing& slowing) {
  const FaultSet& faults = rig->outputs().status.faults;
  double before_mps = wanted_mps();
  // Unlike a stop this can take as long as it takes to notice, so the speed goes along.
  const bool detected =
      rig->run_until(slowing.since_us + slowing.detect_us + kCycle_us - rig->now_us, [&] {
        const bool is_there = rig->outputs().status.faults.has(slowing.fault);
        before_mps = is_there ? before_mps : wanted_mps();
        return is_there;
      });
  const TimeUs detected_us = rig->at_us();
  check(detected, fmt::format("'{}' not detected within {} ms", runs::fault_words(slowing.fault),
                              ms(slowing.detect_us)));
  if (!detected) {
    saw("none");
    return;
  }
  outcome.codes.add(slowing.fault);
  outcome.to_detection_us = std::max(outcome.to_detection_us, detected_us - slowing.since_us);
  const TimeUs slows_us = std::min(Kind::kSlows_us, slowing.hold_us);
  rig->run(slows_us);
  check(wanted_mps() < Kind::slowed_mps(rig->machine, before_mps, slows_us),
        fmt::format("not slower: {:.3f} m/s after {:.3f}", wanted_mps(), before_mps));
  const bool left =
      rig->run_until(slowing.hold_us, [this] { return rig->mode() != EcuMode::kActive; });
  check(!left, fmt::format("did not go on ('{}')", runs::fault_words(rig->outputs().status.fault)));
  expect_reported(slowing.fault, detected_us, detected_us);
  if (slowing.cure) {
    slowing.cure();
  }
  double slow_mps = wanted_mps();
  const bool over = rig->run_until(std::max(slowing.back_us, Kind::kBack_us), [&] {
    slow_mps = faults.empty() ? slow_mps : wanted_mps();
    return faults.empty() &&
           Kind::is_back(slow_mps, wanted_mps(), rig->record.statuses.back().limit);
  });
  check(over && rig->mode() == EcuMode::kActive,
        fmt::format("full speed does not come back: {:.3f} m/s after {:.3f}, '{}'", wanted_mps(),
                    slow_mps, runs::fault_words(rig->outputs().status.fault)));
  saw("D");
}

template <class Kind>
void Trial<Kind>::expect_ignored(TimeUs duration_us, double bound_m) {
  const TimeUs since_us = rig->now_us;
  check(since_us + duration_us < Kind::kLongestBaseline_us, "the undisturbed run is too short");
  double most_m = 0.0;
  bool active = true;
  for (const TimeUs end_us = since_us + duration_us; rig->now_us < end_us;) {
    rig->step();
    active = active && rig->mode() == EcuMode::kActive && rig->enabled();
    const auto places_m = Kind::places_m(rig->plant.plant());
    const auto& otherwise_m = undisturbed<Kind>(seed_).places_m(rig->at_us());
    for (std::size_t i = 0; i < Kind::kPlaces; ++i) {
      most_m = std::max(most_m, std::abs(places_m[i] - otherwise_m[i]));
    }
  }
  check(active, fmt::format("not Active all the time ('{}')",
                            runs::fault_words(rig->outputs().status.fault)));
  check(!rig->record.any_fault(since_us), "a fault is on the bus");
  check(most_m <= bound_m,
        fmt::format("the machine is {:.2f} mm off the undisturbed run", 1e3 * most_m));
  saw("I");
}

template <class Kind>
void Trial<Kind>::expect_refused(ArmBlock why, TimeUs duration_us,
                                 const std::function<void()>& cure) {
  const TimeUs since_us = rig->now_us;
  rig->run(duration_us);
  check(rig->record.all_neutral(since_us) && !rig->enabled() && !in_motion(rig->mode()),
        "it armed");
  const auto bit = 1U << static_cast<unsigned>(why);
  const auto& refusals = rig->record.refusals;
  check(!refusals.empty() && (refusals.back().why_not_armed & bit) != 0U,
        fmt::format("bit {} of WhyNotArmed is not on the bus", static_cast<int>(why)));
  if (cure) {
    cure();
  }
  expect_arms_again();
  saw("refused");
}

template unsigned Trial<Excavator>::farthest_place(TimeUs after_us) const;
template void Trial<Excavator>::expect_stop(const Stop& stop);
template void Trial<Excavator>::expect_slower(const Slowing& slowing);
template void Trial<Excavator>::expect_ignored(TimeUs duration_us, double bound_m);
template void Trial<Excavator>::expect_refused(ArmBlock why, TimeUs duration_us,
                                               const std::function<void()>& cure);
template void Trial<Excavator>::expect_arms_again();
template unsigned Trial<Dozer>::farthest_place(TimeUs after_us) const;
template void Trial<Dozer>::expect_stop(const Stop& stop);
template void Trial<Dozer>::expect_slower(const Slowing& slowing);
template void Trial<Dozer>::expect_ignored(TimeUs duration_us, double bound_m);
template void Trial<Dozer>::expect_refused(ArmBlock why, TimeUs duration_us,
                                           const std::function<void()>& cure);
template void Trial<Dozer>::expect_arms_again();

}  // namespace graben::faults
