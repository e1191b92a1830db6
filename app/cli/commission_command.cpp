#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/options.hpp"
#include "app/runs/code_text.hpp"
#include "app/runs/commission_run.hpp"

namespace graben::cli {
namespace {

struct CommissionCommand {
  machines::SimulatedChoice simulated;
  std::string profile = "excavator_22t";
  std::string log = "out/commission.log";
  bool verbose = false;
};

const char* end_text(commission::StepEnd end) {
  switch (end) {
    case commission::StepEnd::kDone:
      return "done";
    case commission::StepEnd::kAtWindow:
      return "at window";
    case commission::StepEnd::kNoMotion:
      return "no motion";
  }
  return "";
}

void commission_in_memory(const CommissionCommand& options) {
  const machines::SimulatedExcavator machine = machines::load_simulated_excavator(
      machines::find_profile(options.profile), options.simulated);
  runs::CommissionOptions run = runs::usual_commission(machine);
  run.log_file = options.log;
  runs::CommissionResult result;
  {
    ProgressBar bar("commission");
    result = runs::run_commission(machine, run, nullptr, bar.progress());
  }
  const auto steps = commission::CommissionSequence(run.sequence).steps();
  for (std::size_t at = 0; at < result.steps.size(); ++at) {
    const commission::StepResult& step = result.steps[at];
    fmt::print("{:<49} {:<11} {:>4.1f} s {:>4.0f} % {:>4.0f} mm/s\n", step_text(steps[at]),
               end_text(step.end), step.took_s, 100.0 * step.duty, 1e3 * step.speed_mps);
  }
  fmt::print("machine time {:.0f} s\nlog {}\n", result.machine_s, options.log);
  if (result.end == runs::CommissionEnd::kFault) {
    throw std::runtime_error(fmt::format("stopped at \"{}\": {}", step_text(steps[result.step]),
                                         runs::fault_words(result.fault)));
  }
  if (result.end == runs::CommissionEnd::kTooLong) {
    throw std::runtime_error(fmt::format("not done after {} s, at \"{}\"", runs::kCommissionMost_s,
                                         step_text(steps[result.step])));
  }
}

}  // namespace

void add_commission(CLI::App& app, int& status) {
  auto options = std::make_shared<CommissionCommand>();
  CLI::App* command = app.add_subcommand(
      "commission",
      "Leads a machine through what identify needs, one drive and direction at a time, guarded by "
      "its ECU: edges, steps at five speeds, pulses, touches of the stroke's ends, two drives of "
      "one pump. Writes a log; changes nothing");
  add_profile_option(*command, options->profile);
  add_simulated_options(*command, options->simulated);
  command->add_option("--log", options->log, "candump log to write")->capture_default_str();
  command->callback([options, &status] {
    status = guarded("commission", [&] { commission_in_memory(*options); });
  });
}

}  // namespace graben::cli
