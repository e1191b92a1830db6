// SPDX-License-Identifier: Apache-2.0
// hours [SHIFTS]: so many shifts of 43.2 s each, 2000 unless told, which are 24 h and 8.64 million
// cycles. In each the operator arms and digs; in every fourth a frame that the machine can't do
// without goes missing; a workshop's tool asks all the time, and others claim the address. At the
// end memory, store and control are as at the start, or it says what is not; status 1 then.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "app/ecu/store/stored_faults.hpp"
#include "tests/endurance/day.hpp"

namespace graben::endurance {
namespace {

constexpr int kDayShifts = 2000;
constexpr TimeUs kShiftUs = 43'200 * kMillisecondUs;
constexpr int kFaultEvery = 4;
constexpr long kMostGrowth_kB = 256;

long resident_kB() {
  long size = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

template <class At>
double median(At from, At until) {
  std::vector<double> all(from, until);
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

class Shifts {
 public:
  explicit Shifts(const faults::Excavator::Scenery& scenery) : day_(scenery, disk_) {}

  int run(int count) {
    fmt::print("hour  arms  faults  writes  allocations  resident, kB  path error, mm\n");
    for (int i = 0; i < count; ++i) {
      shift(i);
      const int an_hour = std::max(1, count / 24);
      if ((i + 1) % an_hour == 0) {
        tell(i + 1 == an_hour);
      }
    }
    day_.end();
    judge(count);
    for (const std::string& what : wrong_) {
      fmt::print("WRONG: {}\n", what);
    }
    return wrong_.empty() ? 0 : 1;
  }

 private:
  void step() {
    // A tool asks, and another station claims, both without end.
    if (random_() % 50 == 0) {
      constexpr std::array<std::uint32_t, 6> kAsked = {65226, 65227, 64950, 64951, 60928, 65260};
      const std::uint32_t pgn = kAsked[random_() % kAsked.size()];
      CanFrame frame;
      frame.id = random_() % 2 == 0 ? 0x18EAFFF9 : 0x18EA82F9;
      frame.length = 3;
      frame.data = {static_cast<std::uint8_t>(pgn), static_cast<std::uint8_t>(pgn >> 8U),
                    static_cast<std::uint8_t>(pgn >> 16U)};
      day_.tool_sends(frame);
    }
    if (random_() % 2000 == 0) {
      CanFrame claim;
      claim.id = 0x18EEFF82;
      claim.length = 8;
      claim.data.fill(0xFE);
      day_.tool_sends(claim);
    }
    day_.step();
  }
  void run_for(TimeUs duration_us) {
    for (const TimeUs end_us = day_.now_us() + duration_us; day_.now_us() < end_us;) {
      step();
    }
  }
  bool run_until(TimeUs most_us, EcuMode mode, bool is_wanted) {
    for (const TimeUs end_us = day_.now_us() + most_us;
         (day_.mode() == mode) != is_wanted && day_.now_us() < end_us;) {
      step();
    }
    return (day_.mode() == mode) == is_wanted;
  }
  TimeUs between(TimeUs least_us, TimeUs most_us) {
    return least_us + static_cast<TimeUs>(
                          random_() % static_cast<std::uint64_t>((most_us - least_us) / kCycleUs)) *
                          kCycleUs;
  }

  void shift(int number) {
    const TimeUs end_us = day_.now_us() + kShiftUs;
    day_.ask(false, Task::kNone);
    run_for(2 * kSecondUs);
    day_.ask(true, Task::kNone);
    run_for(300 * kMillisecondUs);
    day_.ask(true, Task::kDig);
    if (!run_until(2 * kSecondUs, EcuMode::kActive, true)) {
      wrong_.push_back(fmt::format("shift {}: not Active: mode {}, fault {}, blocks {}", number,
                                   static_cast<int>(day_.mode()),
                                   static_cast<int>(day_.outputs().status.fault),
                                   static_cast<int>(day_.outputs().status.why_not_armed)));
    } else {
      ++arms_;
    }
    if (number % kFaultEvery == kFaultEvery - 1) {
      disturb(number);
    } else {
      double worst_m = 0.0;
      for (const TimeUs until_us = day_.now_us() + between(5 * kSecondUs, 15 * kSecondUs);
           day_.now_us() < until_us;) {
        step();
        worst_m = std::max(worst_m, day_.outputs().status.path_error_m);
      }
      errors_m_.push_back(worst_m);
      if (day_.mode() == EcuMode::kFault) {
        wrong_.push_back(fmt::format("shift {}: stopped with fault {}", number,
                                     static_cast<int>(day_.outputs().status.fault)));
      }
    }
    day_.ask(false, Task::kNone);
    run_for(end_us - day_.now_us());
  }

  void disturb(int number) {
    run_for(between(kSecondUs, 12 * kSecondUs));
    const auto& vital = faults::Excavator::vital();
    const std::uint32_t id = vital[random_() % vital.size()].id;
    day_.machine().faults().set_silent(id, true);
    if (!run_until(300 * kMillisecondUs, EcuMode::kActive, false)) {
      wrong_.push_back(fmt::format("shift {}: still active without {:08X}", number, id));
    } else {
      ++stops_;
    }
    run_for(between(200 * kMillisecondUs, 1500 * kMillisecondUs));
    day_.machine().faults().set_silent(id, false);
  }

  void tell(bool is_first) {
    const Weight& weight = day_.weight();
    const long resident = resident_kB();
    resident_at_first_ = is_first ? resident : resident_at_first_;
    const double last_m = errors_m_.empty() ? 0.0 : errors_m_.back();
    fmt::print("{:4.1f}  {:4}  {:6}  {:6}  {:11}  {:12}  {:14.1f}\n",
               static_cast<double>(day_.now_us()) / 3.6e9, arms_, stops_, day_.keeper().writes(),
               weight.allocations, resident, 1e3 * last_m);
    std::fflush(stdout);
  }

  void judge(int count) {
    const auto demand = [&](bool is_right, const std::string& what) {
      if (!is_right) {
        wrong_.push_back(what);
      }
    };
    const Weight& weight = day_.weight();
    demand(weight.allocations == 0, fmt::format("{} allocations in cycles", weight.allocations));
    const long growth = resident_kB() - resident_at_first_;
    demand(growth <= kMostGrowth_kB, fmt::format("{} kB more than after the first hour", growth));
    demand(!day_.claim().is_lost(), "the address is lost");
    demand(day_.keeper().dropped() == 0,
           fmt::format("{} events or frames lost", day_.keeper().dropped()));
    demand(day_.keeper().failures() == 0, "writes failed");
    const auto found = ecu::read_stored_faults(disk_);
    std::uint64_t stored = 0;
    for (const auto& entry : found.history.entry) {
      stored += entry.occurrences;
    }
    // Those that end before the controller has been ready do not count.
    constexpr std::uint64_t kAtPowerOn = 6;
    demand(stored > 0 && stored <= weight.events && stored + kAtPowerOn >= weight.events,
           fmt::format("{} occurrences stored, {} came", stored, weight.events));
    const auto seconds = static_cast<std::uint32_t>(day_.now_us() / kSecondUs);
    demand(found.history.operation_s + 1 >= seconds && found.history.operation_s <= seconds,
           fmt::format("{} s of operation stored, {} were", found.history.operation_s, seconds));
    demand(arms_ == count && stops_ == count / kFaultEvery,
           fmt::format("{} arms, {} stops", arms_, stops_));
    demand(weight.answers >= static_cast<std::uint32_t>(50 * count), "the tool is not answered");
    demand(day_.claim().defended() > 0, "no claim was kept off");
    demand(found.history.learnt.count > 0, "nothing learnt is stored");
    const auto tenth = static_cast<long>((errors_m_.size() + 9) / 10);
    if (!errors_m_.empty()) {
      const double first_m = median(errors_m_.begin(), errors_m_.begin() + tenth);
      const double last_m = median(errors_m_.end() - tenth, errors_m_.end());
      fmt::print("path error, median of the first tenth {:.1f} mm, of the last {:.1f} mm\n",
                 1e3 * first_m, 1e3 * last_m);
      demand(last_m <= 1.1 * first_m + 1e-3, "control is worse than at the start");
    }
    fmt::print(
        "{} shifts, {} cycles, {} arms, {} stops by faults, {} events, {} stored, {} writes, "
        "{} answers to the tool, {} claims kept off\n",
        count, weight.cycles, arms_, stops_, weight.events, stored, day_.keeper().writes(),
        weight.answers, day_.claim().defended());
  }

  test::MemoryDisk disk_;
  Day day_;
  std::mt19937_64 random_{20261130};
  int arms_ = 0;
  int stops_ = 0;
  long resident_at_first_ = 0;
  std::vector<double> errors_m_;
  std::vector<std::string> wrong_;
};

}  // namespace
}  // namespace graben::endurance

int main(int argc, char** argv) {
  const int shifts = argc > 1 ? std::atoi(argv[1]) : graben::endurance::kDayShifts;
  if (argc > 2 || shifts < 1 || shifts > 100'000) {
    fmt::print(stderr, "hours [SHIFTS]: 1 to 100000 of them\n");
    return 2;
  }
  graben::endurance::Shifts day(graben::faults::Excavator::scenery_of(2));
  return day.run(shifts);
}
