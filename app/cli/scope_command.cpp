#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/guarded.hpp"
#include "app/scope/can_source.hpp"
#include "app/scope/log_show.hpp"
#include "app/scope/scope_page.hpp"
#include "app/scope/serve.hpp"
#include "app/scope/setup_json.hpp"

namespace graben::cli {
namespace {

struct Options {
  std::vector<std::string> can;
  std::optional<std::string> log;
  scope::ServerOptions server;
  scope::SetupOptions setup;
  int bitrate_bps = 500000;
};

void show(const Options& options) {
  const std::string page = std::string(scope::scope_page_head()).append(scope::scope_page_tail());
  const nlohmann::json parts = scope::shared_setup(options.setup);
  if (options.log) {
    scope::LogShow log(*options.log, options.bitrate_bps, parts);
    scope::serve(options.server, page, log);
    return;
  }
  scope::CanSource source(options.can, options.bitrate_bps);
  scope::serve(options.server, page, source, parts);
}

}  // namespace

void add_scope(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "scope",
      "The machine in a browser: posed, with plots and faults, from what is on the bus. Serves a "
      "page until SIGINT or SIGTERM; a bus is only heard. Needs no privilege");
  auto* source = command->add_option_group("source", "What is shown; one of them");
  source->add_option("--can", options->can, "CAN interfaces, such as can0 or can0,can1")
      ->delimiter(',')
      ->allow_extra_args(false);
  source->add_option("--log", options->log, "Log of candump -l, from its start to its end");
  source->require_option(1);
  command
      ->add_option("--port", options->server.port, "Of the page, 0 .. 65535; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--host", options->server.host,
                   "Address to listen on; another one than this lets other machines look")
      ->capture_default_str();
  command->add_option("--profile", options->setup.profile,
                      "Machine profile beside the shipped ones: file or shipped name");
  command
      ->add_option("--task", options->setup.tasks,
                   "Task that the controller has, as it was told: file or shipped name, up to 4, "
                   "for TaskNumber 0, 1, ...; without it the shipped ones that the machine can do")
      ->allow_extra_args(false);
  command
      ->add_option("--bitrate", options->bitrate_bps,
                   "Of the bus, bit/s, 10000 .. 1000000, for its load")
      ->check(CLI::Range(10000, 1000000))
      ->capture_default_str();
  command->callback([options, &status] { status = guarded("scope", [&] { show(*options); }); });
}

}  // namespace graben::cli
