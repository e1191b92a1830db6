// SPDX-License-Identifier: Apache-2.0
#include "app/machines/pump_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/machines/axis_names.hpp"

namespace graben::machines {
namespace {

constexpr Range kFlowCoefficient{1e-9, 1e-3, "m3/(s sqrt(Pa))"};
constexpr Range kPressure{1e6, 1e8, "Pa"};
/// Of an orifice that is none.
constexpr double kOpen = 1.0;
/// Of a bypass that is closed, m3/(s sqrt(Pa)): 6e-9 m3/s at 35 MPa.
constexpr double kClosedCentre = 1e-12;
/// Less between full and least swash is a regulator that only jumps.
constexpr double kLeastRise_pa = 2e5;

/// In the order of PumpKind.
const std::vector<std::string>& pump_kinds() {
  static const std::vector<std::string> names = {"positive", "load_sensing", "negative_flow"};
  return names;
}

void read_load_sensing(TomlReader& reader, const std::string& at, PumpRegulator& by) {
  by.margin_pa =
      reader.number(at + "margin", {0.5e6, 6e6, "Pa"},
                    "load sensing: the line above the heaviest load; makers set 1.2 to "
                    "3.5 MPa (Komatsu LS valves 1.18 .. 2.65, Oilgear XD5 1.38 .. 3.45)");
  by.compensated = reader.boolean_or(true, at + "compensated",
                                     "each section keeps the margin over its metering edge");
}

void read_negative_flow(TomlReader& reader, const std::string& at, PumpRegulator& by) {
  const std::vector<double> pressure = reader.numbers(
      at + "pressure", {0.0, 1e7, "Pa"}, 2,
      "negative flow: before the last of bypass_series, up to where the swash is full and from "
      "where it is least; within 0 .. 4 MPa (diagram of the Kawasaki K3V112DT)");
  by.full_swash_pa = pressure[0];
  by.least_swash_pa = pressure[1];
  by.least_swash_ratio = reader.number(at + "least_swash", {0.0, 0.9, ""}, "least swash, of full");
  if (reader.is_sound() && pressure[1] - pressure[0] < kLeastRise_pa) {
    reader.fail(at + "pressure",
                fmt::format("[{}, {}] Pa; allowed: first that of full swash, then that of least, "
                            "at least {} Pa more",
                            pressure[0], pressure[1], kLeastRise_pa));
  }
}

PumpRegulator read_regulator(TomlReader& reader, const std::string& at) {
  PumpRegulator by;
  if (reader.has(at + "kind")) {
    by.kind = static_cast<PumpKind>(reader.choice(
        at + "kind", pump_kinds(),
        "who sets its swash: the controller, as without this key, or its own regulator"));
  }
  for (const PumpKind kind : {PumpKind::kLoadSensing, PumpKind::kNegativeFlow}) {
    const std::string name = pump_kinds()[static_cast<std::size_t>(kind)];
    const bool there = reader.has(at + name);
    if (there != (by.kind == kind)) {
      reader.fail(at + (there ? name : "kind"),
                  fmt::format("{}; allowed: kind = \"{}\" and a table {} together",
                              there ? "another kind" : "a table is missing", name, name));
    }
    if (there && kind == PumpKind::kLoadSensing) {
      read_load_sensing(reader, at + name + ".", by);
    } else if (there) {
      read_negative_flow(reader, at + name + ".", by);
    }
  }
  if (by.sets_swash() || reader.has(at + "response")) {
    by.response_s =
        reader.number(at + "response", {0.01, 1.0, "s"},
                      "time in which a swash that its regulator sets goes from least to full");
  }
  if (!by.sets_swash() && reader.has(at + "response")) {
    reader.fail(at + "response",
                "the controller sets this pump's swash; allowed: only with a kind that sets it "
                "itself, load_sensing or negative_flow");
  }
  return by;
}

/// Neither pump nor valve is to see more than it is built for.
void check_relief(TomlReader& reader, const std::string& pump, double relief_pa) {
  for (const std::string& key : {pump + "rated_pressure", std::string("valve.rated_pressure")}) {
    const double rated_pa = reader.number(
        key, kPressure, "highest pressure that it is built for; at least each pump's relief");
    if (relief_pa > rated_pa) {
      reader.fail(pump + "relief",
                  fmt::format("{} Pa; allowed: at most {}, {} Pa", relief_pa, key, rated_pa));
    }
  }
}

PumpProfile read_pump(TomlReader& reader, unsigned index) {
  const std::string at = fmt::format("pump[{}].", index);
  PumpProfile pump;
  pump.displacement_m3prev =
      reader.number(at + "displacement", {1e-6, 1e-2, "m3/rev"}, "displacement at full swash");
  pump.rated_speed_radps =
      reader.number(at + "speed", {10.0, 1000.0, "rad/s"}, "shaft speed at work");
  pump.leak_linear =
      reader.number(at + "leak_linear", {0.0, 1e-9, "m3/(s Pa)"}, "leakage per pressure");
  pump.leak_quadratic = reader.number(at + "leak_quadratic", {0.0, 1e-16, "m3/(s Pa2)"},
                                      "leakage per squared pressure");
  pump.relief_pa =
      reader.number(at + "relief", kPressure,
                    "relief of the pump line; at most rated_pressure of pump and valve");
  check_relief(reader, at, pump.relief_pa);
  pump.regulator = read_regulator(reader, at);
  if (pump.regulator.kind == PumpKind::kLoadSensing) {
    pump.bypass_series = {kOpen, kOpen};
    return pump;
  }
  const std::vector<double> series =
      reader.numbers(at + "bypass_series", kFlowCoefficient, 2,
                     "flow coefficients of the two fixed orifices behind the bypass (Tk1, Tk2); "
                     "unless it senses the load");
  std::copy(series.begin(), series.end(), pump.bypass_series.begin());
  return pump;
}

/// A side's own opening before that of all.
void read_closing(TomlReader& reader, const std::string& axis, BypassClosing& at) {
  const double of_all =
      reader.number_or(0.0, "valve.bypass.closes_at", {0.0, 1.0, ""},
                       "opening at which it is closed, evenly from the dead band's edge on; 0: "
                       "closed wherever the spool is open; only with pumps of kind negative_flow");
  const auto of_side = [&](const char* side) {
    const std::string key = fmt::format("valve.answer.{}.{}.bypass_closes_at", axis, side);
    if (!reader.has(key)) {
      return of_all;
    }
    const double opening = reader.number(key, {0.01, 1.0, ""},
                                         "opening at which the bypass is closed on this side, "
                                         "instead of valve.bypass.closes_at, which is above 0");
    if (of_all == 0.0 && !reader.lists()) {
      reader.fail(key, fmt::format("{}; allowed: only where valve.bypass.closes_at is above 0, it "
                                   "is 0 or missing",
                                   opening));
    }
    return opening;
  };
  at = {of_side(kSideNames[0]), of_side(kSideNames[1])};
}

}  // namespace

void read_pumps(TomlReader& reader, ExcavatorProfile& profile) {
  profile.pump_count = reader.table_count("pump", 1, kPumpCount, "pumps, a table each");
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    profile.pump[j] = read_pump(reader, j);
    if (profile.pump[j].regulator.kind != profile.pump[0].regulator.kind) {
      reader.fail(
          fmt::format("pump[{}].kind", j),
          fmt::format("another than that of the first; allowed: {}, as it has",
                      pump_kinds()[static_cast<std::size_t>(profile.pump[0].regulator.kind)]));
    }
  }
}

void read_bypass(TomlReader& reader, const std::string& axis, PumpKind kind, SpoolProfile& spool) {
  const bool is_open = kind != PumpKind::kLoadSensing;
  if (is_open || reader.has("valve.bypass")) {
    spool.bypass_open = reader.number("valve.bypass.open", kFlowCoefficient,
                                      "flow coefficient of a bypass with its spool at neutral; "
                                      "not looked at where the pumps sense the load");
    spool.bypass_closed = reader.number("valve.bypass.closed." + axis, kFlowCoefficient,
                                        "the same with its spool moved");
  }
  if (!is_open) {
    spool.bypass_open = spool.bypass_closed = kClosedCentre;
  }
  if (kind == PumpKind::kNegativeFlow || reader.lists()) {
    read_closing(reader, axis, spool.bypass_closes_at);
  }
}

}  // namespace graben::machines
