// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/drive_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/machines/axis_names.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/toml_reader.hpp"

namespace graben::machines {
namespace {

/// An optional key of `count` numbers; nothing where it is not there.
std::vector<double> told(TomlReader& reader, const std::string& key, const Range& range,
                         std::size_t count, const char* help) {
  return reader.has(key) ? reader.numbers(key, range, count, help) : std::vector<double>();
}

void read_edges(TomlReader& reader, const std::string& drive, plant::SpoolDynamics& spool) {
  const Range share{0.0, 0.9, ""};
  const auto edge =
      told(reader, "valve.edge." + drive, share, 2,
           "edge of its deadband, of its travel: extending, retracting; valve.deadband "
           "without");
  const auto softness =
      told(reader, "valve.softness." + drive, share, 2,
           "travel over which its opening begins, half before the edge and half behind: extending, "
           "retracting; a sharp edge without");
  const auto exponent =
      told(reader, "valve.exponent." + drive, {0.5, 4.0, ""}, 2,
           "exponent of its opening: extending, retracting; the profile's without");
  plant::SpoolSide* const sides[] = {&spool.extend, &spool.retract};
  for (std::size_t i = 0; i < 2; ++i) {
    plant::SpoolSide& side = *sides[i];
    side.deadband_ratio = edge.empty() ? side.deadband_ratio : edge[i];
    side.softness_ratio = softness.empty() ? side.softness_ratio : softness[i];
    side.opening_exponent = exponent.empty() ? side.opening_exponent : exponent[i];
    const double most = 2.0 * std::min(side.deadband_ratio, 1.0 - side.deadband_ratio);
    if (reader.is_sound() && side.softness_ratio > most) {
      reader.fail("valve.softness." + drive,
                  fmt::format("{} about an edge of {}; allowed: 0 .. {:g}", side.softness_ratio,
                              side.deadband_ratio, most));
    }
  }
  if (!edge.empty() || !softness.empty()) {
    plant::fit_bypass(spool);
  }
}

/// Returns whether the dead time was told.
bool read_lags(TomlReader& reader, const std::string& drive, std::size_t index,
               plant::ExcavatorPlantProfile& plant) {
  const auto delay = told(reader, "valve.delay." + drive, {0.0, 0.5, "s"}, 2,
                          "dead time from a duty to its spool's first movement: extending, "
                          "retracting; what the controller takes it for without");
  if (!delay.empty()) {
    plant.dead_time[index] = {delay[0], delay[1]};
  }
  double& spool_s = plant.spool[index].time_constant_s;
  if (const std::string key = "valve.spool_lag." + drive; reader.has(key)) {
    spool_s = reader.number(key, {0.001, 1.0, "s"}, "as valve.time_constant, of this spool");
  }
  plant.pilot_lag_s[index] =
      reader.number_or(0.0, "valve.pilot_lag." + drive, {0.0, 1.0, "s"},
                       "first-order lag of the pilot pressure that sends this spool");
  return !delay.empty();
}

void read_factors(TomlReader& reader, const std::string& drive, std::size_t index,
                  plant::ExcavatorPlantProfile& plant) {
  const auto area = told(reader, "valve.area_factor." + drive, {0.1, 10.0, ""}, 4,
                         "on the machine's areas: extend in, extend out, retract in, retract out; "
                         "1 without");
  if (!area.empty()) {
    plant.area_factors[index] = {area[0], area[1], area[2], area[3]};
  }
  const auto zero =
      told(reader, "sensors.pressure_zero." + drive, {-5e6, 5e6, "Pa"}, 2,
           "what its pressures show at none: cap, rod (swing: left, right); 0 without");
  if (!zero.empty()) {
    plant.sensors.cap_zero_pa[index] = zero[0];
    plant.sensors.rod_zero_pa[index] = zero[1];
  }
}

void read_zeros_and_pumps(TomlReader& reader, plant::ExcavatorPlantProfile& plant) {
  const auto zero = told(reader, "sensors.stroke_zero", {-0.05, 0.05, "m"}, kAxisCount,
                         "what each stroke shows at none: boom, arm, bucket; 0 without");
  for (std::size_t i = 0; i < zero.size(); ++i) {
    plant.sensors.stroke_zero_m[i] = zero[i];
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(plant.machine.pump_count); ++i) {
    plant.pump_flow_ratio[i] =
        reader.number_or(1.0, fmt::format("flow_factor.pump{}", i + 1), {0.1, 2.0, ""},
                         "of this pump, on the machine's displacement");
  }
}

}  // namespace

void read_each_drive(TomlReader& reader, SimulatedExcavator& machine) {
  plant::ExcavatorPlantProfile& plant = machine.plant;
  for (std::size_t i = 0; i < plant.drive_count(); ++i) {
    const std::string drive = kDriveNames[i];
    read_edges(reader, drive, plant.spool[i]);
    machine.has_dead_time = read_lags(reader, drive, i, plant) || machine.has_dead_time;
    read_factors(reader, drive, i, plant);
  }
  read_zeros_and_pumps(reader, plant);
}

}  // namespace graben::machines
