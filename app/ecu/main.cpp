// SPDX-License-Identifier: Apache-2.0
/// graben-ecu: what is deployed. Its command line, then the process.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "app/ecu/address_name.hpp"
#include "app/ecu/ecu_process.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"
#include "platform/linux/process.hpp"

namespace graben::ecu {
namespace {
constexpr int kWrongUsage = 2;
constexpr std::size_t kMostInterfaces = 4;
constexpr std::size_t kLongestName = 15;  // IFNAMSIZ without its end.

std::string interface_name(const std::string& name) {
  const bool good = !name.empty() && name.size() <= kLongestName &&
                    name.find_first_of("/ \t") == std::string::npos;
  return good ? ""
              : "'" + name + "' is no name of an interface: 1 to 15 characters, no blank, no /";
}

std::string folder_name(const std::string& name) {
  return name.empty() ? "is empty; wanted: a folder" : "";
}

/// Without a value when the process is to end at once, with `status`: 0 after --help or --version,
/// 2 after wrong usage, which has been told.
std::optional<EcuOptions> read_options(int argc, const char* const* argv, int& status) {
  EcuOptions options;
  CLI::App app(
      "graben-ecu: the controller as a process on CAN. Silent until the machine, the "
      "operator and the bus are all there; SIGTERM brings neutral, then ends it.");
  app.set_version_flag("--version", GRABEN_VERSION);
  app.add_option("--can", options.interfaces,
                 "CAN interface; up to 4, heard and sent to alike (--can can0 --can can1)")
      ->required()
      ->expected(1, static_cast<int>(kMostInterfaces))
      ->check(CLI::Validator(interface_name, "NAME"));
  app.add_option("--profile", options.profile,
                 "Machine profile: a file, or a name in /etc/graben or /usr/share/graben")
      ->required();
  app.add_option("--task", options.tasks,
                 "Task of an excavator: a file, or a name in /etc/graben/tasks or "
                 "/usr/share/graben/tasks; up to 4, for the operator's TaskNumber 0, 1, ...")
      ->expected(1, kTaskMost);
  app.add_option("--rt-priority", options.priority, "SCHED_FIFO priority, 1 .. 99")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  app.add_option("--cpu", options.cpu, "Stay on this processor, from 0")
      ->check(CLI::Range(0, 1023));
  app.add_option("--stats", options.stats_file,
                 "Write cycle times, wake-up latencies and counters to this file at the end");
  std::string name;
  app.add_option("--name", name,
                 "NAME on J1939, 16 hexadecimal digits: the lower one keeps an address that two "
                 "claim. Unless told: industry group 3 and an identity from /etc/machine-id");
  app.add_option("--store", options.store,
                 "Folder for what outlives the power: stored faults and their freeze frames, at "
                 "most 1472 writes of 4 KiB in a day; $STATE_DIRECTORY unless told, which the "
                 "service has, else none. A disk that is full, missing or read-only is said and "
                 "stops nothing")
      ->check(CLI::Validator(folder_name, "DIR"));
  app.add_flag("--keep-ground", options.keeps_ground,
               "Keep the ground as the edge has left it in the store, for `graben as-built "
               "--record`: a write each 10 s while it changes, and 1.6 MB of memory more");
  std::string unknown_drives;
  app.add_option("--unknown-drives", unknown_drives,
                 "slow: tasks that need drives that were not commissioned, where the profile is "
                 "from `graben identify`, at 30 % of the speed; refused unless told")
      ->check(CLI::IsMember({"slow"}));
  bool no_real_time = false;
  app.add_flag("--no-realtime", no_real_time,
               "Run without real-time priority and locked memory; said in every EcuHealth frame. "
               "Not for a machine");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    status = app.exit(error) == 0 ? 0 : kWrongUsage;
    return std::nullopt;
  }
  std::vector<std::string> names = options.interfaces;
  std::sort(names.begin(), names.end());
  if (std::adjacent_find(names.begin(), names.end()) != names.end()) {
    std::fputs("graben-ecu: --can: an interface is named twice\n", stderr);
    status = kWrongUsage;
    return std::nullopt;
  }
  if (options.keeps_ground && store_folder(options.store, std::getenv("STATE_DIRECTORY")).empty()) {
    std::fputs("graben-ecu: --keep-ground: there is no store to keep it in (--store)\n", stderr);
    status = kWrongUsage;
    return std::nullopt;
  }
  if (app.count("--name") > 0) {
    std::string error;
    options.name = parse_name(name, error);
    if (!options.name) {
      std::fprintf(stderr, "graben-ecu: --name: %s\n", error.c_str());
      status = kWrongUsage;
      return std::nullopt;
    }
  }
  options.unknown =
      unknown_drives.empty() ? machines::UnknownTask::kRefused : machines::UnknownTask::kSlow;
  options.real_time = !no_real_time;
  return options;
}

}  // namespace
}  // namespace graben::ecu

int main(int argc, char** argv) {
  const graben::TimeUs began_us = graben::monotonic_now_us();
  if (const graben::ErrorText error = graben::tune_heap(); !error.empty()) {
    std::fprintf(stderr, "graben-ecu: %s\n", error.c_str());
    return 1;
  }
  int status = 0;
  const auto options = graben::ecu::read_options(argc, argv, status);
  return options ? graben::ecu::run(*options, began_us) : status;
}
