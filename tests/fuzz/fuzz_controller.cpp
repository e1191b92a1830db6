/// The controller's whole cycle on any signals: values, validity and age of each as raw as a driver
/// could hand them over, over a dozen cycles that start the way an operator starts the machine.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/excavator_controller.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/firmware/inputs.hpp"

namespace graben::test {
namespace {

constexpr unsigned kCycles = 12;
constexpr TimeUs kStart_us = kSecondUs;
constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;

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
                 std::isfinite(status.path_error_m)
             ? ""
             : "a status that is not finite";
}

}  // namespace

std::string check_bytes(const std::uint8_t* data, std::size_t size) {
  auto run = raw_from_bytes<RawRun>(data, size);
  ExcavatorController controller(excavator().profile);
  TimeUs now_us = kStart_us;
  for (RawCycle& cycle : run) {
    make_bool(cycle.inputs.driver.enable.value);
    make_bool(cycle.inputs.same_machine.value);
    now_us += static_cast<TimeUs>(cycle.period_us % (kSecondUs + 1));
    const std::string wrong = unsafe_outputs(controller.step(cycle.inputs, now_us));
    if (!wrong.empty()) {
      return wrong;
    }
  }
  return "";
}

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
