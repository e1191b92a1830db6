// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/faults_on_bus.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/ecu/store/folder_files.hpp"
#include "app/ecu/store/stored_faults.hpp"
#include "app/runs/code_text.hpp"
#include "hal/link/message_rules.hpp"

namespace graben::cli {
namespace {

using nlohmann::ordered_json;

constexpr double kSecondsPerHour = 3600.0;

struct FaultsCommand {
  std::string store;
  FaultsOnBus bus;
  bool json = false;
  int frame = 0;
};

/// "12:30:07 (2026-11-29 20:10 UTC)"
std::string time_text(std::uint32_t operation_s, std::uint32_t unix_s) {
  const std::string hours =
      fmt::format("{}:{:02}:{:02}", operation_s / 3600, operation_s / 60 % 60, operation_s % 60);
  return unix_s == 0 ? hours
                     : fmt::format("{} ({:%Y-%m-%d %H:%M} UTC)", hours,
                                   fmt::gmtime(static_cast<std::time_t>(unix_s)));
}

/// Throws where there is nothing to be shown.
ecu::StoredFaults read_store(const std::string& folder) {
  std::error_code error;
  const auto what = std::filesystem::status(folder, error).type();
  if (what != std::filesystem::file_type::directory) {
    const bool is_absent = what == std::filesystem::file_type::not_found;
    throw std::runtime_error(fmt::format("--store: {}: {}", folder,
                                         is_absent ? "there is no such folder"
                                         : error   ? error.message()
                                                   : "is no folder"));
  }
  ecu::FolderFiles files(folder, ecu::FolderFiles::Missing::kIsAnError);
  if (!files.open()) {
    throw std::runtime_error(fmt::format("--store: {}", files.error()));
  }
  ecu::StoredFaults found = ecu::read_stored_faults(files);
  if (!found.damaged.empty()) {
    fmt::print(stderr, "graben faults: {}: damaged: {}\n", folder, fmt::join(found.damaged, ", "));
  }
  for (const std::string& file : found.unreadable) {
    fmt::print(stderr, "graben faults: {}\n", file);
  }
  if (!found.other_format.empty()) {
    fmt::print(stderr, "graben faults: {}: of a format that this version does not know: {}\n",
               folder, fmt::join(found.other_format, ", "));
  }
  if (!found.has_history) {
    throw std::runtime_error(fmt::format(
        "--store: {}: no stored faults in it{}", folder,
        found.damaged.empty() && found.other_format.empty() && found.unreadable.empty()
            ? ": neither faults.a nor faults.b is there; wanted: a folder that graben-ecu had as "
              "--store"
            : " that can be read"));
  }
  return found;
}

const ecu::StoredFrame* frame_of(const ecu::StoredFaults& found, Fault fault) {
  const auto at = std::find_if(found.frames.begin(), found.frames.end(),
                               [&](const ecu::StoredFrame& one) { return one.fault == fault; });
  return at == found.frames.end() ? nullptr : &*at;
}

std::vector<Fault> stored(const ecu::StoredFaults& found) {
  std::vector<Fault> faults;
  for (int number = 1; number < kFaultCount; ++number) {
    if (found.history.of(static_cast<Fault>(number)).occurrences > 0) {
      faults.push_back(static_cast<Fault>(number));
    }
  }
  return faults;
}

void print_table(const std::string& folder, const ecu::StoredFaults& found) {
  const ecu::FaultHistory& history = found.history;
  fmt::print("{}: profile {:08x}, power cycle {}, {:.2f} h of operation\n", folder,
             found.profile_hash, history.power_cycles, history.operation_s / kSecondsPerHour);
  if (history.lost > 0) {
    fmt::print(
        "{} events or freeze frames were lost: they came faster than they could be taken or "
        "written\n",
        history.lost);
  }
  const std::vector<Fault> faults = stored(found);
  if (faults.empty()) {
    fmt::print("no fault is stored\n");
    return;
  }
  constexpr const char* kRow = "{:>5}  {:>5}  {:>6}  {:<5}  {:<34}  {:<34}  {}\n";
  fmt::print(kRow, "fault", "times", "cycles", "frame", "first", "last", "what");
  for (const Fault fault : faults) {
    const ecu::FaultEntry& one = history.of(fault);
    fmt::print(kRow, static_cast<int>(fault), one.occurrences, history.cycles_since(fault),
               frame_of(found, fault) != nullptr ? "yes" : "no",
               time_text(one.first_s, one.first_unix_s), time_text(one.last_s, one.last_unix_s),
               runs::fault_words(fault));
  }
  fmt::print(
      "first, last: hours of operation; cycles: power cycles that began since it was last there\n");
}

/// Names of a sample's values, and each value as text; "" where it was not valid.
struct Column {
  std::string name;
  bool known = true;
  float value = 0.0F;
};

std::vector<Column> columns(const ecu::CycleSample& sample, ecu::SampleKind kind) {
  const ecu::SampleNames& names = ecu::sample_names(kind);
  std::vector<Column> all;
  const auto is_known = [&](std::size_t bit) { return (sample.known >> bit & 1U) != 0; };
  for (std::size_t i = 0; i < sample.stroke.size(); ++i) {
    if (names.stroke[i] != nullptr) {
      all.push_back({names.stroke[i], is_known(i), sample.stroke[i]});
    }
  }
  for (std::size_t i = 0; i < sample.pressure_pa.size(); ++i) {
    if (names.pressure[i] != nullptr) {
      all.push_back({names.pressure[i], is_known(sample.stroke.size() + i), sample.pressure_pa[i]});
    }
  }
  for (std::size_t i = 0; i < sample.duty_ratio.size(); ++i) {
    all.push_back({names.duty[i], true, sample.duty_ratio[i]});
  }
  all.push_back({"lambda", true, sample.lambda});
  return all;
}

void print_frame(const ecu::StoredFaults& found, int number) {
  const auto fault = static_cast<Fault>(number);
  const ecu::StoredFrame* frame = frame_of(found, fault);
  if (frame == nullptr) {
    std::string there;
    for (const ecu::StoredFrame& one : found.frames) {
      there += fmt::format("{}{}", there.empty() ? "" : ", ", static_cast<int>(one.fault));
    }
    throw std::runtime_error(
        fmt::format("--frame: fault {} has none; there {}", number,
                    there.empty() ? "is none at all" : "are those of " + there));
  }
  fmt::print("# fault {}: {}; {}\n", number, runs::fault_words(fault),
             time_text(frame->operation_s, frame->unix_s));
  for (std::size_t i = 0; i < frame->count; ++i) {
    const ecu::CycleSample& sample = frame->sample[i];
    const std::vector<Column> all = columns(sample, frame->kind);
    if (i == 0) {
      std::string head = "time_s,mode";
      for (const Column& one : all) {
        head += "," + one.name;
      }
      fmt::print("{}\n", head);
    }
    std::string line = fmt::format("{:.3f},{}", static_cast<double>(sample.now_us) / kSecondUs,
                                   runs::mode_words(sample.mode));
    for (const Column& one : all) {
      line += one.known ? fmt::format(",{}", one.value) : ",";
    }
    fmt::print("{}\n", line);
  }
}

ordered_json frame_json(const ecu::StoredFrame& frame) {
  ordered_json json;
  json["operation_s"] = frame.operation_s;
  json["unix_s"] = frame.unix_s == 0 ? ordered_json(nullptr) : ordered_json(frame.unix_s);
  json["samples"] = ordered_json::array();
  for (std::size_t i = 0; i < frame.count; ++i) {
    const ecu::CycleSample& sample = frame.sample[i];
    ordered_json one;
    one["time_s"] = static_cast<double>(sample.now_us) / kSecondUs;
    one["mode"] = runs::mode_words(sample.mode);
    for (const Column& column : columns(sample, frame.kind)) {
      one[column.name] = column.known ? ordered_json(column.value) : ordered_json(nullptr);
    }
    json["samples"].push_back(one);
  }
  return json;
}

void print_json(const ecu::StoredFaults& found) {
  const auto wall = [](std::uint32_t unix_s) {
    return unix_s == 0 ? ordered_json(nullptr) : ordered_json(unix_s);
  };
  ordered_json json;
  json["profile"] = fmt::format("{:08x}", found.profile_hash);
  json["power_cycle"] = found.history.power_cycles;
  json["operation_s"] = found.history.operation_s;
  json["lost"] = found.history.lost;
  json["damaged"] = found.damaged;
  json["unreadable"] = found.unreadable;
  json["other_format"] = found.other_format;
  json["faults"] = ordered_json::array();
  for (const Fault fault : stored(found)) {
    const ecu::FaultEntry& entry = found.history.of(fault);
    ordered_json one;
    one["fault"] = static_cast<int>(fault);
    one["text"] = runs::fault_words(fault);
    one["occurrences"] = entry.occurrences;
    one["first_s"] = entry.first_s;
    one["last_s"] = entry.last_s;
    one["first_unix_s"] = wall(entry.first_unix_s);
    one["last_unix_s"] = wall(entry.last_unix_s);
    one["power_cycles_since"] = found.history.cycles_since(fault);
    const ecu::StoredFrame* frame = frame_of(found, fault);
    one["frame"] = frame == nullptr ? ordered_json(nullptr) : frame_json(*frame);
    json["faults"].push_back(one);
  }
  fmt::print("{}\n", json.dump(1));
}

}  // namespace

void add_faults(CLI::App& app, int& status) {
  auto options = std::make_shared<FaultsCommand>();
  CLI::App* command = add_command(app, "faults");
  CLI::Option* const store = command->add_option(
      "--store", options->store,
      "Folder that graben-ecu had as --store; as a service, /var/lib/graben-ecu. Nothing in it is "
      "changed");
  CLI::Option* const can =
      command
          ->add_option("--can", options->bus.interface,
                       "CAN interface, such as can0: asks the ECU there, as a workshop's tool of "
                       "SAE J1939 does, for the faults that are active and stored")
          ->excludes(store);
  command->add_option("--address", options->bus.address, "The ECU's, 0 .. 253")
      ->check(whole_number_between(0, 253))
      ->default_val(static_cast<int>(kOwnAddress))
      ->needs(can);
  CLI::Option* const json =
      command->add_flag("--json", options->json, "All of it as JSON, freeze frames too");
  command
      ->add_option("--frame", options->frame,
                   "The freeze frame of the fault of this number, as CSV")
      ->check(whole_number_between(1, kFaultCount - 1))
      ->needs(store)
      ->excludes(json);
  command
      ->add_option("--clear", options->bus.clear,
                   "Clears the stored records of faults that are not active any more, or that are. "
                   "Not while the machine is armed or active")
      ->check(one_of({"previous", "active"}))
      ->needs(can)
      ->excludes(json);
  add_examples(*command, {"faults --store /var/lib/graben-ecu",
                          "faults --store /var/lib/graben-ecu --frame 1",
                          "faults --store /var/lib/graben-ecu --json", "faults --can can0",
                          "faults --can can0 --clear previous"});
  command->callback([options, &status] {
    if (options->store.empty() && options->bus.interface.empty()) {
      throw CLI::RequiredError("--store or --can");
    }
    status = guarded("faults", [&] {
      if (!options->bus.interface.empty()) {
        options->bus.json = options->json;
        faults_on_bus(options->bus);
        return;
      }
      const ecu::StoredFaults found = read_store(options->store);
      if (options->json) {
        print_json(found);
      } else if (options->frame != 0) {
        print_frame(found, options->frame);
      } else {
        print_table(options->store, found);
      }
    });
  });
}

}  // namespace graben::cli
