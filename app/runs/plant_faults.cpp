// SPDX-License-Identifier: Apache-2.0
#include "app/runs/plant_faults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "app/machines/near_word.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::runs {
namespace {

using Excavator = plant::ExcavatorFaults;
using Dozer = plant::DozerFaults;

constexpr std::array<const char*, kAxisCount> kAxes = {"boom", "arm", "bucket"};
constexpr std::array<const char*, kTrackCount> kTracks = {"left", "right"};
constexpr double kMostSeconds = 86400.0;
constexpr std::uint32_t kFaultMarkId = 0x7F0;

double& step_of(plant::StrokeFault& fault) { return fault.jump_m; }
double& step_of(plant::AngleFault& fault) { return fault.jump_rad; }
double& step_of(plant::ReadingFault& fault) { return fault.jump; }
double& drift_of(plant::StrokeFault& fault) { return fault.drift_mps; }
double& drift_of(plant::AngleFault& fault) { return fault.drift_radps; }
double& drift_of(plant::ReadingFault& fault) { return fault.drift_ps; }

/// What a sensor can do: freeze, with noise so high or without; step; drift; show so many times
/// what its reading changes, from where it is or from 0 on; show each second what is older by so
/// many seconds.
template <class Faults, class Find>
void add_sensor(const std::string& name, const Find& find, PlantFaultTable<Faults>& table) {
  table[name + ":frozen"] = [find](Faults& faults, double) { find(faults).stuck = true; };
  table[name + ":step"] = [find](Faults& faults, double value) { step_of(find(faults)) = value; };
  table[name + ":drift"] = [find](Faults& faults, double value) { drift_of(find(faults)) = value; };
  table[name + ":noisy"] = [find](Faults& faults, double value) {
    find(faults).stuck = true;
    find(faults).lie.noise = value;
  };
  table[name + ":gain"] = [find](Faults& faults, double value) { find(faults).lie.gain = value; };
  table[name + ":later"] = [find](Faults& faults, double value) { find(faults).lie.later = value; };
  table[name + ":scale"] = [find](Faults& faults, double value) {
    find(faults).lie.gain = value;
    find(faults).lie.from_zero = true;
  };
}

/// Held where it is told, or open by so much beyond its command.
template <class Faults, class Find>
void add_spool(const std::string& name, const Find& find, PlantFaultTable<Faults>& table) {
  table[name + "-spool:held"] = [find](Faults& faults, double value) {
    find(faults).spool_held_ratio = value;
  };
  table[name + ":reversed"] = [find](Faults& faults, double) { find(faults).reversed = true; };
  table[name + "-spool:offset"] = [find](Faults& faults, double value) {
    find(faults).spool_offset_ratio = value;
  };
}

template <class Find>
void add_pressure(const std::string& name, const Find& find, PlantFaultTable<Excavator>& table) {
  table[name + ":frozen"] = [find](Excavator& faults, double) { find(faults).stuck = true; };
  table[name + ":scale"] = [find](Excavator& faults, double value) { find(faults).scale = value; };
  table[name + ":reads"] = [find](Excavator& faults, double value) {
    find(faults).rail_pa = value;
  };
}

/// Source 1, whose word holds for 0.25 s.
template <class Faults>
void says(Faults& faults, ExternalLevel level, bool resumes, double share) {
  faults.set_silent(dbc::excavator::ExternalLimit::kId, false);
  faults.external = ExternalWord{level, resumes, 1, share, 0.25};
}

/// Those of every machine.
template <class Faults>
PlantFaultTable<Faults> common() {
  return {
      {"outside:free",
       [](Faults& faults, double) { says(faults, ExternalLevel::kFree, false, 1.0); }},
      {"outside:slow",
       [](Faults& faults, double value) { says(faults, ExternalLevel::kSlow, false, value); }},
      {"outside:stop",
       [](Faults& faults, double) { says(faults, ExternalLevel::kStop, false, 0.0); }},
      {"outside:pause",
       [](Faults& faults, double) { says(faults, ExternalLevel::kStop, true, 0.0); }},
      {"outside:silent",
       [](Faults& faults, double) { faults.set_silent(dbc::excavator::ExternalLimit::kId, true); }},
      {"engine:runs", [](Faults& faults, double value) { faults.engine_ratio = value; }},
      {"engine-speed:frozen", [](Faults& faults, double) { faults.engine_speed.stuck = true; }},
      {"engine-speed:by-turns", [](Faults& faults, double value) {
         faults.engine_speed_turns_us = static_cast<TimeUs>(std::llround(value * 1e6));
       }}};
}

/// The plugs of two strokes' sensors.
void add_swapped(unsigned one, unsigned other, PlantFaultTable<Excavator>& table) {
  table[fmt::format("{}-{}-strokes:swapped", kAxes[one], kAxes[other])] =
      [one, other](Excavator& faults, double) {
        std::swap(faults.stroke_from[one], faults.stroke_from[other]);
      };
}

PlantFaultTable<Excavator> make_excavator() {
  PlantFaultTable<Excavator> table = common<Excavator>();
  for (unsigned i = 0; i < kAxisCount; ++i) {
    for (unsigned j = i + 1; j < kAxisCount; ++j) {
      add_swapped(i, j, table);
    }
  }
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const std::string name = kAxes[i];
    const auto axis = [i](Excavator& faults) -> plant::AxisFaults& { return faults.axis[i]; };
    add_sensor(
        name + "-stroke", [i](Excavator & faults) -> auto& { return faults.axis[i].stroke; },
        table);
    add_sensor(
        name + "-second", [i](Excavator & faults) -> auto& { return faults.axis[i].second; },
        table);
    add_spool(name, axis, table);
    table[name + "-pressures:swapped"] = [i](Excavator& faults, double) {
      faults.axis[i].pressures_swapped = true;
    };
    add_pressure(
        name + "-cap-pressure", [i](Excavator & faults) -> auto& { return faults.axis[i].cap; },
        table);
    add_pressure(
        name + "-rod-pressure", [i](Excavator & faults) -> auto& { return faults.axis[i].rod; },
        table);
  }
  add_sensor(
      "swing-angle", [](Excavator & faults) -> auto& { return faults.swing.angle; }, table);
  add_sensor(
      "swing-second", [](Excavator & faults) -> auto& { return faults.swing.second; }, table);
  table["second-sensors:silent"] = [](Excavator& faults, double) {
    faults.set_silent(dbc::excavator::SecondStrokes::kId, true);
    faults.set_silent(dbc::excavator::SecondSwing::kId, true);
  };
  table["valve-state:silent"] = [](Excavator& faults, double) {
    faults.set_silent(dbc::excavator::ValveState::kId, true);
  };
  add_spool(
      "swing", [](Excavator & faults) -> auto& { return faults.swing; }, table);
  for (unsigned j = 0; j < kPumpCount; ++j) {
    table[fmt::format("pump{}-swash:reads", j + 1)] = [j](Excavator& faults, double value) {
      faults.pump[j].shown_swash_ratio = value;
    };
    table[fmt::format("pump{}-swash:goes", j + 1)] = [j](Excavator& faults, double value) {
      faults.pump[j].actual_swash_ratio = value;
    };
  }
  return table;
}

/// Of a dozer whose blade tilts, and of one on a design whose track curves.
void add_tilt(PlantFaultTable<Dozer>& table) {
  add_sensor(
      "tilt-stroke", [](Dozer & faults) -> auto& { return faults.tilt_stroke; }, table);
  table["tilt-spool:held"] = [](Dozer& faults, double value) {
    faults.tilt_spool_held_ratio = value;
  };
  add_sensor(
      "roll", [](Dozer & faults) -> auto& { return faults.pose.roll; }, table);
  add_sensor(
      "roll-rate", [](Dozer & faults) -> auto& { return faults.pose.roll_rate; }, table);
  add_sensor(
      "offset", [](Dozer & faults) -> auto& { return faults.pose.offset; }, table);
  add_sensor(
      "heading", [](Dozer & faults) -> auto& { return faults.pose.heading; }, table);
  add_sensor(
      "yaw-rate", [](Dozer & faults) -> auto& { return faults.pose.yaw_rate; }, table);
}

PlantFaultTable<Dozer> make_dozer() {
  PlantFaultTable<Dozer> table = common<Dozer>();
  add_sensor(
      "blade-stroke", [](Dozer & faults) -> auto& { return faults.stroke; }, table);
  add_spool(
      "blade", [](Dozer & faults) -> auto& { return faults; }, table);
  add_sensor(
      "position", [](Dozer & faults) -> auto& { return faults.pose.position; }, table);
  add_sensor(
      "height", [](Dozer & faults) -> auto& { return faults.pose.height; }, table);
  add_sensor(
      "pitch", [](Dozer & faults) -> auto& { return faults.pose.pitch; }, table);
  add_sensor(
      "velocity", [](Dozer & faults) -> auto& { return faults.pose.velocity; }, table);
  add_sensor(
      "climb", [](Dozer & faults) -> auto& { return faults.pose.climb; }, table);
  add_sensor(
      "pitch-rate", [](Dozer & faults) -> auto& { return faults.pose.pitch_rate; }, table);
  add_tilt(table);
  table["pose:frozen"] = [](Dozer& faults, double) {
    for (plant::ReadingFault* fault : faults.pose.all()) {
      fault->stuck = true;
    }
  };
  table["pose:later"] = [](Dozer& faults, double value) { faults.pose.later_ps = value; };
  table["pumps:stay"] = [](Dozer& faults, double) { faults.pumps_stay = true; };
  table["pump-feedback:echoes"] = [](Dozer& faults, double) { faults.pump_feedback_echoes = true; };
  table["pump-feedback:frozen"] = [](Dozer& faults, double) { faults.pump_feedback_stuck = true; };
  for (unsigned i = 0; i < kTrackCount; ++i) {
    add_sensor(
        fmt::format("{}-track-speed", kTracks[i]),
        [i](Dozer & faults) -> auto& { return faults.path[i].speed; }, table);
    table[fmt::format("{}-track-speed:reads", kTracks[i])] = [i](Dozer& faults, double value) {
      faults.path[i].speed.reads = value;
    };
    table[fmt::format("{}-pump:reads", kTracks[i])] = [i](Dozer& faults, double value) {
      faults.path[i].shown_pump_ratio = value;
    };
  }
  return table;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw std::runtime_error(
      fmt::format("--fault: '{}': {}; the form is NAME@SECONDS or NAME=VALUE@SECONDS", text, why));
}

double number_of(const std::string& text, const std::string& part, const char* what) {
  std::size_t end = 0;
  double value = 0.0;
  try {
    value = std::stod(part, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  if (part.empty() || end != part.size() || !std::isfinite(value)) {
    refuse(text, fmt::format("'{}' is no {}", part, what));
  }
  return value;
}

template <class Faults>
std::vector<std::string> names_of(const PlantFaultTable<Faults>& table) {
  std::vector<std::string> names;
  names.reserve(table.size());
  for (const auto& [name, set] : table) {
    names.push_back(name);
  }
  return names;
}

}  // namespace

const PlantFaultTable<Excavator>& excavator_plant_faults() {
  static const PlantFaultTable<Excavator> table = make_excavator();
  return table;
}

const PlantFaultTable<Dozer>& dozer_plant_faults() {
  static const PlantFaultTable<Dozer> table = make_dozer();
  return table;
}

ToldFault told_fault(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos) {
    refuse(text, "no time");
  }
  ToldFault told;
  const double at_s = number_of(text, text.substr(at + 1), "time in seconds");
  if (at_s < 0.0 || at_s > kMostSeconds) {
    refuse(text, fmt::format("a time from 0 to {:.0f} s", kMostSeconds));
  }
  told.at_us = static_cast<TimeUs>(std::llround(at_s * 1e6));
  const std::string what = text.substr(0, at);
  const std::size_t equals = what.find('=');
  told.name = what.substr(0, equals);
  if (equals != std::string::npos) {
    told.value = number_of(text, what.substr(equals + 1), "number");
  }
  return told;
}

template <class Faults>
PlantFaultSchedule<Faults>::PlantFaultSchedule(const PlantFaultTable<Faults>& table,
                                               const std::vector<std::string>& told)
    : table_(table) {
  for (const std::string& text : told) {
    const ToldFault fault = told_fault(text);
    if (table_.find(fault.name) == table_.end()) {
      const std::vector<std::string> names = names_of(table_);
      throw std::runtime_error(fmt::format("--fault: '{}' is unknown to this machine{}\nknown: {}",
                                           fault.name, machines::near_word_hint(fault.name, names),
                                           fmt::join(names, ", ")));
    }
    left_.push_back({fault, static_cast<std::uint8_t>(left_.size() + 1), text});
  }
  std::stable_sort(left_.begin(), left_.end(), [](const Planned& a, const Planned& b) {
    return a.fault.at_us < b.fault.at_us;
  });
  bool has_source = false;
  for (const Planned& planned : left_) {
    const ToldFault& fault = planned.fault;
    if (fault.name == "outside:slow" && !(fault.value > 0.0 && fault.value < 1.0)) {
      throw std::runtime_error(fmt::format(
          "--fault {}: allowed: a share of full speed, above 0 and below 1", planned.text));
    }
    // Silence of a source that never was there is none.
    if (fault.name == "outside:silent" && !has_source) {
      throw std::runtime_error(fmt::format(
          "--fault {}: no source was there before; outside:free@1 makes one", planned.text));
    }
    has_source = has_source || fault.name.rfind("outside:", 0) == 0;
  }
}

template <class Faults>
void PlantFaultSchedule<Faults>::apply(TimeUs now_us, Faults& faults, CanPort& port) {
  while (!left_.empty() && left_.front().fault.at_us <= now_us) {
    const Planned next = left_.front();
    left_.erase(left_.begin());
    table_.at(next.fault.name)(faults, next.fault.value);
    CanFrame mark;
    mark.id = kFaultMarkId;
    mark.extended = false;
    mark.length = 1;
    mark.data[0] = next.place;
    // The mark is for who reads the log: the fault is there without it.
    static_cast<void>(port.send(mark));
  }
}

template <class Faults>
std::vector<std::string> PlantFaultSchedule<Faults>::left() const {
  std::vector<std::string> texts;
  for (const Planned& planned : left_) {
    texts.push_back(planned.text);
  }
  return texts;
}

std::string told_faults_subtitle(const std::vector<std::string>& told) {
  return told.empty() ? "" : fmt::format(" | fault {}", fmt::join(told, ", "));
}

std::string told_faults_text(const std::vector<std::string>& told,
                             const std::vector<std::string>& left, double run_s, bool is_seen) {
  if (!left.empty()) {
    throw std::runtime_error(fmt::format("--fault {}: the run ended at {:.2f} s, before it came",
                                         fmt::join(left, ", "), run_s));
  }
  // A word from outside is none of the machine's faults: the limits have it, or the end.
  std::vector<std::string> unseen;
  std::copy_if(told.begin(), told.end(), std::back_inserter(unseen),
               [](const std::string& text) { return text.rfind("outside:", 0) != 0; });
  return unseen.empty() || is_seen
             ? ""
             : fmt::format(
                   "fault   {}: the controller did not see it; what it cost is in the "
                   "figures of the true machine\n",
                   fmt::join(unseen, ", "));
}

template class PlantFaultSchedule<plant::ExcavatorFaults>;
template class PlantFaultSchedule<plant::DozerFaults>;

}  // namespace graben::runs
