// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "app/machines/bus_file.hpp"
#include "app/machines/profile_file.hpp"
#include "app/machines/task_file.hpp"
#include "app/reports/page_setup.hpp"
#include "app/runs/code_text.hpp"

namespace graben::reports {
namespace {

namespace fs = std::filesystem;
using machines::ExcavatorMachine;
using machines::TaskFile;
using nlohmann::json;

/// Bus profiles that machines may be put on, which the page then knows by both hashes.
json buses_json(const std::optional<std::string>& told) {
  json buses = json::array();
  const auto add = [&buses](const std::string& name) {
    const machines::BusFile bus = machines::load_bus(machines::find_bus(name));
    json one = bus_json(bus.table);
    one["name"] = fs::path(name).stem().string();
    one["hash"] = bus.hash;
    buses.push_back(std::move(one));
  };
  if (told) {
    add(*told);
  }
  for (const std::string& name : machines::shipped_bus_names()) {
    add(name);
  }
  return buses;
}

/// Of what is shipped; none where the tool was taken away from its source tree.
template <class Find>
std::vector<fs::path> files_beside(const Find& find, const char* one_of_them) {
  fs::path folder;
  try {
    folder = fs::path(find(one_of_them)).parent_path();
  } catch (const std::runtime_error&) {
    return {};
  }
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml" && !machines::is_simulation_file(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The one that is told, then the shipped ones, each once.
std::vector<fs::path> profiles(const SetupOptions& options) {
  std::vector<fs::path> files;
  if (options.profile && !options.designed) {
    files.push_back(machines::find_profile(*options.profile));
  }
  const auto find = [](const char* name) { return machines::find_profile(name); };
  for (const fs::path& file : files_beside(find, "excavator_22t")) {
    if (files.empty() || !fs::equivalent(files.front(), file)) {
      files.push_back(file);
    }
  }
  if (files.empty()) {
    throw std::runtime_error("no shipped profiles are here: say --profile");
  }
  return files;
}

/// Those of the shipped tasks that this machine can do.
std::vector<TaskFile> shipped_tasks(const ExcavatorMachine& machine) {
  std::vector<TaskFile> tasks;
  const auto find = [](const char* name) { return machines::find_task(name); };
  for (const fs::path& file : files_beside(find, "flatten")) {
    try {
      tasks.push_back(machines::load_task(file, machine.profile));
    } catch (const machines::ProfileError&) {
      // Is for another machine.
      continue;
    }
  }
  return tasks;
}

/// Tasks that are told, on one machine after the other.
class ToldTasks {
 public:
  explicit ToldTasks(const std::vector<std::string>& names) {
    if (names.size() > kTaskMost) {
      throw std::runtime_error(
          fmt::format("{} tasks; at most {} are allowed", names.size(), kTaskMost));
    }
    for (const std::string& name : names) {
      files_.push_back(machines::find_task(name));
    }
  }

  /// All, or none if one of them does not fit.
  std::vector<TaskFile> on(const ExcavatorMachine& machine) {
    std::vector<TaskFile> tasks;
    try {
      for (const fs::path& file : files_) {
        tasks.push_back(machines::load_task(file, machine.profile));
      }
      has_fitted_ = true;
    } catch (const machines::ProfileError& error) {
      errors_ += fmt::format("\non {}: {}", machine.name, error.what());
      tasks.clear();
    }
    return tasks;
  }

  void throw_unless_fitted() const {
    if (!files_.empty() && !has_fitted_) {
      throw std::runtime_error("--task: fits no machine" + errors_);
    }
  }

 private:
  std::vector<fs::path> files_;
  bool has_fitted_ = false;
  std::string errors_;
};

/// With the tasks that are told, else with those of the shipped ones that it can do.
template <class Machine>
json excavator_json(const Machine& machine, const SetupOptions& options, ToldTasks& told) {
  // Without a swing it can still follow a design (Assist), but none of the shipped programs.
  if (options.tasks.empty()) {
    return machine_json(
        machine, machine.profile.has_swing() ? shipped_tasks(machine) : std::vector<TaskFile>());
  }
  return machine_json(machine, told.on(machine));
}

}  // namespace

json text_json() {
  json text;
  for (int i = 0; i < kFaultCount; ++i) {
    text["fault"][std::to_string(i)] = runs::fault_words(static_cast<Fault>(i));
  }
  text["why_not_armed"] = json::array();
  for (int i = 0; i < kArmBlockCount; ++i) {
    text["why_not_armed"].push_back(runs::arm_block_words(static_cast<ArmBlock>(i)));
  }
  return text;
}

json shared_setup(const SetupOptions& options) {
  ToldTasks told(options.tasks);
  json machines_json = json::array();
  if (options.designed) {
    machines_json.push_back(machine_json(*options.designed));
  }
  for (const fs::path& file : profiles(options)) {
    const bool is_simulated = fs::is_regular_file(machines::simulation_file(file));
    if (machines::profile_kind(file) == machines::MachineKind::kDozer) {
      machines_json.push_back(is_simulated ? machine_json(machines::load_simulated_dozer(file))
                                           : machine_json(machines::load_dozer(file)));
    } else {
      machines_json.push_back(
          is_simulated ? excavator_json(machines::load_simulated_excavator(file), options, told)
                       : excavator_json(machines::load_excavator(file), options, told));
    }
    if (options.profile && !options.designed && machines_json.size() == 1) {
      told.throw_unless_fitted();
    }
  }
  told.throw_unless_fitted();
  return {{"machines", machines_json},
          {"buses", buses_json(options.bus)},
          {"words", text_json()},
          {"version", GRABEN_VERSION}};
}

}  // namespace graben::reports
