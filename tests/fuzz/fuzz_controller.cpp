// SPDX-License-Identifier: Apache-2.0
/// The controller's whole cycle on any signals: values, validity and age of each as raw as a driver
/// could hand them over, over a dozen cycles that start the way an operator starts the machine.
/// Then all is well again, and whatever came before, the operator gets it going within 4 s. The
/// same for a machine without a swing drive and for one with it.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "firmware/excavator/excavator_controller.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/firmware/inputs.hpp"

namespace graben::test {
namespace {

constexpr unsigned kCycles = 12;
constexpr TimeUs kStart_us = kSecondUs;
constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
constexpr TimeUs kRecovery_us = 4 * kSecondUs;
constexpr int kStaysCycles = 10;

struct RawCycle {
  ExcavatorInputs inputs;
  std::uint64_t period_us;
};

struct RawRun {
  std::array<RawCycle, kCycles> cycle;
  std::uint64_t machine;  ///< Which law, which duty_rate.
};

/// A bool has two values, any byte does not.
void make_bool(bool& value) {
  unsigned char byte = 0;
  std::memcpy(&byte, &value, sizeof(byte));
  value = byte % 2 == 1;
}

/// What can go wrong with a cycle's outputs, whatever came in.
std::string unsafe_outputs(const ExcavatorOutputs& outputs) {
  const auto all = [](const auto& values, auto good) {
    return std::all_of(values.begin(), values.end(), good);
  };
  const auto finite = [](double value) { return std::isfinite(value); };
  const ExcavatorStatus& status = outputs.status;
  if (!all(outputs.duty_ratio, [](double duty) { return std::abs(duty) <= 1.0; })) {
    return "a duty out of -1 .. 1";
  }
  if (!outputs.enable && !all(outputs.duty_ratio, [](double duty) { return duty == 0.0; })) {
    return "a spool open without enable";
  }
  if (outputs.enable != (status.mode == EcuMode::kActive)) {
    return fmt::format("enable {} in mode {}", outputs.enable, static_cast<int>(status.mode));
  }
  if (!(status.lambda >= 0.0 && status.lambda <= 1.0)) {
    return fmt::format("lambda {}", status.lambda);
  }
  return all(status.wanted_velocity_mps, finite) && all(status.pump_pressure_pa, finite) &&
                 std::isfinite(status.path_error_m) && std::isfinite(status.swing_wanted_radps)
             ? ""
             : "a status that is not finite";
}

/// What goes on the wire may rise no faster than the profile says, from whatever cycle.
class Wire {
 public:
  explicit Wire(double duty_rate_ps) : duty_rate_ps_(duty_rate_ps) {}

  std::string after(const ExcavatorOutputs& outputs, TimeUs now_us) {
    constexpr double kLongest_s = 0.02;
    constexpr double kRounding = 1e-12;
    const double elapsed_s = std::min(1e-6 * static_cast<double>(now_us - last_us_), kLongest_s);
    std::string wrong = unsafe_outputs(outputs);
    for (unsigned i = 0; i < kDriveCount; ++i) {
      const double duty = outputs.duty_ratio[i];
      const double from = duty * last_[i] > 0.0 ? std::abs(last_[i]) : 0.0;
      if (wrong.empty() && std::abs(duty) > from + duty_rate_ps_ * elapsed_s + kRounding) {
        wrong = fmt::format("duty {} from {} to {} in {} s", i, last_[i], duty, elapsed_s);
      }
    }
    tally("cycles") += 1;
    tally("cycles that open a spool") += outputs.duty_ratio != Duties{} ? 1 : 0;
    tally("of those commissioning or by hand") +=
        outputs.duty_ratio != Duties{} && by_hand_ ? 1 : 0;
    last_ = outputs.duty_ratio;
    last_us_ = now_us;
    return wrong;
  }
  void asked(Task task) { by_hand_ = task == Task::kCommission || is_by_lever(task); }

 private:
  using Duties = std::array<double, kDriveCount>;

  double duty_rate_ps_;
  Duties last_{};
  TimeUs last_us_ = kStart_us;
  bool by_hand_ = false;
};

/// Sound inputs, enable released, then given again with the task at rest, then the task.
std::string recover(ExcavatorController& controller, bool has_swing, TimeUs now_us, Wire& wire) {
  ExcavatorOutputs told;
  int active = 0;
  for (const TimeUs end_us = now_us + kRecovery_us; now_us < end_us;) {
    now_us += kPeriod_us;
    ExcavatorInputs inputs = following_inputs(told, now_us);
    if (has_swing) {
      make_12t(inputs);
    }
    const EcuMode mode = told.status.mode;
    const bool in_motion = mode == EcuMode::kArmed || mode == EcuMode::kActive;
    inputs.driver.enable.value = in_motion || mode == EcuMode::kReady;
    // Who has once said a word from outside has to be there.
    inputs.external = fresh(ExternalWord{ExternalLevel::kFree, false, 0, 1.0, 1.0}, now_us);
    inputs.driver.task.value = in_motion ? Task::kDig : Task::kNone;
    told = controller.step(inputs, now_us);
    if (std::string wrong = wire.after(told, now_us); !wrong.empty()) {
      return wrong;
    }
    active = told.status.mode == EcuMode::kActive ? active + 1 : 0;
    if (active >= kStaysCycles) {
      return "";
    }
  }
  return fmt::format("does not recover: mode {}, fault {}, why not armed {:X}",
                     static_cast<int>(told.status.mode), static_cast<int>(told.status.fault),
                     told.status.why_not_armed);
}

/// The machine with another law, and another rate of its duties.
ExcavatorProfile drawn(ExcavatorProfile profile, std::uint64_t machine) {
  constexpr std::array<ControlLaw, 3> kLaws = {ControlLaw::kOil, ControlLaw::kServo,
                                               ControlLaw::kKim};
  if (profile.control.law == ControlLaw::kOil) {
    profile.control.law = kLaws[machine % kLaws.size()];
  }
  profile.control.duty_rate_ps = kDutyRate_ps - 4.0 * static_cast<double>(machine / 3 % 11);
  return profile;
}

std::string check_run(const ExcavatorProfile& profile, RawRun run) {
  const ExcavatorSetup setup(drawn(profile, run.machine));
  Wire wire(setup.profile.control.duty_rate_ps);
  ExcavatorController controller(setup);
  TimeUs now_us = kStart_us;
  bool stopped = false;
  for (RawCycle& cycle : run.cycle) {
    for (bool* value : {&cycle.inputs.driver.enable.value, &cycle.inputs.same_machine.value,
                        &cycle.inputs.valve_enabled.value, &cycle.inputs.link.out_of_range,
                        &cycle.inputs.link.stop_requested, &cycle.inputs.link.cannot_answer,
                        &cycle.inputs.external.value.resumes}) {
      make_bool(*value);
    }
    stopped = stopped || cycle.inputs.link.stop_requested;
    now_us += static_cast<TimeUs>(cycle.period_us % (kSecondUs + 1));
    wire.asked(cycle.inputs.driver.task.value);
    const std::string wrong = wire.after(controller.step(cycle.inputs, now_us), now_us);
    if (!wrong.empty()) {
      return wrong;
    }
  }
  // Told to end, it stays where it is.
  return stopped ? "" : recover(controller, profile.has_swing(), now_us, wire);
}

}  // namespace

std::string check_bytes(const std::uint8_t* data, std::size_t size) {
  const auto run = raw_from_bytes<RawRun>(data, size);
  const std::string wrong = check_run(excavator().profile, run);
  return wrong.empty() ? check_run(excavator_12t().profile, run) : wrong;
}

bool inputs_are_numbers() { return true; }

std::vector<Bytes> seed_inputs() {
  std::vector<Bytes> seeds;
  for (const Task task :
       {Task::kDig, Task::kCommission, Task::kJog, Task::kCoordinated, Task::kAssist}) {
    RawRun run{};
    for (unsigned n = 0; n < kCycles; ++n) {
      const TimeUs now_us = kStart_us + (n + 1) * kPeriod_us;
      ExcavatorInputs inputs = complete_inputs(now_us);
      inputs.driver.enable.value = n >= 2;
      inputs.driver.task.value = n == 1 || n == 2 ? Task::kNone : task;
      const bool moves = n > 3;
      inputs.tried_ratio = fresh<std::array<double, kAxisCount>>({moves ? 0.9 : 0.0}, now_us);
      inputs.lever_ratio = fresh<std::array<double, kDriveCount>>({moves ? 1.0 : 0.0}, now_us);
      for (Signal<StrokeWindow>& window : inputs.window) {
        window = fresh(StrokeWindow{0.1, 1.2}, now_us);
      }
      run.cycle[n].period_us = kPeriod_us;
      run.cycle[n].inputs = inputs;
    }
    seeds.push_back(bytes_from_raw(run));
  }
  return seeds;
}

}  // namespace graben::test
