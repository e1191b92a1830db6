// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/reports/page_setup.hpp"
#include "app/scope/page/scope_page.hpp"
#include "app/scope/server/can_source.hpp"
#include "app/scope/server/serve.hpp"
#include "app/scope/server/show.hpp"
#include "app/scope/sim/sim_source.hpp"

namespace graben::cli {
namespace {

struct ScopeCommand {
  std::vector<std::string> can;
  std::optional<std::string> log;
  std::optional<std::string> sim;
  std::optional<std::uint64_t> seed;
  machines::SimulatedChoice simulated;
  std::optional<std::string> soil;
  std::optional<int> bitrate_bps;
  std::string unknown_drives;  ///< See demand_known().
  scope::ServerOptions server;
  design::DesignSource design;
  reports::SetupOptions setup;
};

constexpr int kUsualBitrate_bps = 500000;

scope::SimOptions simulation(const ScopeCommand& options) {
  const bool has_task = *options.sim == "autodig";
  if (options.setup.tasks.size() > (has_task ? 1U : 0U)) {
    throw std::runtime_error(
        fmt::format("--sim {}: takes {}", *options.sim, has_task ? "one --task" : "no --task"));
  }
  if (options.bitrate_bps) {
    throw std::runtime_error("--bitrate: not with --sim, whose bus has its own");
  }
  scope::SimOptions result;
  result.task = *options.sim;
  result.profile = options.setup.profile;
  result.designed = options.setup.designed;
  result.seed = options.seed;
  result.simulated = options.simulated;
  result.soil = options.soil.value_or("");
  result.unknown = options.unknown_drives.empty() ? machines::UnknownTask::kRefused
                                                  : machines::UnknownTask::kSlow;
  if (!options.setup.tasks.empty()) {
    result.task_file = options.setup.tasks.front();
  }
  return result;
}

/// The simulated controller has the one task, by the number 0.
reports::SetupOptions setup_of(const ScopeCommand& options) {
  reports::SetupOptions setup = options.setup;
  if (options.sim == "autodig" && setup.tasks.empty()) {
    setup.tasks = {"flatten"};
  }
  return setup;
}

/// The dozer with the design that is told; none where none is.
std::optional<machines::SimulatedDozer> designed_of(const ScopeCommand& options) {
  const design::DesignSource& design = options.design;
  if (design.file.empty() && design.surface.empty() && !design.has_track()) {
    return std::nullopt;
  }
  if (options.sim && *options.sim != "grade") {
    throw std::runtime_error("--design: of a dozer, so with --sim grade, --log or --can");
  }
  const std::string profile = options.setup.profile.value_or("dozer_9t");
  return designed(machines::load_simulated_dozer(machines::find_profile(profile)), design).machine;
}

void show(const ScopeCommand& options) {
  if (options.seed && !options.sim) {
    throw std::runtime_error("--seed: only with --sim");
  }
  if (!options.simulated.is_own() && !options.sim) {
    throw std::runtime_error("--simulated, --hidden: only with --sim");
  }
  if (options.setup.bus && options.sim) {
    throw std::runtime_error("--bus: not with --sim, whose machine speaks our own");
  }
  if (options.soil && !options.sim) {
    throw std::runtime_error("--soil: only with --sim");
  }
  if (!options.unknown_drives.empty() && !options.sim) {
    throw std::runtime_error("--unknown-drives: only with --sim");
  }
  const scope::Pages pages{scope::scope_page(), scope::operator_page()};
  const int bitrate_bps = options.bitrate_bps.value_or(kUsualBitrate_bps);
  if (options.sim) {
    const auto source = scope::make_sim_source(simulation(options));
    scope::serve(options.server, pages, *source, reports::shared_setup(setup_of(options)));
  } else if (options.log) {
    scope::LogShow log(*options.log, bitrate_bps, reports::shared_setup(options.setup));
    scope::serve(options.server, pages, log);
  } else {
    scope::CanSource source(options.can, bitrate_bps);
    scope::serve(options.server, pages, source, reports::shared_setup(options.setup));
  }
}

}  // namespace

void add_scope(CLI::App& app, int& status) {
  auto options = std::make_shared<ScopeCommand>();
  CLI::App* command = add_command(app, "scope");
  auto* source = command->add_option_group("source", "What is shown");
  source->add_option("--can", options->can, "CAN interfaces, such as can0 or can0,can1")
      ->delimiter(',')
      ->allow_extra_args(false);
  source->add_option("--log", options->log,
                     "Log of candump -l, plain or gzip, from its start to its end");
  source->add_option("--sim", options->sim, "Simulation in real time: dig, grade or autodig")
      ->check(one_of({"dig", "grade", "autodig"}));
  source->require_option(1);
  command
      ->add_option("--port", options->server.port, "Of the page, 0 .. 65535; 0: any that is free")
      ->check(whole_number_between(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--host", options->server.host,
                   "Address to listen on; another one than this lets other machines look")
      ->capture_default_str();
  command->add_option("--profile", options->setup.profile,
                      "Machine profile beside the shipped ones: file or shipped name; with --sim "
                      "the simulated one");
  command->add_option(
      "--bus", options->setup.bus,
      "Bus profile beside the shipped ones, for frames of a machine that was put on "
      "it: a file, or a shipped name; not with --sim");
  command
      ->add_option("--task", options->setup.tasks,
                   "Task that the controller has, as it was told: file or shipped name, up to 4, "
                   "for TaskNumber 0, 1, ...; without it the shipped ones that the machine can "
                   "do. With --sim autodig the one that it does, flatten unless told")
      ->allow_extra_args(false);
  command
      ->add_option("--bitrate", options->bitrate_bps,
                   "Of the bus, bit/s, 10000 .. 1000000, for its load; 500000 unless told")
      ->check(whole_number_between(10000, 1000000));
  command
      ->add_option("--seed", options->seed,
                   "Of the simulated sensors' errors and of what the controller does not know; "
                   "exact without it")
      ->check(whole_number());
  add_simulated_options(*command, options->simulated);
  add_design_options(*command, options->design);
  add_unknown_drives_option(*command, options->unknown_drives);
  add_soil_option(
      *command, [options](const std::string& name) { options->soil = name; },
      "Of --sim dig and autodig: ground that the bucket cuts, or with dig kim, the paper's field "
      "of force, which --soil alone is");
  add_examples(*command, {"scope --sim dig", "scope --log out/dig.log",
                          "scope --can can0 --profile mine.toml"});
  command->callback([options, &status] {
    status = guarded("scope", [&] {
      options->setup.designed = designed_of(*options);
      show(*options);
    });
  });
}

}  // namespace graben::cli
