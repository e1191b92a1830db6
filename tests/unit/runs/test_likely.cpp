// SPDX-License-Identifier: Apache-2.0
// Slips of a person who describes a machine: each is refused or warned of, with and without a
// simulation beside the profile; shipped profiles are not warned of.

#include <unistd.h>
#include <algorithm>
#include <cstring>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/machines/any_machine.hpp"
#include "app/machines/simulated/simulation_file.hpp"
#include "app/reports/check/machine_check.hpp"
#include "app/reports/check/stop_table.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace fs = std::filesystem;
using graben::machines::MachineKind;

namespace {

/// `old_text` of a shipped file gives way to `new_text`. They were written before any check was.
struct Slip {
  const char* machine;
  const char* part;  ///< "" of the profile, ".sim" of its simulation.
  const char* old_text;
  const char* new_text;
};

constexpr const char* kBig = "excavator_22t";
constexpr const char* kSmall = "excavator_12t";
constexpr const char* kDozer = "dozer_9t";
constexpr const char* kTilting = "dozer_9t_tilt";

const std::vector<Slip> kSlips = {
    {kBig, "", "length = 5.70", "length = 5700"},
    {kBig, "", "length = 5.70", "length = 2.85"},
    {kBig, "", "length = 2.90", "length = 9.51"},
    {kBig, "", "angle = [-0.960, 0.942]", "angle = [-55.0, 54.0]"},
    {kBig, "", "angle = [-2.618, -0.436]", "angle = [0.436, 2.618]"},
    {kBig, "", "{ count = 2, bore = 0.120, rod = 0.085", "{ count = 1, bore = 0.120, rod = 0.085"},
    {kBig, "", "{ count = 1, bore = 0.140", "{ count = 2, bore = 0.140"},
    {kBig, "", "{ count = 2, bore = 0.120, rod = 0.085", "{ count = 2, bore = 0.060, rod = 0.042"},
    {kBig, "", "{ count = 2, bore = 0.120, rod = 0.085", "{ count = 2, bore = 0.085, rod = 0.120"},
    {kBig, "", "bore = 0.140, rod = 0.100", "bore = 0.140, rod = 0.050"},
    {kBig, "", "closed_length = 1.760, stroke = 1.260", "closed_length = 1.760, stroke = 3.020"},
    {kBig, "", "base = [0.46, -0.63]", "base = [0.46, 0.63]"},
    {kBig, "", "eye = [-0.80, 0.28]", "eye = [0.80, 0.28]"},
    {kBig, "", "lug = [-0.06, 0.47]", "lug = [-0.06, -0.47]"},
    {kBig, "", "boom_foot = [0.10, 1.75]", "boom_foot = [100, 1750]"},
    {kBig, "", "boom_foot = [0.10, 1.75]", "boom_foot = [1.75, 0.10]"},
    {kBig, "", "width = 1.20 ", "width = 0.12 "},
    {kBig, "", "capacity = 1.1 ", "capacity = 0.11 "},
    {kBig, "", "capacity = 1.1 ", "capacity = 1100 "},
    {kBig, "", "floor_angle = 0.65", "floor_angle = 37.2"},
    {kBig, "", "radius = 2.83, width = 2.70", "radius = 28.3, width = 2.70"},
    {kSmall, "", "angle_CBX1 = 0.492322", "angle_CBX1 = 28.208"},
    {kSmall, "", "angle_ABX0 = 0.780407", "angle_ABX0 = 0.013621"},
    {kSmall, "", "AB = 0.560, BC = 1.922", "AB = 1.922, BC = 0.560"},
    {kBig, "", "bulk_modulus = 0.8e9", "bulk_modulus = 14e9"},
    {kBig, "", "bulk_modulus = 0.8e9", "bulk_modulus = 0.8"},
    {kBig, "", "dead_volume = [2.0e-3, 1.5e-3, 1.5e-3]", "dead_volume = [2.0, 1.5, 1.5]"},
    {kBig, "", "mass = [2130.0, 1010.0, 860.0]", "mass = [21300.0, 10100.0, 8600.0]"},
    {kBig, "", "mass = [2130.0, 1010.0, 860.0]", "mass = [860.0, 1010.0, 2130.0]"},
    {kBig, "", "inertia = [6850.0, 1290.0, 260.0]", "inertia = [68.5, 12.9, 2.6]"},
    {kBig, "", "mass_centre = { boom = [2.75, 0.35]", "mass_centre = { boom = [-2.75, 0.35]"},
    {kBig, "", "spool_time_constant = 0.020", "spool_time_constant = 0.2"},
    {kSmall, "", "mass = [992.0, 392.0, 386.0]", "mass = [2130.0, 1010.0, 860.0]"},
    {kBig, "", "spool_to_duty = [[0.0, 200.0], [1.0, 1000.0]]",
     "spool_to_duty = [[0.0, 0.2], [1.0, 1.0]]"},
    {kBig, "", "boom = [1.50e-4, 1.15e-4, 1.05e-4, 1.70e-4]",
     "boom = [150.0, 115.0, 105.0, 170.0]"},
    {kBig, "", "arm = [1.70e-4, 1.05e-4, 1.25e-4, 1.90e-4]",
     "arm = [1.70e-5, 1.05e-5, 1.25e-5, 1.90e-5]"},
    {kBig, "", "boom = { side = \"retract\"", "boom = { side = \"extend\""},
    {kBig, "", "arm = { side = \"extend\"", "arm = { side = \"retract\""},
    {kBig, "", "bypass = { open = 4.5e-6", "bypass = { open = 4.5e-5"},
    {kBig, "", "section_flow = 3.57e-3", "section_flow = 214.0"},
    {kBig, "", "opening_exponent = 1.6", "opening_exponent = 0.16"},
    {kBig, "", "density = 870.0", "density = 0.87"},
    {kBig, "", "dead_time = 0.0 ", "dead_time = 20.0 "},
    {kBig, "", "pump = { boom = 2, arm = 1, bucket = 2 }",
     "pump = { boom = 2, arm = 2, bucket = 2 }"},
    {kBig, "", "displacement = 119e-6        #", "displacement = 119.0        #"},
    {kSmall, "", "speed = 151.844", "speed = 1450"},
    {kBig, "",
     "relief = 35.0e6\nrated_pressure = 38.0e6      # lift mode of the Cat 320 "
     "sheet\nbypass_series = [4.5e-6, 4.0e-6]\n\n[valve]",
     "relief = 350.0\nrated_pressure = 38.0e6      # lift mode of the Cat 320 sheet\nbypass_series "
     "= [4.5e-6, 4.0e-6]\n\n[valve]"},
    {kSmall, "", "bypass_series = [5.8e-6, 5.1e-6]", "bypass_series = [5.8e-5, 5.1e-5]"},
    {kSmall, "", "speed_max = 1.435", "speed_max = 13.7"},
    {kSmall, "", "inertia = 40000.0", "inertia = 400.0"},
    {kBig, "", "pressure_range = 40e6", "pressure_range = 400.0"},
    {kBig, "", "pump_power = 250e3", "pump_power = 250.0"},
    {kBig, "", "speed = 0.6 ", "speed = 600.0 "},
    {kSmall, "", "relief = 35.0e6              # the valve's",
     "relief = 3.43e6              # the valve's"},
    {kSmall, "", "bend = [2.10, 0.55]", "bend = [2.10, -0.55]"},
    {kBig, "", "pump = { boom = 2, arm = 1, bucket = 2 }",
     "pump = { boom = 1, arm = 2, bucket = 2 }"},
    {kBig, "", "pump = { boom = 2, arm = 1, bucket = 2 }",
     "pump = { boom = 2, arm = 1, bucket = 1 }"},
    {kBig, "", "pump = { boom = 2, arm = 1, bucket = 2 }",
     "pump = { boom = 1, arm = 1, bucket = 2 }"},
    {"excavator_12t_ls", "", "margin = 2.0e6", "margin = 6.0e6"},
    {kDozer, ".sim", "relief = 21.0e6", "relief = 2.1e6"},
    {kDozer, ".sim", "relief = 42.0e6", "relief = 4.2e6"},
    {kDozer, "", "mass = 8900.0", "mass = 8.9"},
    {kDozer, "", "mass = 8900.0", "mass = 20000.0"},
    {kDozer, "", "half_gauge = 0.90", "half_gauge = 1.80"},
    {kDozer, "", "engine_speed = 157.08", "engine_speed = 1500"},
    {kDozer, "", "sprocket_radius = 0.35", "sprocket_radius = 0.70"},
    {kDozer, "", "cylinder = { count = 2, bore = 0.110", "cylinder = { count = 1, bore = 0.110"},
    {kDozer, "", "push_max = 60.0e3", "push_max = 60.0"},
    {kDozer, "", "stiffness = 6.0e5", "stiffness = 6.0e2"},
    {kDozer, "", "pump_displacement = 90e-6", "pump_displacement = 9e-6"},
    {kDozer, "", "efficiency = [0.95, 0.95]", "efficiency = [95.0, 95.0]"},
    {kDozer, "", "range = [-0.38, 0.80]", "range = [-0.80, 0.38]"},
    {kTilting, "", "range = 0.16 ", "range = 9.2 "},
};

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const fs::path& folder() {
  static const fs::path path =
      fs::temp_directory_path() / ("graben_likely_test." + std::to_string(getpid()));
  fs::create_directories(path);
  return path;
}
const fs::path& shipped() {
  static const fs::path path = graben::machines::find_profile("excavator_22t").parent_path();
  return path;
}

/// Keys that are warned of; of a profile that is refused, its errors.
std::vector<std::string> said_of(const fs::path& file, bool simulated) {
  std::vector<std::string> keys;
  try {
    const bool is_dozer =
        graben::machines::profile_kind(file) == graben::machines::MachineKind::kDozer;
    std::vector<graben::reports::Warning> warnings;
    if (is_dozer && simulated) {
      const auto machine = graben::machines::load_simulated_dozer(file);
      warnings = graben::reports::dozer_warnings(machine, &machine);
    } else if (is_dozer) {
      warnings = graben::reports::dozer_warnings(graben::machines::load_dozer(file), nullptr);
    } else if (simulated) {
      const auto machine = graben::machines::load_simulated_excavator(file);
      warnings = graben::reports::excavator_warnings(machine, &machine);
    } else {
      warnings =
          graben::reports::excavator_warnings(graben::machines::load_excavator(file), nullptr);
    }
    for (const graben::reports::Warning& warning : warnings) {
      keys.push_back(warning.key + ": " + warning.text);
    }
  } catch (const std::runtime_error& error) {
    keys.emplace_back(error.what());
  }
  return keys;
}

void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string replaced(std::string text, const Slip& slip) {
  const std::size_t at = text.find(slip.old_text);
  if (at == std::string::npos) {
    fail_msg("%s has no '%s'", slip.machine, slip.old_text);
  }
  return text.replace(at, std::string(slip.old_text).size(), slip.new_text);
}

}  // namespace

TEST(every_slip_is_said) {
  int silent = 0;
  for (const char* part : {"", ".sim"}) {
    put(folder() / (std::string(kDozer) + part + ".toml"),
        content(shipped() / (std::string(kDozer) + part + ".toml")));
  }
  for (const Slip& slip : kSlips) {
    for (const char* part : {"", ".sim"}) {
      const std::string text = content(shipped() / (std::string(slip.machine) + part + ".toml"));
      put(folder() / (std::string("mine") + part + ".toml"),
          std::string(slip.part) == part ? replaced(text, slip) : text);
    }
    for (const bool simulated : {true, false}) {
      if (!simulated && slip.part[0] != '\0') {
        continue;
      }
      if (said_of(folder() / "mine.toml", simulated).empty()) {
        print_error("%s, %s simulation: nothing is said of '%s'\n", slip.machine,
                    simulated ? "with its" : "without a", slip.new_text);
        ++silent;
      }
    }
  }
  fs::remove_all(folder());
  assert_int_equal(silent, 0);
  assert_true(kSlips.size() >= 60);
}

TEST(shipped_machines_are_likely) {
  int machines = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(shipped())) {
    const fs::path file = entry.path();
    if (file.extension() != ".toml" || file.stem().extension() == ".sim") {
      continue;
    }
    ++machines;
    for (const bool simulated : {true, false}) {
      for (const std::string& text : said_of(file, simulated)) {
        fail_msg("%s: %s", file.filename().c_str(), text.c_str());
      }
    }
  }
  assert_true(machines >= 8);
}

/// A simulation that is of another machine ends in whatever its geometry makes of it.
TEST(a_simulation_of_another_machine_is_said) {
  const Slip longer = {kSmall, "", "length = 1.23 ", "length = 1.30 "};
  put(folder() / "other.toml", replaced(content(shipped() / "excavator_12t.toml"), longer));
  put(folder() / "other.sim.toml", "kind = \"excavator\"\nmachine = \"excavator_12t\"\n");
  const std::vector<std::string> said = said_of(folder() / "other.toml", true);
  fs::remove_all(folder());
  assert_int_equal(said.size(), 1);
  assert_non_null(strstr(said.front().c_str(), "bucket.length: 1.3 m, where the machine that is"));
}

/// The longest way decides, at whichever speed it is, each load by itself.
TEST(a_limit_that_comes_too_late_is_warned_of) {
  const std::vector<runs::Stopping> stops = {{"swing", 1.0, 0.0, 4.0, 1.0, 1.4},
                                             {"swing", 0.6, 0.0, 4.6, 1.0, 2.0},
                                             {"swing", 0.3, 0.0, 2.0, 1.0, 0.5},
                                             {"swing", 1.0, 800.0, 4.3, 1.0, 2.5},
                                             {"swing", 0.3, 800.0, 2.4, 1.0, 0.9}};
  assert_int_equal(reports::stop_warnings(stops, 2.6).size(), 0);
  assert_int_equal(reports::stop_warnings(stops, 2.1).size(), 1);
  const std::vector<reports::Warning> late = reports::stop_warnings(stops, 1.5);
  assert_int_equal(late.size(), 2);
  assert_non_null(std::strstr(late[0].text.c_str(), "swing at 60 % of its speed, empty"));
  assert_non_null(std::strstr(late[0].text.c_str(), "unless it was slowed to 30 % before"));
  assert_non_null(std::strstr(reports::stop_warnings(stops, 0.8)[1].text.c_str(), "however slow"));
}

/// Stopped where it is fastest: a swing's second of acceleration is not its speed.
TEST(a_swing_is_stopped_where_it_is_fastest) {
  const auto machine = machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  double most_mps = 0.0;
  double most_m = 0.0;
  for (const runs::Stopping& stop : runs::stopping(machine)) {
    most_mps = std::max(most_mps, stop.motion == "swing" ? stop.speed_mps : 0.0);
    most_m = std::max(most_m, stop.distance_m);
  }
  assert_true(most_mps > 4.0);
  assert_true(most_m > 2.0);
}
