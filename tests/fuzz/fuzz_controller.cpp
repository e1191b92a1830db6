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

using RawRun = std::array<RawCycle, kCycles>;

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

/// Sound inputs, enable released, then given again with the task at rest, then the task.
std::string recover(ExcavatorController& controller, bool has_swing, TimeUs now_us) {
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
    inputs.driver.task.value = in_motion ? Task::kDig : Task::kNone;
    told = controller.step(inputs, now_us);
    if (std::string wrong = unsafe_outputs(told); !wrong.empty()) {
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

std::string check_run(const ExcavatorProfile& profile, RawRun run) {
  const ExcavatorSetup setup(profile);
  ExcavatorController controller(setup);
  TimeUs now_us = kStart_us;
  bool stopped = false;
  for (RawCycle& cycle : run) {
    for (bool* value : {&cycle.inputs.driver.enable.value, &cycle.inputs.same_machine.value,
                        &cycle.inputs.valve_enabled.value, &cycle.inputs.link.out_of_range,
                        &cycle.inputs.link.stop_requested, &cycle.inputs.link.cannot_answer}) {
      make_bool(*value);
    }
    stopped = stopped || cycle.inputs.link.stop_requested;
    now_us += static_cast<TimeUs>(cycle.period_us % (kSecondUs + 1));
    const std::string wrong = unsafe_outputs(controller.step(cycle.inputs, now_us));
    if (!wrong.empty()) {
      return wrong;
    }
  }
  // Told to end, it stays where it is.
  return stopped ? "" : recover(controller, profile.has_swing(), now_us);
}

}  // namespace

std::string check_bytes(const std::uint8_t* data, std::size_t size) {
  const auto run = raw_from_bytes<RawRun>(data, size);
  const std::string wrong = check_run(excavator().profile, run);
  return wrong.empty() ? check_run(excavator_12t().profile, run) : wrong;
}

bool inputs_are_numbers() { return true; }

std::vector<Bytes> seed_inputs() {
  RawRun run{};
  for (unsigned n = 0; n < kCycles; ++n) {
    run[n].period_us = kPeriod_us;
    run[n].inputs = complete_inputs(kStart_us + (n + 1) * kPeriod_us);
    run[n].inputs.driver.enable.value = n >= 2;
    run[n].inputs.driver.task.value = n == 1 || n == 2 ? Task::kNone : Task::kDig;
  }
  return {bytes_from_raw(run)};
}

}  // namespace graben::test
