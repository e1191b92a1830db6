// SPDX-License-Identifier: Apache-2.0
#include "app/runs/plant_bus.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"

namespace graben::runs {
namespace {

constexpr TimeUs kTaskAfter_us = 100 * kMillisecondUs;
/// The operator lets go before the end, and what the machine then does is seen.
constexpr TimeUs kRelease_us = 500 * kMillisecondUs;
constexpr TimeUs kShift_us = 5 * kSecondUs;
constexpr TimeUs kPause_us = kSecondUs;
constexpr TimeUs kChange_us = 2 * kSecondUs;
constexpr TimeUs kNoTask_us = 50 * kMillisecondUs;
constexpr TimeUs kMostShifts = 10000;
constexpr int kReopenCycles = 20;
/// More than that is silence to whoever listens, and the machine may as well have stood still.
constexpr std::uint64_t kMostMadeUp = 5;

TimeUs microseconds(double time_s) { return static_cast<TimeUs>(std::llround(time_s * 1e6)); }

void open(SocketCanPort& port, const std::string& interface) {
  if (!port.open()) {
    throw std::runtime_error(interface + ": " + port.last_error());
  }
}

const plant::OperatorRequest kAtRest = {false, OperatorMode::kAutomatic, Task::kNone, 0.0};

/// Everything that the operator does, in its order.
std::vector<plant::OperatorPhase> schedule(const PlantRunOptions& options, Task task) {
  std::vector<plant::OperatorPhase> phases = {{0, kAtRest}};
  const plant::OperatorRequest armed = {true, OperatorMode::kAutomatic, Task::kNone, 0.0};
  const plant::OperatorRequest at_work = {true, OperatorMode::kAutomatic, task,
                                          options.speed_override_ratio, options.task_number};
  const auto work_from = [&](TimeUs enable_us) {
    phases.push_back({enable_us, armed});
    phases.push_back({enable_us + kTaskAfter_us, at_work});
  };
  const TimeUs begin_us = microseconds(options.enable_after_s);
  const TimeUs end_us = options.seconds > 0.0 ? microseconds(options.seconds) - kRelease_us
                                              : kMostShifts * (kShift_us + kPause_us);
  const auto pause_at = [&](TimeUs pause_us) {
    phases.push_back({pause_us, kAtRest});
    work_from(pause_us + kPause_us);
  };
  work_from(begin_us);
  for (const double pause_s : options.lets_go_s) {
    pause_at(microseconds(pause_s));
  }
  if (options.player == Player::kShifts) {
    for (TimeUs pause_us = begin_us + kShift_us; pause_us + kPause_us < end_us;
         pause_us += kPause_us + kShift_us) {
      pause_at(pause_us);
    }
  }
  if (options.player == Player::kChanges) {
    for (TimeUs none_us = begin_us + kChange_us; none_us + kNoTask_us < end_us;
         none_us += kChange_us) {
      phases.push_back({none_us, armed});
      phases.push_back({none_us + kNoTask_us, at_work});
    }
  }
  if (options.seconds > 0.0) {
    phases.push_back({end_us, kAtRest});
  }
  return phases;
}

/// An interface that went down is opened again when it is back.
class Reopener {
 public:
  explicit Reopener(SocketCanPort& port) : port_(port) {}

  void look(int cycle) {
    const CanPortState state = port_.state();
    if (cycle % kReopenCycles == 0 &&
        (state == CanPortState::kDown || state == CanPortState::kBusOff)) {
      // Still away: tried again in a moment.
      static_cast<void>(port_.open());
    }
  }

 private:
  SocketCanPort& port_;
};

}  // namespace

// All that the operator reads is the controller's stamp.
template <class Kind>
PlantBus<Kind>::PlantBus(const PlantRunOptions& options, const std::vector<std::uint32_t>& ids)
    : options_(options),
      port_(options.interface, ids),
      operator_port_(options.interface, {Kind::Dbc::EcuIdentity::kId}),
      driver_(operator_way_) {
  open(port_, options.interface);
  open(operator_port_, options.interface);
  if (const ErrorText error = catch_stop_signals(); !error.empty()) {
    throw std::runtime_error(error.c_str());
  }
}

template <class Kind>
void PlantBus<Kind>::let_go() {
  driver_.set_schedule({{0, kAtRest}});
}

template <class Kind>
PlantBusFigures PlantBus<Kind>::run(Task task, const std::function<void(TimeUs)>& machine) {
  driver_.set_schedule(schedule(options_, task));
  CyclicClock clock(microseconds(static_cast<double>(kPlantPeriod_us) * 1e-6 / options_.speed));
  const TimeUs end_us = microseconds(options_.seconds);
  Reopener reopener(port_);
  Reopener operator_reopener(operator_port_);
  PlantBusFigures figures;
  int cycle = 0;
  std::uint64_t made_up = 0;
  for (TimeUs now_us = 0; !stop_requested() && (end_us == 0 || now_us < end_us);
       now_us += kPlantPeriod_us) {
    if (made_up > 0) {
      --made_up;
    } else {
      made_up = std::min(clock.wait().skipped, kMostMadeUp);
      if (cycle == 0) {
        // What has come in while the machine was made is not fresh any more: two frames of a sender
        // at once look like two senders.
        open(port_, options_.interface);
        open(operator_port_, options_.interface);
      }
      reopener.look(cycle);
      operator_reopener.look(cycle);
      ++cycle;
    }
    // The last of them is the one that is due.
    machine_way_.set_quiet(made_up > 0);
    operator_way_.set_quiet(made_up > 0);
    machine(now_us);
    if (options_.player != Player::kNobody) {
      driver_.step(now_us);
    }
    figures.simulated_s += static_cast<double>(kPlantPeriod_us) * 1e-6;
  }
  figures.late_cycles = clock.overruns();
  figures.frames_dropped =
      port_.counters().dropped_transmit + operator_port_.counters().dropped_transmit;
  return figures;
}

template class PlantBus<ExcavatorSim>;
template class PlantBus<DozerSim>;

}  // namespace graben::runs
