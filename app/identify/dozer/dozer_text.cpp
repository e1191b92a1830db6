// SPDX-License-Identifier: Apache-2.0
#include "app/identify/dozer/dozer_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/identify/file/profile_text.hpp"
#include "app/machines/profile_document.hpp"

namespace graben::identify {
namespace {

constexpr double kPerMille = 1e3;
/// Relative; a file has six digits.
constexpr double kSixDigits = 2e-5;

/// TOML takes a number without a point for a whole one.
std::string said(double value) {
  std::string text = fmt::format("{:.6g}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string said(const DutyTable& table) {
  std::vector<std::string> all;
  for (int at = 0; at < table.size(); ++at) {
    all.push_back(fmt::format("[{}, {}]", said(table.x(at)), said(kPerMille * table.y(at))));
  }
  return table.size() == 0 ? "" : fmt::format("[{}]", fmt::join(all, ", "));
}

std::string said_time(double value_s) { return value_s == kUnsaid_s ? "" : said(value_s); }

std::string brief(double value) { return fmt::format("{:.2g}", value); }

class Changing {
 public:
  void number(const char* section, const char* key, double before, double after,
              const std::string& deviation) {
    put(section, key, said(before), said(after), deviation);
  }
  void put(const std::string& section, const std::string& key, const std::string& before,
           const std::string& after, const std::string& deviation) {
    if (after != before) {
      all.push_back({section, key, before, after, deviation});
    }
  }

  std::vector<DozerChange> all;
};

void change_answers(const machines::DozerMachine& old, const DozerProfile& now,
                    const DozerEstimate& found, Changing& changes) {
  for (std::size_t drive = 0; drive < found.blade.size(); ++drive) {
    for (const bool extends : {true, false}) {
      const BladeSideEstimate& side = found.blade[drive].side(extends);
      if (!side.known()) {
        continue;
      }
      std::string section = machines::blade_answer_key(drive, extends);
      section.pop_back();
      const SaidAnswer& was = old.profile.answer[drive].side(extends);
      const SaidAnswer& is = now.answer[drive].side(extends);
      changes.put(section, "spool_to_duty", said(was.spool_to_duty), said(is.spool_to_duty),
                  fmt::format("{} per mille of the edge", brief(kPerMille * side.edge.deviation)));
      changes.put(section, "dead_time", said_time(was.dead_time_s), said(is.dead_time_s),
                  brief(side.dead_time_s.deviation));
      changes.put(section, "lag", said_time(was.lag_s), said(is.lag_s),
                  brief(side.lag_s.deviation));
      changes.put(section, "driven", "",
                  fmt::format("[{}, {}]", said(side.driven_least), said(side.driven_most)), "");
    }
  }
}

void change_travel(const machines::DozerMachine& old, const DozerProfile& now,
                   const TravelEstimate& travel, Changing& changes) {
  if (!travel.known()) {
    return;
  }
  const HstProfile& was = old.profile.hst;
  changes.number("hst", "pump_displacement", was.pump_m3prev, now.hst.pump_m3prev,
                 brief(was.pump_m3prev * travel.speed_factor().deviation));
  changes.number("hst", "pump_response", was.response_s, now.hst.response_s,
                 brief(travel.pump_lag_s.deviation));
  changes.put("hst", "driven", "",
              fmt::format("[{}, {}]", said(travel.driven_least), said(travel.driven_most)), "");
}

bool alike(double one, double other) {
  return std::abs(one - other) <= kSixDigits * std::max(std::abs(one), std::abs(other)) + 1e-15;
}

bool alike(const DutyTable& one, const DutyTable& other) {
  bool same = one.size() == other.size();
  for (int at = 0; same && at < one.size(); ++at) {
    same = alike(one.x(at), other.x(at)) && alike(one.y(at), other.y(at));
  }
  return same;
}

/// The first key that differs, or nothing.
std::string difference(const DozerProfile& one, const DozerProfile& other) {
  for (std::size_t drive = 0; drive < one.answer.size(); ++drive) {
    for (const bool extends : {true, false}) {
      const SaidAnswer& a = one.answer[drive].side(extends);
      const SaidAnswer& b = other.answer[drive].side(extends);
      if (!alike(a.spool_to_duty, b.spool_to_duty) || !alike(a.dead_time_s, b.dead_time_s) ||
          !alike(a.lag_s, b.lag_s)) {
        return machines::blade_answer_key(drive, extends) + "*";
      }
    }
  }
  struct Same {
    const char* key;
    double one;
    double other;
  };
  for (const Same& of :
       {Same{"implement.valve_flow_max", one.implement.valve_flow_max_m3ps,
             other.implement.valve_flow_max_m3ps},
        Same{"implement.pump.displacement", one.implement.displacement_m3prev,
             other.implement.displacement_m3prev},
        Same{"implement.dead_time", one.control.dead_time_s, other.control.dead_time_s},
        Same{"tilt.valve_flow_max", one.tilt.valve_flow_max_m3ps, other.tilt.valve_flow_max_m3ps},
        Same{"hst.pump_displacement", one.hst.pump_m3prev, other.hst.pump_m3prev},
        Same{"hst.pump_response", one.hst.response_s, other.hst.response_s},
        Same{"control.response", one.control.response_s, other.control.response_s},
        Same{"safety.settle", one.safety.settle_s, other.safety.settle_s}}) {
    if (!alike(of.one, of.other)) {
      return of.key;
    }
  }
  return "";
}

}  // namespace

std::vector<DozerChange> dozer_changes(const machines::DozerMachine& old,
                                       const DozerEstimate& found) {
  const DozerProfile& was = old.profile;
  const DozerProfile now = identified_dozer(was, found);
  const BladeDriveEstimate& lift = found.blade[0];
  Changing changes;
  changes.number("implement", "valve_flow_max", was.implement.valve_flow_max_m3ps,
                 now.implement.valve_flow_max_m3ps, brief(lift.valve_flow_m3ps.deviation));
  changes.number(
      "implement", "dead_time", was.control.dead_time_s, now.control.dead_time_s,
      brief(std::max(lift.extend.dead_time_s.deviation, lift.retract.dead_time_s.deviation)));
  changes.number("implement.pump", "displacement", was.implement.displacement_m3prev,
                 now.implement.displacement_m3prev,
                 brief(was.implement.displacement_m3prev * found.pump_flow_factor.deviation));
  if (was.tilt.present) {
    changes.number("tilt", "valve_flow_max", was.tilt.valve_flow_max_m3ps,
                   now.tilt.valve_flow_max_m3ps, brief(found.blade[1].valve_flow_m3ps.deviation));
  }
  change_travel(old, now, found.travel, changes);
  changes.number("control", "response", was.control.response_s, now.control.response_s,
                 brief(std::max(lift.extend.lag_s.deviation, lift.retract.lag_s.deviation)));
  changes.number("safety", "settle", was.safety.settle_s, now.safety.settle_s, "");
  change_answers(old, now, found, changes);
  return changes.all;
}

std::string identified_dozer_text(const std::string& old_text,
                                  const std::vector<DozerChange>& changes,
                                  const std::string& from) {
  ProfileText text(old_text);
  for (const DozerChange& change : changes) {
    const std::string deviation =
        change.deviation.empty() ? "" : fmt::format("deviation {}; ", change.deviation);
    text.set(change.section, change.key, change.after, deviation + from);
  }
  for (const DozerChange& change : changes) {
    const bool is_number =
        !change.deviation.empty() && change.deviation.find(' ') == std::string::npos;
    text.set(
        "provenance", change.path(),
        fmt::format(
            "{{ {}from = {} }}",
            is_number ? fmt::format("deviation = {}, ", said(std::stod(change.deviation))) : "",
            toml_quoted(from)));
  }
  return text.text();
}

void assert_dozer_reads_back(const std::string& text, const std::filesystem::path& file,
                             const DozerProfile& wanted) {
  std::string wrong;
  try {
    const machines::ProfileDocument document =
        machines::laid_over_base({file, toml::parse(text, file.string())});
    wrong = difference(machines::load_dozer(document).profile, wanted);
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
