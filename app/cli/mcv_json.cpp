// SPDX-License-Identifier: Apache-2.0
#include "app/cli/mcv_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "firmware/hydraulics/flow.hpp"

namespace graben::cli {
namespace {

using nlohmann::json;

constexpr int kDeepest = 16;

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw std::runtime_error(where + ": " + what);
}

/// A place in the document: its path for messages beside the value.
struct Node {
  const json& value;
  std::string path;

  [[nodiscard]] Node at(const char* key) const {
    if (!value.is_object()) {
      refuse(path, "is not an object");
    }
    const auto found = value.find(key);
    if (found == value.end()) {
      refuse(path.empty() ? key : path + "." + key, "is missing");
    }
    return {*found, path.empty() ? key : path + "." + key};
  }
  /// Refuses every other key: a misspelt `relief` must not solve without one.
  void only(const std::vector<std::string>& keys) const {
    if (!value.is_object()) {
      refuse(path, "is not an object");
    }
    for (const auto& item : value.items()) {
      if (std::find(keys.begin(), keys.end(), item.key()) == keys.end()) {
        refuse(path + "." + item.key(),
               fmt::format("unknown key; known: {}", fmt::join(keys, ", ")));
      }
    }
  }
  [[nodiscard]] bool has(const char* key) const {
    return value.is_object() && value.contains(key) && !value.at(key).is_null();
  }
  [[nodiscard]] std::vector<Node> items(std::size_t least, std::size_t most) const {
    if (!value.is_array() || value.size() < least || value.size() > most) {
      refuse(path, fmt::format("must be an array of {} to {} entries", least, most));
    }
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < value.size(); ++i) {
      nodes.push_back({value[i], fmt::format("{}[{}]", path, i)});
    }
    return nodes;
  }
  [[nodiscard]] double number() const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      refuse(path, fmt::format("{} is not a finite number", value.dump()));
    }
    return value.get<double>();
  }
  [[nodiscard]] double positive() const {
    const double number_value = number();
    if (!(number_value > 0.0)) {
      refuse(path, fmt::format("{} must be greater than 0", number_value));
    }
    return number_value;
  }
  [[nodiscard]] double not_negative() const {
    const double number_value = number();
    if (!(number_value >= 0.0)) {
      refuse(path, fmt::format("{} must be at least 0", number_value));
    }
    return number_value;
  }
  [[nodiscard]] double below_one() const {
    const double number_value = not_negative();
    if (!(number_value < 1.0)) {
      refuse(path, fmt::format("{} must be less than 1", number_value));
    }
    return number_value;
  }
  [[nodiscard]] int integer(int least, int most) const {
    if (!value.is_number_integer() || value.get<double>() < least || value.get<double>() > most) {
      refuse(path,
             fmt::format("{} must be a whole number from {} to {}", value.dump(), least, most));
    }
    return value.get<int>();
  }
};

MonotoneTable read_table(const Node& node) {
  std::vector<double> travel;
  std::vector<double> coefficient;
  for (const Node& point : node.items(2, MonotoneTable::capacity())) {
    const std::vector<Node> pair = point.items(2, 2);
    travel.push_back(pair[0].number());
    coefficient.push_back(pair[1].number());
  }
  if (travel.front() != 0.0 || coefficient.front() != 0.0) {
    refuse(node.path, "must start at [0, 0]");
  }
  MonotoneTable table;
  if (table.fill(travel.data(), coefficient.data(), static_cast<int>(travel.size())) !=
      MonotoneTable::Fill::kOk) {
    refuse(node.path, "must be strictly increasing in both columns");
  }
  return table;
}

McvActuator read_actuator(const Node& node, int pump_count) {
  node.only({"name", "area_cap", "area_rod", "pump", "regeneration", "c_drain", "c_check",
             "bypass_open", "bypass_closed", "force_offset", "c_inflow_check", "c_extend",
             "c_retract", "outlet_share", "bypass_closes_at"});
  McvActuator actuator;
  actuator.area_cap_m2 = node.at("area_cap").positive();
  actuator.area_rod_m2 = node.at("area_rod").positive();
  actuator.pump = node.at("pump").integer(0, pump_count - 1);
  actuator.regeneration = static_cast<RegenerationSide>(node.at("regeneration").integer(-1, 1));
  if (actuator.regeneration != RegenerationSide::kNone) {
    actuator.c_drain = node.at("c_drain").positive();
    actuator.c_check = node.at("c_check").positive();
    if (!(actuator.c_drain < actuator.c_check)) {
      refuse(node.path + ".c_drain",
             fmt::format("{} must be less than c_check {}", actuator.c_drain, actuator.c_check));
    }
  }
  actuator.bypass_open = node.at("bypass_open").positive();
  actuator.bypass_closed = node.at("bypass_closed").positive();
  actuator.force_offset_n = node.at("force_offset").not_negative();
  if (node.has("c_inflow_check")) {
    actuator.c_inflow_check = node.at("c_inflow_check").positive();
  }
  if (node.has("outlet_share")) {
    const std::vector<Node> share = node.at("outlet_share").items(2, 2);
    actuator.extend_outlet_share = share[0].below_one();
    actuator.retract_outlet_share = share[1].below_one();
  }
  if (node.has("bypass_closes_at")) {
    const double opening = node.at("bypass_closes_at").positive();
    actuator.bypass_closes_at = {opening, opening};
  }
  actuator.extend = read_table(node.at("c_extend"));
  actuator.retract = read_table(node.at("c_retract"));
  return actuator;
}

/// A pump that sets its own swash; its flow is then that of full swash.
PumpRegulator read_regulator(const Node& pump) {
  PumpRegulator by;
  if (pump.has("load_sensing")) {
    const Node node = pump.at("load_sensing");
    node.only({"margin", "compensated"});
    by.kind = PumpKind::kLoadSensing;
    by.margin_pa = node.at("margin").positive();
    by.compensated = node.at("compensated").integer(0, 1) == 1;
  } else if (pump.has("negative_flow")) {
    const Node node = pump.at("negative_flow");
    node.only({"pressure", "least_swash"});
    const std::vector<Node> pressure = node.at("pressure").items(2, 2);
    by.kind = PumpKind::kNegativeFlow;
    by.full_swash_pa = pressure[0].not_negative();
    by.least_swash_pa = pressure[1].positive();
    by.least_swash_ratio = node.at("least_swash").below_one();
  }
  return by;
}

McvPump read_pump(const Node& node) {
  node.only({"flow", "leak_linear", "leak_quadratic", "bypass_series", "relief", "load_sensing",
             "negative_flow"});
  McvPump pump;
  pump.leak_linear = node.at("leak_linear").not_negative();
  pump.leak_quadratic = node.at("leak_quadratic").not_negative();
  for (const Node& orifice : node.at("bypass_series").items(0, kMaxBypassSeries)) {
    pump.tank_orifice = orifice.positive();
    pump.series_resistance += orifice_resistance(pump.tank_orifice);
  }
  pump.regulator = read_regulator(node);
  pump.has_relief = node.has("relief");
  if (pump.has_relief) {
    pump.relief_pa = node.at("relief").positive();
  }
  return pump;
}

template <class Read>
void read_per_actuator(const Node& node, int count, PerActuator<double>& into, Read read) {
  const auto entries = static_cast<std::size_t>(count);
  std::size_t i = 0;
  for (const Node& item : node.items(entries, entries)) {
    into[i++] = read(item);
  }
}

template <class Array, class Value>
nlohmann::ordered_json list(const Array& values, int count, Value value) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (int i = 0; i < count; ++i) {
    array.push_back(value(values[static_cast<unsigned>(i)]));
  }
  return array;
}

}  // namespace

McvCase parse_mcv_case(const std::string& line) {
  json document;
  try {
    // Nothing of the schema is deeper than 6; a bound keeps recursion off hostile lines.
    document = json::parse(line, [](int depth, json::parse_event_t, json&) {
      if (depth > kDeepest) {
        throw std::runtime_error(fmt::format("more than {} levels deep", kDeepest));
      }
      return true;
    });
  } catch (const json::parse_error& error) {
    throw std::runtime_error(fmt::format("not JSON: at byte {} of the line", error.byte));
  }
  const Node root{document, ""};
  if (!document.is_object()) {
    refuse("line", "is not a JSON object");
  }
  McvCase result;
  if (root.has("id")) {
    if (!document["id"].is_string() && !document["id"].is_number()) {
      refuse("id", "must be a string or a number");
    }
    result.id = document["id"];
  }
  const Node machine = root.at("machine");
  machine.only({"actuators", "pumps"});
  const std::vector<Node> pumps = machine.at("pumps").items(1, kMaxPumps);
  const std::vector<Node> actuators = machine.at("actuators").items(1, kMaxActuators);
  result.machine.pump_count = static_cast<int>(pumps.size());
  result.machine.actuator_count = static_cast<int>(actuators.size());
  for (std::size_t j = 0; j < pumps.size(); ++j) {
    result.machine.pump[j] = read_pump(pumps[j]);
    result.input.pump_flow_m3ps[j] = pumps[j].at("flow").not_negative();
  }
  for (std::size_t i = 0; i < actuators.size(); ++i) {
    result.machine.actuator[i] = read_actuator(actuators[i], result.machine.pump_count);
  }
  const Node input = root.at("input");
  input.only({"velocity", "p_cap", "p_rod"});
  const int count = result.machine.actuator_count;
  const auto pressure = [](const Node& item) { return item.not_negative(); };
  read_per_actuator(input.at("velocity"), count, result.input.velocity_mps,
                    [](const Node& item) { return item.number(); });
  read_per_actuator(input.at("p_cap"), count, result.input.cap_pressure_pa, pressure);
  read_per_actuator(input.at("p_rod"), count, result.input.rod_pressure_pa, pressure);
  return result;
}

std::string limit_name(const Limit& limit) {
  switch (limit.kind) {
    case LimitKind::kNone:
      return "";
    case LimitKind::kPumpFlow:
      return fmt::format("pump_flow[{}]", limit.index);
    case LimitKind::kBackFlow:
      return fmt::format("back_flow[{}]", limit.index);
    case LimitKind::kSpoolTravel:
      return fmt::format("spool_travel[{}]", limit.index);
    case LimitKind::kStrokeEnd:
      return fmt::format("stroke_end[{}]", limit.index);
    case LimitKind::kRise:
      return "rise";
    case LimitKind::kDegraded:
      return fmt::format("degraded[{}]", limit.index);
    default:  // None of the solution's.
      return "unknown";
  }
}

const std::map<std::string, McvPolicy>& policies() {
  static const std::map<std::string, McvPolicy> names = {{"algorithm1", McvPolicy::kAlgorithm1},
                                                         {"connected", McvPolicy::kConnected},
                                                         {"global", McvPolicy::kGlobal}};
  return names;
}

std::string status_name(SolveStatus status) {
  switch (status) {
    case SolveStatus::kOk:
      return "ok";
    case SolveStatus::kInfeasible:
      return "infeasible";
    case SolveStatus::kBadInput:
      return "bad_input";
    case SolveStatus::kNotConverged:
      return "not_converged";
  }
  return "unknown";
}

std::string defect_text(const McvCheck& check) {
  // What is left for the core to refuse after the reader: numbers whose squares are none.
  const char* key = "";
  switch (check.defect) {
    case McvDefect::kRegeneration:
      key = "c_drain or c_check";
      break;
    case McvDefect::kBypass:
      key = "bypass_open or bypass_closed";
      break;
    case McvDefect::kInflowCheck:
      key = "c_inflow_check";
      break;
    case McvDefect::kRegulator:
      return fmt::format(
          "machine.pumps[{}]: a pump that sets its swash needs a relief, negative_flow two "
          "pressures "
          "that rise and an orifice at the end of bypass_series",
          check.index);
    case McvDefect::kBypassSeries:
      return fmt::format("machine.pumps[{}].bypass_series: out of any usable range", check.index);
    default:
      return fmt::format("entry {}: out of any usable range (defect {})", check.index,
                         static_cast<int>(check.defect));
  }
  return fmt::format("machine.actuators[{}].{}: out of any usable range", check.index, key);
}

nlohmann::ordered_json solution_json(const McvCase& mcv_case, const McvSolution& solution) {
  const int actuators = mcv_case.machine.actuator_count;
  const auto number = [](double value) { return value; };
  const auto flag = [](bool value) { return value; };
  nlohmann::ordered_json result;
  result["id"] = mcv_case.id;
  result["lambda"] = solution.point.lambda;
  result["spool"] = list(solution.point.spool_m, actuators, number);
  result["pump_pressure"] =
      list(solution.point.pump_pressure_pa, mcv_case.machine.pump_count, number);
  result["p_out"] = list(solution.point.out_pressure_pa, actuators, number);
  result["regenerating"] = list(solution.point.regenerating, actuators, flag);
  result["limit"] = limit_name(solution.limit);
  result["shortfall"] = solution.shortfall;
  result["margins"] = {
      {"pump_flow_m3ps", list(solution.margins.flow_m3ps, mcv_case.machine.pump_count, number)},
      {"force_n", list(solution.margins.force_n, actuators, number)},
      {"travel_m", list(solution.margins.travel_m, actuators, number)}};
  result["iterations"] = solution.iterations;
  result["status"] = status_name(solution.status);
  if (!solution.standstill.can_start) {
    result["standstill"] = {{"actuator", solution.standstill.actuator},
                            {"short_n", solution.standstill.short_n}};
  }
  return result;
}

}  // namespace graben::cli
