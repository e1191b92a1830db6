// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the TOML files of all machine kinds have in common.

#include <string>

#include "app/machines/toml_reader.hpp"
#include "firmware/machine/spool_answer.hpp"

namespace graben::machines {

/// Cylinders that move together.
struct CylinderSize {
  int count = 0;
  double bore_m = 0.0;
  double rod_m = 0.0;
};

/// count, bore and rod of the cylinder at this key ("boom.cylinder"); the rod must fit.
[[nodiscard]] CylinderSize read_cylinder_size(TomlReader& reader, const std::string& at);

/// Opening in shares of the travel to duty, per mille in the file and a share in the table; both
/// strictly increasing, from opening 0 to opening 1.
[[nodiscard]] DutyTable read_spool_to_duty(TomlReader& reader, const std::string& key);

/// How a valve is driven: keys that each kind's control struct has. The dead time stands with the
/// valve, in section `valve`.
template <class Control>
[[nodiscard]] Control read_control_of_valve(TomlReader& reader, const std::string& valve) {
  Control control;
  control.spool_rate_ps =
      reader.number("control.spool_rate", {0.1, 1000.0, "1/s"}, "slew limit of a spool's opening");
  if (reader.has("control.duty_rate")) {
    control.duty_rate_ps =
        reader.number("control.duty_rate", {10.0, 100.0, "1/s"},
                      "fastest rise of a duty on the wire, lead included; 50 unless told");
  }
  control.spool_threshold = reader.number("control.spool_threshold", {0.0, 0.1, ""},
                                          "opening below which a spool stays at neutral");
  control.response_s = reader.number("control.response", {0.001, 1.0, "s"},
                                     "lag of a drive's speed behind its spool's command");
  control.dead_time_s = reader.number(valve + ".dead_time", {0.0, 0.5, "s"},
                                      "from a duty to the spool's first movement");
  control.sensor_timeout_s = reader.number("control.sensor_timeout", {0.02, 0.05, "s"},
                                           "age at which a signal is missing");
  return control;
}

/// The watches' keys that each kind's safety struct has.
template <class Safety>
[[nodiscard]] Safety read_safety_of_valve(TomlReader& reader) {
  Safety safety;
  safety.degraded_speed_ratio = reader.number("safety.degraded_speed", {0.05, 1.0, ""},
                                              "speed while a sensor is lost, of the task's");
  safety.idle_radps = reader.number("safety.idle", {20.0, 400.0, "rad/s"},
                                    "engine speed assumed where it is lost: its slowest");
  safety.settle_s =
      reader.number("safety.settle", {0.01, 0.3, "s"},
                    "how far a sound spool lags a steady rise of its duty, beside the dead time");
  safety.spool_tolerance = reader.number("safety.spool_tolerance", {0.01, 0.5, ""},
                                         "allowed error of a spool's position, of its travel");
  safety.uncommanded_m = reader.number("safety.uncommanded", {0.005, 0.5, "m"},
                                       "motion of a cylinder against its spool");
  safety.sink_mps = reader.number_or(
      0.002, "safety.sink", {0.0, 0.02, "m/s"},
      "no faster does a cylinder sink whose spool is in its middle; 0.002 m/s without");
  safety.stuck_m = reader.number("safety.stuck", {0.005, 0.5, "m"},
                                 "motion asked of a cylinder that does not come");
  safety.tube_m = reader.number_or(
      0.3, "safety.tube", {0.02, 5.0, "m"},
      "distance of the tool from what it follows at which it stops; 0.3 m without");
  safety.stall_s = reader.number_or(10.0, "safety.stall", {3.0, 600.0, "s"},
                                    "time that it may hardly get on; 10 s without");
  return safety;
}

}  // namespace graben::machines
