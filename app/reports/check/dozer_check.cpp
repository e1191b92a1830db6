// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/blade_answers.hpp"
#include "app/reports/check/likely.hpp"
#include "app/reports/check/warnings.hpp"
#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/tilt.hpp"
#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::reports {
namespace {

/// Speed of the cutting edge over that of the cylinders where the edge is at the ground line.
double edge_per_stroke(const BladeGeometry& geometry) {
  const BladeKinematics blade(geometry);
  return std::abs(blade.edge_rate_mprad(0.0).y() / blade.stroke_rate_mprad(0.0));
}

double pump_flow_m3ps(const DozerProfile& profile) {
  return profile.hst.engine_radps / kTwoPi * profile.implement.displacement_m3prev *
         profile.implement.efficiency;
}

FactTable blade_table(const DozerProfile& profile) {
  const BladeKinematics blade(profile.blade);
  const auto angle = [](double rad) { return fmt::format("{:.1f}", kDegreesPerRad * rad); };
  return {"Blade",
          {"", "fully lowered", "fully raised", ""},
          {{"cutting edge", fmt::format("{:.2f}", profile.blade.edge_min_m),
            fmt::format("{:.2f}", profile.blade.edge_max_m), "m, against the ground line"},
           {"frame", angle(blade.angle_min_rad()), angle(blade.angle_max_rad()), "deg, from home"},
           {"stroke", fmt::format("{:.3f}", blade.stroke_max_m()), "0.000",
            "m; extension lowers the blade"}},
          ""};
}

/// Of a blade that tilts: its left end down and up against the machine.
FactTable tilt_table(const TiltProfile& tilt) {
  const TiltKinematics linkage(tilt);
  const double most_rad = tilt.angle_most_rad;
  const double end_m = tilt.half_width_m() * std::sin(most_rad);
  const auto stroke = [&](double rad) { return fmt::format("{:.3f}", linkage.stroke_m(rad)); };
  return {"Tilt of the blade",
          {"", "left end down", "left end up", ""},
          {{"blade", fmt::format("{:.1f}", -kDegreesPerRad * most_rad),
            fmt::format("{:.1f}", kDegreesPerRad * most_rad), "deg, against the machine"},
           {"left end of the edge", fmt::format("{:.2f}", -end_m), fmt::format("{:.2f}", end_m),
            "m, against its middle"},
           {"stroke", stroke(-most_rad), stroke(most_rad),
            fmt::format("m; extension {} the left end",
                        linkage.stroke_rate_mprad(0.0) > 0.0 ? "lifts" : "lowers")}},
          ""};
}

/// A drive of the blade alone on the pump.
struct BladeDrive {
  const char* title;
  const char* cylinders;
  const char* cylinders_own;
  const char* edge;        ///< What of the cutting edge it moves.
  double edge_per_stroke;  ///< Speed of that over the cylinders'.
  double flow_m3ps;
};
struct DriveWay {
  const char* name;
  double area_m2;  ///< That is fed.
};

FactTable drive_table(const BladeDrive& drive, const std::array<DriveWay, 2>& ways,
                      double engine_radps, const machines::SimulatedDozer* simulated) {
  FactTable table{drive.title,
                  {"", fmt::format("{}, m/s", drive.cylinders), fmt::format("{}, m/s", drive.edge),
                   fmt::format("{} force, kN", drive.cylinders_own)},
                  {},
                  fmt::format("{:.1f} L/min with the engine at {:g} rad/s", 6e4 * drive.flow_m3ps,
                              engine_radps)};
  for (const DriveWay& way : ways) {
    const double stroke_mps = drive.flow_m3ps / way.area_m2;
    table.rows.push_back(
        {way.name, fmt::format("{:.3f}", stroke_mps),
         fmt::format("{:.3f}", drive.edge_per_stroke * stroke_mps),
         simulated == nullptr
             ? "-"
             : fmt::format("{:.0f}", 1e-3 * simulated->plant.implement_relief_pa * way.area_m2)});
  }
  if (simulated == nullptr) {
    table.note += "; forces need the relief: there is no NAME.sim.toml beside the profile";
  }
  return table;
}

FactTable lift_drive_table(const DozerProfile& profile, const machines::SimulatedDozer* simulated) {
  return drive_table(
      {"Blade cylinders at full flow and at relief", "cylinders", "cylinders'",
       "cutting edge at home", edge_per_stroke(profile.blade),
       available_flow_m3ps(profile.implement, profile.hst.engine_radps)},
      {{{"lowers", profile.blade.cap_area_m2()}, {"raises", profile.blade.rod_area_m2()}}},
      profile.hst.engine_radps, simulated);
}

/// What its spool lets through of what the pump gives.
double tilt_flow_m3ps(const DozerProfile& profile) {
  return std::min(profile.tilt.valve_flow_max_m3ps, pump_flow_m3ps(profile));
}

FactTable tilt_drive_table(const DozerProfile& profile, const machines::SimulatedDozer* simulated) {
  const TiltProfile& tilt = profile.tilt;
  const double rate_mprad = TiltKinematics(tilt).stroke_rate_mprad(0.0);
  const bool extension_lifts = rate_mprad > 0.0;
  return drive_table(
      {"Tilt cylinder at full flow and at relief, lift at rest", "cylinder", "cylinder's",
       "end of the edge, level", tilt.half_width_m() / std::abs(rate_mprad),
       tilt_flow_m3ps(profile)},
      {{{"left end up", extension_lifts ? tilt.cap_area_m2() : tilt.rod_area_m2()},
        {"left end down", extension_lifts ? tilt.rod_area_m2() : tilt.cap_area_m2()}}},
      profile.hst.engine_radps, simulated);
}

std::string percents(const machines::DrivenRange& range) {
  return range.said ? fmt::format("{:.0f} .. {:.0f}", 100.0 * range.least, 100.0 * range.most)
                    : std::string("-");
}

/// Lift and tilt, side by side, as the controller takes them.
FactTable blade_answer_table(const machines::DozerMachine& machine) {
  const bool tilts = machine.profile.tilt.present;
  FactTable table{
      "Spools, as the controller takes them",
      {"", "opens at, %", "half open at, %", "fully at, %", "dead time, ms", "lag, ms",
       "driven, %"},
      {},
      "duties, in shares of the spool's travel; what the profile does not say of a side "
      "is its valve's; " +
          machines::commissioned_text(machine.driven, tilts)};
  const DozerBank bank = dozer_bank(machine.profile);
  for (std::size_t drive = 0; drive < static_cast<std::size_t>(bank.count); ++drive) {
    for (const bool extends : {true, false}) {
      const SpoolAnswer& answer = bank.row[drive].answer.side(extends);
      const auto percent = [&](double opening) {
        return fmt::format("{:.1f}", 100.0 * answer.spool_to_duty.at(opening));
      };
      table.rows.push_back({fmt::format("{}, {}", machines::kBladeNames[drive],
                                        machines::kSideNames[extends ? 0 : 1]),
                            percent(0.0), percent(0.5), percent(1.0),
                            fmt::format("{:.0f}", 1e3 * answer.dead_time_s),
                            fmt::format("{:.0f}", 1e3 * answer.lag_s),
                            percents(machine.driven.blade[drive].side(extends))});
    }
  }
  return table;
}

FactTable travel_table(const DozerProfile& profile) {
  const HstProfile& hst = profile.hst;
  FactTable table{"Travel",
                  {"engine", "rpm", "motor at full displacement, m/s", "at its least, m/s"},
                  {},
                  fmt::format("wanted: {:g} m/s", profile.travel.speed_desired_mps)};
  for (const auto& [name, radps] :
       {std::pair{"slowest", hst.engine_least_radps}, std::pair{"at work", hst.engine_radps},
        std::pair{"fastest", hst.engine_most_radps}}) {
    table.rows.push_back({name, fmt::format("{:.0f}", radps * 60.0 / kTwoPi),
                          fmt::format("{:.2f}", track_speed_mps(hst, radps, 1.0, 1.0)),
                          fmt::format("{:.2f}", track_speed_max_mps(hst, radps))});
  }
  return table;
}

/// Of a cylinder's oil, its ports shut.
double oil_spring_npm(const plant::CylinderData& cylinder, double stroke_m) {
  const double cap_m2 = cylinder.area.cap_m2;
  const double rod_m2 = cylinder.area.rod_m2;
  return cylinder.bulk_modulus_pa *
         (cap_m2 * cap_m2 / (cylinder.dead_volume_m3 + cap_m2 * stroke_m) +
          rod_m2 * rod_m2 / (cylinder.dead_volume_m3 + rod_m2 * (cylinder.stroke_m - stroke_m)));
}

std::string mode_hz(double spring_nmprad, double inertia_kgm2) {
  return fmt::format("{:.1f}", std::sqrt(spring_nmprad / inertia_kgm2) / kTwoPi);
}

/// Of the blade about its tilt's axis.
std::string tilt_mode_hz(const plant::DozerPlantProfile& plant) {
  const TiltProfile& tilt = plant.machine.tilt;
  const TiltKinematics linkage(tilt);
  plant::CylinderData cylinder;
  cylinder.area = plant::piston_areas(tilt.cylinder_count, tilt.bore_m, tilt.rod_m);
  cylinder.stroke_m = linkage.stroke_max_m();
  cylinder.dead_volume_m3 = plant.tilt.dead_volume_m3;
  cylinder.bulk_modulus_pa = plant.bulk_modulus_pa;
  const double lever_m = linkage.stroke_rate_mprad(0.0);
  return mode_hz(oil_spring_npm(cylinder, linkage.stroke_m(0.0)) * lever_m * lever_m,
                 plant.tilt.inertia_kgm2);
}

/// Of body and blade: rocking on its springs, the blade on its oil.
FactTable mode_table(const DozerProfile& profile, const machines::SimulatedDozer* simulated) {
  const double springs_npm = 2.0 * profile.body.wheels * profile.body.suspension_npm;
  FactTable table{
      "Lowest modes",
      {"", "Hz", ""},
      {{"heave", fmt::format("{:.1f}", std::sqrt(springs_npm / profile.body.mass_kg) / kTwoPi),
        "body on the springs of both tracks, blade in the air"}},
      ""};
  if (simulated == nullptr) {
    table.note =
        "pitch and blade need masses and oil: there is no NAME.sim.toml beside the profile";
    return table;
  }
  const plant::DozerPlantProfile& plant = simulated->plant;
  const double half_m = 0.5 * profile.body.track_contact_m;
  const int wheels = profile.body.wheels;
  double square_m2 = 0.0;
  for (int i = 0; i < wheels; ++i) {
    const double x_m = -half_m + 2.0 * half_m * i / (wheels - 1);
    square_m2 += x_m * x_m;
  }
  const double pitch_nmprad = 2.0 * square_m2 * profile.body.suspension_npm;
  const BladeKinematics blade(profile.blade);
  const plant::CylinderData cylinder = plant.blade_cylinder(blade.stroke_max_m());
  const double spring_npm = oil_spring_npm(cylinder, blade.stroke_m(0.0));
  const double lever_m = blade.stroke_rate_mprad(0.0);
  const double inertia_kgm2 = plant.blade_mass_kg * plant.blade_reach_m * plant.blade_reach_m;
  table.rows.push_back({"pitch", mode_hz(pitch_nmprad, plant.pitch_inertia_kgm2),
                        "body on the springs of both tracks"});
  table.rows.push_back({"blade", mode_hz(spring_npm * lever_m * lever_m, inertia_kgm2),
                        "at home on its oil, valve shut, body held"});
  if (profile.tilt.present) {
    table.rows.push_back({"tilt", tilt_mode_hz(plant), "level on its oil, valve shut, body held"});
  }
  return table;
}

void expect_tilt(Warnings& warnings, const DozerProfile& profile,
                 const machines::SimulatedDozer* simulated) {
  const TiltProfile& tilt = profile.tilt;
  expect_rod(warnings, "tilt.cylinder", tilt.bore_m, tilt.rod_m);
  const double end_mps = tilt.half_width_m() /
                         std::abs(TiltKinematics(tilt).stroke_rate_mprad(0.0)) *
                         tilt_flow_m3ps(profile) / tilt.cap_area_m2();
  warnings.expect("tilt.cylinder.bore", end_mps, 0.05, 1.0,
                  "end of the edge at full flow into the cap", "m/s");
  if (simulated != nullptr) {
    expect_deadband(warnings, "tilt.spool_to_duty", simulated->plant.deadband_ratio,
                    tilt.spool_to_duty);
  }
}

void expect_plant(Warnings& warnings, const machines::SimulatedDozer& machine) {
  const DozerProfile& profile = machine.profile;
  const plant::DozerPlantProfile& plant = machine.plant;
  expect_oil(warnings, "implement", plant.bulk_modulus_pa);
  expect_deadband(warnings, "implement.spool_to_duty", plant.deadband_ratio,
                  profile.implement.spool_to_duty);
  expect_spool(warnings, "implement", plant.spool_time_constant_s, plant.spool_damping,
               profile.safety.settle_s, profile.control.response_s);
  warnings.expect(
      "blade.mass", plant.blade_mass_kg / profile.body.mass_kg, 0.04, 0.3,
      fmt::format("blade with frame of {:g} kg, of the machine's mass", plant.blade_mass_kg));
  warnings.expect("blade.reach", plant.blade_reach_m / profile.blade.cutting_edge_m, 0.4, 1.1,
                  fmt::format("mass centre {:g} m from the pivot, of the cutting edge's distance",
                              plant.blade_reach_m));
  const double size_m = std::pow(1e-3 * profile.body.mass_kg, 0.29);  // As in likely_dozer.cpp.
  warnings.expect(
      "blade.width", plant.blade_shape.width_m, 1.15 * size_m, 2.2 * size_m,
      fmt::format("width of the blade of a machine of {:.3g} t", 1e-3 * profile.body.mass_kg), "m");
  const double length_m = profile.body.track_contact_m;
  warnings.expect(
      "body.pitch_inertia", plant.pitch_inertia_kgm2 / (profile.body.mass_kg * length_m * length_m),
      0.06, 0.6,
      fmt::format("{:g} kg m2, over mass and squared track contact", plant.pitch_inertia_kgm2));
  const double force_n = plant.implement_relief_pa * profile.blade.cap_area_m2();
  warnings.expect("implement.coulomb", 100.0 * plant.coulomb_n / force_n, 0.05, 8.0,
                  fmt::format("{:g} N, of the cylinders' force at relief", plant.coulomb_n), "%");
  warnings.expect("implement.relief", force_n / (profile.body.mass_kg * plant.gravity_mps2), 0.8,
                  20.0, "cylinders' force at relief, over the machine's weight");
  warnings.expect("implement.relief", 1e-6 * plant.implement_relief_pa, 12.0, 40.0,
                  "relief of the implement's pump", "MPa");
  warnings.expect("hst.relief", 1e-6 * plant.hst_relief_pa, 25.0, 65.0,
                  "relief of the transmission's lines", "MPa");
  warnings.add_if(plant.charge_pa > 0.2 * plant.hst_relief_pa, "hst.charge",
                  fmt::format("{:.1f} MPa of charge under a relief of {:.1f} MPa; usual: at most a "
                              "fifth",
                              1e-6 * plant.charge_pa, 1e-6 * plant.hst_relief_pa));
}

}  // namespace

std::vector<Warning> dozer_warnings(const machines::DozerMachine& machine,
                                    const machines::SimulatedDozer* simulated) {
  const DozerProfile& profile = machine.profile;
  const HstProfile& hst = profile.hst;
  Warnings warnings;
  expect_rod(warnings, "blade.cylinder", profile.blade.bore_m, profile.blade.rod_m);
  expect_times(warnings, profile.safety.settle_s, profile.control.sensor_timeout_s,
               profile.control.response_s);
  const double pump_m3ps = pump_flow_m3ps(profile);
  warnings.expect("implement.valve_flow_max", profile.implement.valve_flow_max_m3ps / pump_m3ps,
                  0.5, 3.0,
                  fmt::format("{:.0f} L/min through the valve over {:.0f} L/min of its pump",
                              6e4 * profile.implement.valve_flow_max_m3ps, 6e4 * pump_m3ps));
  warnings.expect(
      "hst.gear_ratio", track_speed_mps(hst, hst.engine_radps, 1.0, 1.0), 0.5, 4.0,
      fmt::format("track speed with both displacements full at {:g} rad/s", hst.engine_radps),
      "m/s");
  const double fastest_mps = track_speed_max_mps(hst, hst.engine_radps);
  warnings.add_if(profile.travel.speed_desired_mps > fastest_mps, "travel.speed_desired",
                  fmt::format("{:g} m/s; the tracks reach {:.2f} m/s at the engine's speed at work",
                              profile.travel.speed_desired_mps, fastest_mps));
  warnings.expect("body.mass_centre_height",
                  profile.body.mass_centre_height_m / profile.body.half_gauge_m, 0.4, 1.6,
                  fmt::format("{:g} m over half a gauge of {:g} m",
                              profile.body.mass_centre_height_m, profile.body.half_gauge_m));
  warnings.expect("body.mass", profile.body.mass_kg / std::pow(profile.body.track_contact_m, 3.0),
                  200.0, 2000.0,
                  fmt::format("mass of {:g} kg on a track contact of {:g} m, over its cube",
                              profile.body.mass_kg, profile.body.track_contact_m),
                  "kg/m3");
  warnings.expect(
      "blade.cutting_edge", profile.blade.cutting_edge_m / profile.body.track_contact_m, 0.35, 1.6,
      fmt::format("{:g} m from the pivot, over the track contact", profile.blade.cutting_edge_m));
  warnings.add_if(profile.safety.idle_radps < hst.engine_least_radps - 0.01, "safety.idle",
                  fmt::format("{:g} rad/s is below the slowest engine, {:g} rad/s",
                              profile.safety.idle_radps, hst.engine_least_radps));
  const double edge_mps = edge_per_stroke(profile.blade) *
                          available_flow_m3ps(profile.implement, hst.engine_radps) /
                          profile.blade.cap_area_m2();
  warnings.expect("blade.cylinder.bore", edge_mps, 0.05, 1.0,
                  "lowering of the cutting edge at full flow", "m/s");
  if (profile.tilt.present) {
    expect_tilt(warnings, profile, simulated);
  }
  expect_likely(warnings, profile);
  if (simulated != nullptr) {
    expect_plant(warnings, *simulated);
  }
  return warnings.take();
}

MachineCheck check_machine(const machines::DozerMachine& machine,
                           const machines::SimulatedDozer* simulated) {
  MachineCheck check;
  check.name = machine.name;
  check.kind = "dozer";
  check.hash = machine.hash;
  const DozerProfile& profile = machine.profile;
  check.tables = {blade_table(profile), lift_drive_table(profile, simulated)};
  if (profile.tilt.present) {
    check.tables.push_back(tilt_table(profile.tilt));
    check.tables.push_back(tilt_drive_table(profile, simulated));
  }
  check.tables.push_back(blade_answer_table(machine));
  check.tables.push_back(travel_table(profile));
  check.tables.push_back(mode_table(profile, simulated));
  check.tables.push_back(provenance_table(machine.provenance));
  check.warnings = dozer_warnings(machine, simulated);
  check.drawing = dozer_drawing(profile);
  return check;
}

}  // namespace graben::reports
