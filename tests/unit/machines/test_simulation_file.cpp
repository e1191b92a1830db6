// SPDX-License-Identifier: Apache-2.0
// Simulated machines by themselves: what a file differs in from the machine that it names, what is
// wrong with it, and a controller with another profile in it.

#include "app/machines/simulated/simulation_file.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>

#include "app/machines/simulated/hidden.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using machines::SimulatedChoice;
using machines::SimulatedExcavator;
namespace fs = std::filesystem;

/// A folder that ends with its test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("graben_simulations." + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  assert_true(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

fs::path shipped(const char* name) { return machines::find_profile(name); }

const SimulatedExcavator& nominal() {
  static const SimulatedExcavator machine =
      machines::load_simulated_excavator(shipped("excavator_22t"));
  return machine;
}

void says(const std::string& error, std::initializer_list<const char*> needles) {
  for (const char* needle : needles) {
    if (error.find(needle) == std::string::npos) {
      fail_msg("'%s' is not in: %s", needle, error.c_str());
    }
  }
}

/// Each key goes where it belongs; what is not told is the named machine's.
TEST(a_file_says_what_differs) {
  const Folder folder;
  const SimulatedExcavator machine = machines::load_simulation(folder.write("mine.sim.toml", R"(
machine = "excavator_22t"
boom.mass = 3000.0
experiment.soil = { bias = [1.0, 2.0] }
[valve]
edge = { arm = [0.45, 0.55] }
softness = { arm = [0.1, 0.2] }
exponent = { bucket = [1.3, 1.9] }
delay = { bucket = [0.1, 0.2] }
spool_lag = { boom = 0.03 }
pilot_lag = { boom = 0.05 }
area_factor = { boom = [0.7, 0.8, 1.1, 1.2] }
[flow_factor]
pump2 = 0.9
[sensors]
stroke_zero = [0.01, -0.01, 0.005]
pressure_zero = { arm = [1.0e6, -1.0e6] }
)"));
  const plant::ExcavatorPlantProfile& plant = machine.plant;
  const plant::ExcavatorPlantProfile& exact = nominal().plant;
  assert_string_equal(machine.name.c_str(), "excavator_22t");
  assert_int_equal(machine.hash, nominal().hash);
  assert_near(plant.link[kBoom].mass_kg, 3000.0, 0.0);
  assert_near(plant.link[kBoom].inertia_kgm2, exact.link[kBoom].inertia_kgm2, 0.0);
  assert_near(machine.experiment.soil.bias_n.y(), 2.0, 0.0);
  assert_near(machine.experiment.soil.ramp_m, nominal().experiment.soil.ramp_m, 0.0);
  assert_near(plant.spool[kArm].extend.deadband_ratio, 0.45, 0.0);
  assert_near(plant.spool[kArm].retract.deadband_ratio, 0.55, 0.0);
  assert_near(plant.spool[kArm].retract.softness_ratio, 0.2, 0.0);
  assert_near(plant.spool[kBoom].extend.deadband_ratio, 0.2, 0.0);
  assert_near(plant.spool[kBucket].extend.opening_exponent, 1.3, 0.0);
  assert_near(plant.spool[kBucket].retract.opening_exponent, 1.9, 0.0);
  assert_near(plant.spool[kBoom].retract.opening_exponent, 1.6, 0.0);
  assert_near(plant.dead_time[kBucket].extend_s, 0.1, 0.0);
  assert_near(plant.dead_time[kBucket].retract_s, 0.2, 0.0);
  assert_true(machine.has_dead_time && !nominal().has_dead_time);
  assert_near(plant.spool[kBoom].time_constant_s, 0.03, 0.0);
  assert_near(plant.spool[kArm].time_constant_s, 0.02, 0.0);
  assert_near(plant.pilot_lag_s[kBoom], 0.05, 0.0);
  assert_near(plant.pilot_lag_s[kArm], 0.0, 0.0);
  assert_near(plant.area_factors[kBoom].retract_out, 1.2, 0.0);
  assert_near(plant.area_factors[kArm].retract_out, 1.0, 0.0);
  assert_near(plant.pump_flow_ratio[0], 1.0, 0.0);
  assert_near(plant.pump_flow_ratio[1], 0.9, 0.0);
  assert_near(plant.sensors.stroke_zero_m[kArm], -0.01, 0.0);
  assert_near(plant.sensors.cap_zero_pa[kArm], 1e6, 0.0);
  assert_near(plant.sensors.rod_zero_pa[kArm], -1e6, 0.0);
}

/// A file beside goes before a shipped one of that name.
TEST(a_machine_may_lie_beside) {
  const Folder folder;
  static_cast<void>(folder.write("big.toml", text_of(shipped("excavator_22t"))));
  static_cast<void>(folder.write(
      "big.sim.toml", replaced(text_of(machines::simulation_file(shipped("excavator_22t"))),
                               "mass = 1010.0", "mass = 1111.0")));
  const SimulatedExcavator machine = machines::load_simulation(
      folder.write("worn.sim.toml", "machine = \"big\"\nboom.mass = 3000.0"));
  assert_near(machine.plant.link[kArm].mass_kg, 1111.0, 0.0);
  assert_near(machine.plant.link[kBoom].mass_kg, 3000.0, 0.0);
}

/// The file, the key and its line; the named machine's own errors are its own file's.
TEST(what_is_wrong_is_told_where_it_is) {
  const Folder folder;
  const auto error = [&folder](const std::string& text) {
    return test::refusal_of(
        [&] { return machines::load_simulation(folder.write("mine.sim.toml", text)); });
  };
  const std::string named = "machine = \"excavator_22t\"\n";
  says(error(named + "[valve]\nedge = { boom = [0.5, 0.95] }\nedges = 1"),
       {"mine.sim.toml: 2 errors", "valve.edge.boom[1] (line 3): ", "allowed: 0 .. 0.9",
        "valve.edges (line 4): unknown key"});
  says(error(named + "[valve]\nsoftness = { arm = [0.1, 0.5] }"),
       {"1 error", "valve.softness.arm (line 3): 0.5 about an edge of 0.2; allowed: 0 .. 0.4"});
  says(error(named + "[valve]\nedge.bucket = [0.01, 0.5]"),
       {"1 error", "uncertainty.dead_band", "0.03", "0.01"});
  says(error(named + "valve.delay.swing = [0.1, 0.1]"), {"valve.delay.swing", "unknown key"});
  says(error(named + "kind = \"dozer\""), {"a machine of kind dozer; here it must be excavator"});
  says(error("machine = 5"), {"mine.toml"});
  says(error("machine = \"none_such\""), {"profile 'none_such': there is no such file"});
  static_cast<void>(folder.write("chain.toml", text_of(shipped("excavator_22t"))));
  static_cast<void>(folder.write("chain.sim.toml", named));
  says(error("machine = \"chain\""), {"mine.sim.toml", "machine: ", "chain.sim.toml names"});
  static_cast<void>(folder.write(
      "sick.sim.toml", replaced(text_of(machines::simulation_file(shipped("excavator_22t"))),
                                "mass = 1010.0", "mass = -1.0")));
  static_cast<void>(folder.write("sick.toml", text_of(shipped("excavator_22t"))));
  says(error("machine = \"sick\""), {"sick.sim.toml: 1 error", "arm.mass"});
}

/// An identified profile: the controller's figures are its own, the plant's those of the machine.
TEST(a_profile_does_not_change_the_machine_that_it_is_put_in) {
  const Folder folder;
  const fs::path profile = folder.write(
      "better.toml",
      replaced(text_of(shipped("excavator_22t")), "boom = [1.50e-4,", "boom = [1.20e-4,"));
  SimulatedChoice choice;
  choice.name = "excavator_22t";
  const SimulatedExcavator machine = machines::load_simulated_excavator(profile, choice);
  assert_string_equal(machine.name.c_str(), "better");
  assert_string_equal(machine.simulated.c_str(), "excavator_22t");
  assert_true(machine.hash != nominal().hash);
  assert_int_equal(machine.hash, machines::load_excavator(profile).hash);
  assert_near(machine.profile.valve.spool[kBoom].extend_in_m2, 1.20e-4, 0.0);
  assert_near(machine.plant.machine.valve.spool[kBoom].extend_in_m2, 1.50e-4, 0.0);
  // The same by a file beside the profile that names the machine.
  static_cast<void>(folder.write("better.sim.toml", "machine = \"excavator_22t\""));
  const SimulatedExcavator beside = machines::load_simulated_excavator(profile, SimulatedChoice());
  assert_true(beside.simulated.empty() && beside.hash == machine.hash);
  assert_near(beside.profile.valve.spool[kBoom].extend_in_m2, 1.20e-4, 0.0);
  assert_near(beside.plant.machine.valve.spool[kBoom].extend_in_m2, 1.50e-4, 0.0);
}

TEST(a_hidden_machine_is_put_in_by_its_seed) {
  SimulatedChoice choice;
  assert_true(choice.is_own());
  choice.hidden = 7;
  assert_false(choice.is_own());
  const SimulatedExcavator machine =
      machines::load_simulated_excavator(shipped("excavator_22t"), choice);
  assert_string_equal(machine.simulated.c_str(), "hidden 7");
  assert_near(machine.plant.bulk_modulus_pa,
              machines::hidden_machine(nominal(), 7).plant.bulk_modulus_pa, 0.0);
  choice.name = "excavator_22t_found";
  assert_string_equal(
      machines::load_simulated_excavator(shipped("excavator_22t"), choice).simulated.c_str(),
      "excavator_22t_found hidden 7");
}

TEST(a_machine_with_other_drives_is_refused) {
  SimulatedChoice choice;
  choice.name = "excavator_22t_found";
  says(test::refusal_of(
           [&] { return machines::load_simulated_excavator(shipped("excavator_12t"), choice); }),
       {"excavator_12t.toml: 4 drives", "has 3"});
  choice.name = "none_such";
  says(test::refusal_of(
           [&] { return machines::load_simulated_excavator(shipped("excavator_22t"), choice); }),
       {"simulated machine 'none_such': there is no such file",
        "wanted: a file or one of dozer_9t"});
}

/// By path, by shipped name, by the profile beside it.
TEST(a_simulation_is_found) {
  const fs::path file = machines::find_simulation("excavator_22t_found");
  assert_true(machines::is_simulation_file(file));
  assert_true(machines::find_simulation(file.string()) == file);
  assert_true(machines::find_simulation(shipped("excavator_22t").string()) ==
              machines::simulation_file(shipped("excavator_22t")));
}

/// What the file of the found machine promises in its comment.
TEST(the_found_machine_is_as_measured) {
  const SimulatedExcavator found =
      machines::load_simulation(machines::find_simulation("excavator_22t_found"));
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const plant::SpoolDynamics& spool = found.plant.spool[i];
    for (const plant::SpoolSide& side : {spool.extend, spool.retract}) {
      assert_true(side.deadband_ratio >= 0.40 && side.deadband_ratio <= 0.55);
      assert_true(side.softness_ratio >= 0.1);
    }
    const plant::SideDelay& delay = found.plant.dead_time[i];
    assert_true(delay.extend_s >= 0.17 && delay.extend_s <= 0.22);
    assert_true(delay.retract_s >= 0.17 && delay.retract_s <= 0.22);
    const double lag_s = 2.0 * spool.damping * spool.time_constant_s + found.plant.pilot_lag_s[i];
    assert_true(lag_s > 0.07 - 1e-12 && lag_s < 0.35);
  }
  assert_near(found.plant.link[kArm].mass_kg, nominal().plant.link[kArm].mass_kg, 0.0);
}
