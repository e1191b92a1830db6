// SPDX-License-Identifier: Apache-2.0
/// Writes the candump log of a hidden excavator's commissioning: what `graben identify --log` is
/// tried on.

#include <fmt/format.h>

#include <cstdlib>
#include <exception>

#include "app/runs/commission_run.hpp"
#include "app/runs/identify_run.hpp"

namespace {

void write_log(const char* profile, const char* seed, const char* file) {
  using namespace graben;
  const machines::SimulatedExcavator machine = runs::hidden_with_noise(
      machines::load_simulated_excavator(profile), std::strtoull(seed, nullptr, 10));
  runs::CommissionOptions options = runs::usual_commission(machine);
  options.log_file = file;
  const runs::CommissionResult done =
      runs::run_commission(machine, options, {}, [](double, const std::string&) {});
  if (done.end != runs::CommissionEnd::kDone) {
    throw std::runtime_error(fmt::format("commissioning stopped in step {}", done.step));
  }
  fmt::print("{:.1f} s of the machine\n", done.machine_s);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    fmt::print(stderr, "usage: commission_log PROFILE SEED FILE\n");
    return 2;
  }
  try {
    write_log(arguments[1], arguments[2], arguments[3]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "commission_log: {}\n", error.what());
    return 1;
  }
}
