// SPDX-License-Identifier: Apache-2.0
#include "app/identify/file/identified_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "app/identify/file/profile_text.hpp"
#include "app/machines/answer_section.hpp"
#include "app/machines/axis_names.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::identify {
namespace {

constexpr double kPerMille = 1e3;
/// Relative; a file has six digits.
constexpr double kRounding = 2e-5;

/// A value that goes into the file.
struct Change {
  std::string section;
  std::string key;
  std::string value;
  std::string before;
  std::optional<double> deviation;
  int axis = -1;  ///< Whose error is told beside it; -1: no axis' own.

  [[nodiscard]] std::string path() const { return section + "." + key; }
};

using Changes = std::vector<Change>;

struct ControlValue {
  const char* key;
  double ControlProfile::*value;
};
constexpr ControlValue kControlValues[] = {
    {"convergence_length", &ControlProfile::convergence_length_m},
    {"servo_gain", &ControlProfile::servo_gain_ps},
    {"servo_damping", &ControlProfile::servo_damping},
    {"pressure_filter", &ControlProfile::pressure_filter_s},
    {"learn_share", &ControlProfile::learn_share},
};

/// TOML takes a number without a point for a whole one.
std::string number(double value) {
  std::string text = fmt::format("{:.6g}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

template <class Numbers>
std::string numbers(const Numbers& values) {
  std::vector<std::string> all;
  for (const double value : values) {
    all.push_back(number(value));
  }
  return fmt::format("[{}]", fmt::join(all, ", "));
}

std::string pairs(const DutyTable& table) {
  std::vector<std::string> all;
  for (int at = 0; at < table.size(); ++at) {
    all.push_back(fmt::format("[{}, {}]", number(table.x(at)), number(kPerMille * table.y(at))));
  }
  return table.size() == 0 ? "" : fmt::format("[{}]", fmt::join(all, ", "));
}

std::string said(double value_s) { return value_s == kUnsaid_s ? "" : number(value_s); }

std::optional<double> most(const std::vector<double>& values) {
  return values.empty() ? std::nullopt
                        : std::optional(*std::max_element(values.begin(), values.end()));
}

/// What of a side's answer is new.
void change_side(int axis, bool extends, const SaidAnswer& was, const SaidAnswer& is,
                 const DriveEstimate& drive, Changes& changes) {
  const SideEstimate& side = drive.side(extends);
  std::string section = machines::answer_key(axis, extends);
  section.pop_back();
  const auto change = [&](const char* key, const std::string& before, const std::string& value,
                          std::optional<double> deviation) {
    if (value != before) {
      changes.push_back({section, key, value, before, deviation, axis});
    }
  };
  std::optional<double> duty = most(side.duty_deviation);
  if (duty) {
    duty = kPerMille * *duty;
  }
  change("spool_to_duty", pairs(was.spool_to_duty), pairs(is.spool_to_duty), duty);
  if (pairs(was.spool_to_duty) != pairs(is.spool_to_duty) && side.driven_least < side.driven_most) {
    change("driven", "",
           numbers(std::array{std::max(0.0, side.driven_least), std::min(1.0, side.driven_most)}),
           std::nullopt);
  }
  const double lag_deviation_s =
      std::hypot(drive.pilot_lag_s.deviation, 2.0 * drive.spool_time_constant_s.deviation);
  change("dead_time", said(was.dead_time_s), said(is.dead_time_s), side.dead_time_s.deviation);
  change("lag", said(was.lag_s), said(is.lag_s), lag_deviation_s);
  change("spool_time_constant", said(was.spool_time_constant_s), said(is.spool_time_constant_s),
         0.5 * lag_deviation_s);
}

std::array<double, 4> areas_m2(const SpoolProfile& spool) {
  return {spool.extend_in_m2, spool.extend_out_m2, spool.retract_in_m2, spool.retract_out_m2};
}

/// Of the areas that were found: what coefficient and draining area leave open, the larger.
double area_deviation_m2(const DriveEstimate& drive, const SpoolProfile& was) {
  double most_m2 = 0.0;
  for (const bool extends : {true, false}) {
    const SideEstimate& side = drive.side(extends);
    if (side.edge.known) {
      const double in_m2 = extends ? was.extend_in_m2 : was.retract_in_m2;
      const double out_m2 = extends ? was.extend_out_m2 : was.retract_out_m2;
      most_m2 = std::max({most_m2, in_m2 * side.coefficient_factor.deviation,
                          out_m2 * side.out_area_factor.deviation});
    }
  }
  return most_m2;
}

/// What of section [control] follows from what was found.
void change_control(const ControlProfile& was, const ControlProfile& is, Changes& changes) {
  const auto change = [&](const char* key, const std::string& before, const std::string& value) {
    if (value != before) {
      changes.push_back({"control", key, value, before, std::nullopt});
    }
  };
  const auto law = [](ControlLaw of) {
    return toml_quoted(machines::kLawNames[static_cast<std::size_t>(of)]);
  };
  change("law", law(was.law), law(is.law));
  for (const ControlValue& each : kControlValues) {
    change(each.key, number(was.*each.value), number(is.*each.value));
  }
}

using Zeros = std::array<double, kAxisCount>;

void change_zeros(const char* key, const Zeros& was, const Zeros& is,
                  const MachineEstimate& machine, Estimate DriveEstimate::*of, Changes& changes) {
  if (was == is) {
    return;
  }
  double deviation = 0.0;
  for (const DriveEstimate& drive : machine.drive) {
    if ((drive.*of).known) {
      deviation = std::max(deviation, (drive.*of).deviation);
    }
  }
  changes.push_back({"sensors", key, numbers(is), numbers(was), deviation});
}

/// What negative flow has of its own.
void change_regulators(const ExcavatorProfile& was, const JudgedFit& fit, Changes& changes) {
  const ExcavatorProfile& is = fit.profile;
  for (std::size_t j = 0; j < static_cast<std::size_t>(is.pump_count); ++j) {
    const auto pressures = [j](const ExcavatorProfile& of) {
      const PumpRegulator& by = of.pump[j].regulator;
      return numbers(std::array{by.full_swash_pa, by.least_swash_pa});
    };
    if (pressures(is) != pressures(was)) {
      changes.push_back({fmt::format("pump[{}].negative_flow", j), "pressure", pressures(is),
                         pressures(was), fit.machine.regulator[j].least_swash_pa.deviation});
    }
  }
  for (int axis = 0; axis < is.drive_count; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    for (const bool extends : {true, false}) {
      const double before = was.valve.spool[k].bypass_closes_at.side(extends);
      const double now = is.valve.spool[k].bypass_closes_at.side(extends);
      if (now != before) {
        std::string section = machines::answer_key(axis, extends);
        section.pop_back();
        changes.push_back({section, "bypass_closes_at", number(now), number(before),
                           fit.machine.bypass_closes_at.deviation, axis});
      }
    }
  }
}

Changes changes_of(const ExcavatorProfile& was, const JudgedFit& fit) {
  Changes changes;
  const ExcavatorProfile& is = fit.profile;
  for (std::size_t j = 0; j < static_cast<std::size_t>(is.pump_count); ++j) {
    const double before = was.pump[j].displacement_m3prev;
    if (is.pump[j].displacement_m3prev != before) {
      changes.push_back({fmt::format("pump[{}]", j), "displacement",
                         number(is.pump[j].displacement_m3prev), number(before),
                         before * fit.machine.pump_flow_factor[j].deviation});
    }
  }
  for (int axis = 0; axis < was.drive_count; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const auto before = areas_m2(was.valve.spool[k]);
    const auto now = areas_m2(is.valve.spool[k]);
    if (now != before) {
      changes.push_back({"valve", machines::kDriveNames[k], numbers(now), numbers(before),
                         area_deviation_m2(fit.machine.drive[k], was.valve.spool[k]), axis});
    }
  }
  for (int axis = 0; axis < was.drive_count; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    for (const bool extends : {true, false}) {
      change_side(axis, extends, was.valve.answer[k].side(extends),
                  is.valve.answer[k].side(extends), fit.machine.drive[k], changes);
    }
  }
  if (is.swing.inertia_kgm2 != was.swing.inertia_kgm2) {
    changes.push_back({"swing", "inertia", number(is.swing.inertia_kgm2),
                       number(was.swing.inertia_kgm2), fit.machine.swing.inertia_kgm2.deviation});
  }
  change_regulators(was, fit, changes);
  change_control(was.control, is.control, changes);
  if (is.safety.settle_s != was.safety.settle_s) {
    changes.push_back({"safety", "settle", number(is.safety.settle_s), number(was.safety.settle_s),
                       std::nullopt});
  }
  change_zeros("stroke_zero", was.sensor_zero.stroke_m, is.sensor_zero.stroke_m, fit.machine,
               &DriveEstimate::stroke_zero_m, changes);
  change_zeros("cap_zero", was.sensor_zero.cap_pa, is.sensor_zero.cap_pa, fit.machine,
               &DriveEstimate::cap_zero_pa, changes);
  change_zeros("rod_zero", was.sensor_zero.rod_pa, is.sensor_zero.rod_pa, fit.machine,
               &DriveEstimate::rod_zero_pa, changes);
  return changes;
}

std::string comment_of(const Change& change, const JudgedFit& fit, const std::string& from) {
  std::string text = change.deviation ? fmt::format("deviation {:.2g}; ", *change.deviation) : "";
  text += from;
  if (change.axis >= 0) {
    const AxisScore& left = fit.left_out.axis[static_cast<std::size_t>(change.axis)];
    text += fmt::format("; speed left out predicted within {:.1f} %, RMS", 100.0 * left.share());
  }
  return text;
}

bool close(double one, double other) {
  return std::abs(one - other) <= kRounding * std::max(std::abs(one), std::abs(other)) + 1e-15;
}

bool close(const DutyTable& one, const DutyTable& other) {
  bool same = one.size() == other.size();
  for (int at = 0; same && at < one.size(); ++at) {
    same = close(one.x(at), other.x(at)) && close(one.y(at), other.y(at));
  }
  return same;
}

template <class Numbers>
bool all_close(const Numbers& one, const Numbers& other) {
  return std::equal(one.begin(), one.end(), other.begin(),
                    [](double a, double b) { return close(a, b); });
}

}  // namespace

std::string identified_text(const std::string& old_text, const machines::ExcavatorMachine& old,
                            const JudgedFit& fit, const std::string& from) {
  ProfileText text(old_text);
  const Changes changes = changes_of(old.profile, fit);
  for (const Change& change : changes) {
    text.set(change.section, change.key, change.value, comment_of(change, fit, from));
  }
  for (const Change& change : changes) {
    const std::string deviation =
        change.deviation ? fmt::format("deviation = {}, ", number(*change.deviation)) : "";
    text.set("provenance", change.path(),
             fmt::format("{{ {}from = {} }}", deviation, toml_quoted(from)));
  }
  return text.text();
}

std::vector<ValueChange> value_changes(const machines::ExcavatorMachine& old,
                                       const JudgedFit& fit) {
  std::vector<ValueChange> all;
  for (const Change& change : changes_of(old.profile, fit)) {
    all.push_back({change.path(), change.before, change.value,
                   change.deviation ? fmt::format("{:.2g}", *change.deviation) : ""});
  }
  return all;
}

std::string first_difference(const ExcavatorProfile& one, const ExcavatorProfile& other) {
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    if (!close(one.pump[j].displacement_m3prev, other.pump[j].displacement_m3prev)) {
      return fmt::format("pump[{}].displacement", j);
    }
    const PumpRegulator& a = one.pump[j].regulator;
    const PumpRegulator& b = other.pump[j].regulator;
    if (!close(a.full_swash_pa, b.full_swash_pa) || !close(a.least_swash_pa, b.least_swash_pa)) {
      return fmt::format("pump[{}].negative_flow.pressure", j);
    }
  }
  for (int axis = 0; axis < one.drive_count; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    if (!all_close(areas_m2(one.valve.spool[k]), areas_m2(other.valve.spool[k]))) {
      return fmt::format("valve.{}", machines::kDriveNames[k]);
    }
    for (const bool extends : {true, false}) {
      if (!close(one.valve.spool[k].bypass_closes_at.side(extends),
                 other.valve.spool[k].bypass_closes_at.side(extends))) {
        return machines::answer_key(axis, extends) + "bypass_closes_at";
      }
      const SaidAnswer& a = one.valve.answer[k].side(extends);
      const SaidAnswer& b = other.valve.answer[k].side(extends);
      if (!close(a.spool_to_duty, b.spool_to_duty) || !close(a.dead_time_s, b.dead_time_s) ||
          !close(a.lag_s, b.lag_s) || !close(a.spool_time_constant_s, b.spool_time_constant_s)) {
        return machines::answer_key(axis, extends) + "*";
      }
    }
  }
  if (!close(one.swing.inertia_kgm2, other.swing.inertia_kgm2)) {
    return "swing.inertia";
  }
  for (const ControlValue& each : kControlValues) {
    if (!close(one.control.*each.value, other.control.*each.value)) {
      return fmt::format("control.{}", each.key);
    }
  }
  if (one.control.law != other.control.law) {
    return "control.law";
  }
  const SensorZeros& a = one.sensor_zero;
  const SensorZeros& b = other.sensor_zero;
  const bool zeros = all_close(a.stroke_m, b.stroke_m) && all_close(a.cap_pa, b.cap_pa) &&
                     all_close(a.rod_pa, b.rod_pa);
  if (!zeros) {
    return "sensors";
  }
  return close(one.safety.settle_s, other.safety.settle_s) ? "" : "safety.settle";
}

void assert_reads_back(const std::string& text, const std::filesystem::path& file,
                       const ExcavatorProfile& wanted) {
  std::string wrong;
  try {
    const machines::ProfileDocument document =
        machines::laid_over_base({file, toml::parse(text, file.string())});
    wrong = first_difference(machines::load_excavator(document).profile, wanted);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format(
        "what was found does not make a profile, so none was written: {}", error.what()));
  }
  if (!wrong.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: has no place in this profile's text; give it a section of its own", wrong));
  }
}

}  // namespace graben::identify
