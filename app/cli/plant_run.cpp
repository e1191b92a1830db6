#include "app/cli/plant_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "app/cli/path_progress.hpp"
#include "app/plant/operator_node.hpp"
#include "app/plant/plant_node.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/socketcan_port.hpp"
#include "platform/linux/stop_signal.hpp"

namespace graben::cli {
namespace {

constexpr TimeUs kPeriod_us = plant::PlantNode::kCycleUs;
constexpr TimeUs kTaskAfter_us = 100 * kMillisecondUs;
/// The operator lets go before the end, and what the machine then does is seen.
constexpr TimeUs kRelease_us = 500 * kMillisecondUs;
constexpr TimeUs kShift_us = 5 * kSecondUs;
constexpr TimeUs kPause_us = kSecondUs;
constexpr TimeUs kMostShifts = 10000;
constexpr int kReopenCycles = 20;

TimeUs microseconds(double time_s) { return static_cast<TimeUs>(std::llround(time_s * 1e6)); }

void open(SocketCanPort& port, const std::string& interface) {
  if (!port.open()) {
    throw std::runtime_error(interface + ": " + port.last_error());
  }
}

/// Everything that the operator does, in its order.
std::vector<plant::OperatorPhase> schedule(const PlantRunOptions& options) {
  const plant::OperatorRequest at_rest = {false, OperatorMode::kAutomatic, Task::kNone, 0.0};
  std::vector<plant::OperatorPhase> phases = {{0, at_rest}};
  const auto dig_from = [&](TimeUs enable_us) {
    phases.push_back({enable_us, {true, OperatorMode::kAutomatic, Task::kNone, 0.0}});
    phases.push_back({enable_us + kTaskAfter_us,
                      {true, OperatorMode::kAutomatic, Task::kDig, options.speed_override_ratio}});
  };
  const TimeUs begin_us = microseconds(options.enable_after_s);
  const TimeUs end_us = options.seconds > 0.0 ? microseconds(options.seconds) - kRelease_us
                                              : kMostShifts * (kShift_us + kPause_us);
  dig_from(begin_us);
  if (options.player == Player::kShifts) {
    for (TimeUs pause_us = begin_us + kShift_us; pause_us + kPause_us < end_us;
         pause_us += kPause_us + kShift_us) {
      phases.push_back({pause_us, at_rest});
      dig_from(pause_us + kPause_us);
    }
  }
  if (options.seconds > 0.0) {
    phases.push_back({end_us, at_rest});
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

/// Adds up what the figures speak of.
class Observer {
 public:
  Observer(const machines::ExcavatorMachine& machine, PlantRunResult& result)
      : path_(machine.profile.dig_path), progress_(path_, 1.0), result_(result) {}

  void see(const plant::PlantNode& node, TimeUs now_us) {
    constexpr double kPeriod_s = static_cast<double>(kPeriod_us) * 1e-6;
    result_.simulated_s += kPeriod_s;
    if (!node.spools_enabled()) {
      return;
    }
    result_.enabled_s += kPeriod_s;
    const plant::TipPose tip = node.plant().tip();
    progress_.update(tip.position_m, near_path(path_, tip.position_m, tip.attitude_rad), now_us);
    if (progress_.on_path()) {
      const double error_m = (path_.closest(tip.position_m).position_m - tip.position_m).norm();
      result_.max_error_m = std::max(result_.max_error_m, error_m);
      squares_m2_ += error_m * error_m;
      result_.on_path_s += kPeriod_s;
      result_.rmse_error_m = std::sqrt(squares_m2_ * kPeriod_s / result_.on_path_s);
      result_.loops = progress_.share();
    }
  }

 private:
  RoundedRectangle path_;
  PathProgress progress_;
  PlantRunResult& result_;
  double squares_m2_ = 0.0;
};

}  // namespace

PlantRunResult run_plant(const machines::ExcavatorMachine& machine,
                         const PlantRunOptions& options) {
  namespace bus = dbc::excavator;
  SocketCanPort port(options.interface, {bus::SpoolCommand::kId, bus::PumpCommand::kId});
  SocketCanPort operator_port(options.interface, {bus::EcuStatus::kId});
  open(port, options.interface);
  open(operator_port, options.interface);
  plant::PlantNode node(
      machine.plant,
      {options.start_strokes_m[0], options.start_strokes_m[1], options.start_strokes_m[2]}, port,
      machine.hash);
  plant::OperatorNode driver(operator_port);
  driver.set_schedule(schedule(options));
  if (const ErrorText error = catch_stop_signals(); !error.empty()) {
    throw std::runtime_error(error.c_str());
  }

  PlantRunResult result;
  Observer observer(machine, result);
  CyclicClock clock(microseconds(static_cast<double>(kPeriod_us) * 1e-6 / options.speed));
  const TimeUs end_us = microseconds(options.seconds);
  Reopener reopener(port);
  Reopener operator_reopener(operator_port);
  int cycle = 0;
  for (TimeUs now_us = 0; !stop_requested() && (end_us == 0 || now_us < end_us);
       now_us += kPeriod_us) {
    static_cast<void>(clock.wait());
    reopener.look(cycle);
    operator_reopener.look(cycle);
    ++cycle;
    node.step(now_us);
    if (options.player != Player::kNobody) {
      driver.step(now_us);
    }
    observer.see(node, now_us);
  }
  result.commands_accepted = node.counters().accepted;
  result.commands_rejected = node.counters().rejected + node.counters().wrong_format;
  result.command_timeouts = node.counters().timeouts;
  result.late_cycles = clock.overruns();
  result.frames_dropped =
      port.counters().dropped_transmit + operator_port.counters().dropped_transmit;
  result.peak_chamber_pressure_pa = node.plant().peak_chamber_pressure_pa();
  return result;
}

}  // namespace graben::cli
