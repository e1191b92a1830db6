// SPDX-License-Identifier: Apache-2.0
#include "app/identify/drift/work_order.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

namespace graben::identify {
namespace {

constexpr double kBand = 1.96;

/// How a kind of figure is judged and said.
struct Kind {
  Wears what;
  const char* name;
  const char* unit;
  double scale;      ///< From SI to that unit.
  DayNoise noise;    ///< Of one log; what is said, against how ten simulated days scatter.
  double least;      ///< A smaller change is nobody's work.
  double share;      ///< Nor is one of a smaller share of what it was.
  const char* more;  ///< What a growing figure is called, and what a falling one,
  const char* less;
  const char* advice;  ///< and what to do about it.
};

constexpr std::array<Kind, 6> kKinds = {
    Kind{Wears::kDeadBand,
         "dead band's edge",
         "%",
         1e2,
         {0.0015, 0.25},
         0.008,
         0.0,
         "begins later, by",
         "begins earlier, by",
         "look at the pilot pressure, the pilot valve and the spool's springs"},
    Kind{Wears::kCreep,
         "leakage, closed",
         "um/(s MPa)",
         1e12,
         {5e-14, 0.5},
         2e-13,
         0.35,
         "leakage (it creeps while closed)",
         "leakage (it creeps while closed)",
         "look at the piston's seal and the port's relief"},
    Kind{Wears::kFriction,
         "friction",
         "kN",
         1e-3,
         {200.0, 1.0},
         500.0,
         0.25,
         "friction",
         "friction",
         "look at pins, bushings and grease"},
    Kind{Wears::kPumpFlow,
         "flow, of the profile's",
         "%",
         1e2,
         {0.004, 0.25},
         0.018,
         0.0,
         "more flow, by",
         "less flow, by",
         "look at the pump, its regulator and the engine's speed"},
    Kind{Wears::kStrokeZero,
         "stroke's zero",
         "mm",
         1e3,
         {3e-4, 0.25},
         2e-3,
         0.0,
         "its stroke sensor shows more, by",
         "its stroke sensor shows less, by",
         "look at its mounting, then measure its zero anew"},
    Kind{Wears::kPressureZero,
         "pressure's zero",
         "MPa",
         1e-6,
         {1e5, 0.5},
         6e5,
         0.0,
         "its sensor shows more, by",
         "its sensor shows less, by",
         "look at the sensor and its wiring"},
};

const Kind& kind_of(Wears what) { return kKinds[static_cast<std::size_t>(what)]; }

bool is_beyond(const Kind& kind, const Trend& trend, std::size_t logs) {
  const double change = std::abs(trend.change());
  return trend.is_beyond_noise(logs) && change > kind.least &&
         change > kind.share * std::abs(trend.first);
}

void follow(const Kind& kind, FigureDrift& drift) {
  std::vector<DayValue> until;
  for (const DayValue& value : drift.values) {
    until.push_back(value);
    drift.trend = trend_of(until, kind.noise);
    drift.is_beyond = is_beyond(kind, drift.trend, until.size());
    if (drift.is_beyond && !drift.first_beyond_s) {
      drift.first_beyond_s = value.time_s;
    }
  }
}

}  // namespace

std::string day_text(double time_s) {
  const std::tm day = fmt::gmtime(static_cast<std::time_t>(std::floor(time_s)));
  return fmt::format("{} {:%B %Y}", day.tm_mday, day);
}

std::vector<FigureDrift> drifts_of(const std::vector<DayFigures>& days) {
  std::vector<FigureDrift> drifts;
  for (std::size_t at = 0; !days.empty() && at < days.front().figures.size(); ++at) {
    FigureDrift drift;
    drift.what = days.front().figures[at].what;
    drift.part = days.front().figures[at].part;
    for (const DayFigures& day : days) {
      const Estimate& value = day.figures[at].value;
      if (value.known && std::isfinite(value.value)) {
        drift.values.push_back({day.time_s, value.value, value.deviation});
      }
    }
    follow(kind_of(drift.what), drift);
    drifts.push_back(std::move(drift));
  }
  return drifts;
}

std::vector<std::string> work_orders(const std::vector<FigureDrift>& drifts) {
  std::vector<std::string> orders;
  for (const FigureDrift& drift : drifts) {
    if (!drift.is_beyond) {
      continue;
    }
    const Kind& kind = kind_of(drift.what);
    const Trend& trend = drift.trend;
    const std::string begin = day_text(drift.values.front().time_s);
    const bool is_ratio = kind.share > 0.0 && trend.first > kBand * trend.noise();
    const std::string how =
        is_ratio ? fmt::format("{} {:.1f} times (+- {:.1f}) that of {}", kind.more,
                               trend.last / trend.first, kBand * trend.noise() / trend.first, begin)
                 : fmt::format("{} {:.1f} {} (+- {:.1f}) since {}",
                               trend.change() > 0.0 ? kind.more : kind.less,
                               std::abs(kind.scale * trend.change()), kind.unit,
                               kBand * kind.scale * trend.noise(), begin);
    orders.push_back(fmt::format("{}: {}; beyond its noise from {} on: {}", drift.part, how,
                                 day_text(*drift.first_beyond_s), kind.advice));
  }
  return orders;
}

std::string drift_table(const std::vector<FigureDrift>& drifts) {
  std::string text =
      fmt::format("{:<18} {:<23} {:>10}  {:>4}  {:>9}  {:>9}  {:>9}  {:>5}\n", "part", "figure", "",
                  "logs", "first day", "last day", "change", "noise");
  for (const FigureDrift& drift : drifts) {
    const Kind& kind = kind_of(drift.what);
    const Trend& trend = drift.trend;
    text += fmt::format("{:<18} {:<23} {:>10}  {:>4}", drift.part, kind.name, kind.unit,
                        drift.values.size());
    text += trend.known ? fmt::format("  {:>9.3f}  {:>9.3f}  {:>+9.3f}  {:>5.3f}{}\n",
                                      kind.scale * trend.first, kind.scale * trend.last,
                                      kind.scale * trend.change(), kind.scale * trend.noise(),
                                      drift.is_beyond ? "  beyond" : "")
                        : std::string("  too few logs say it\n");
  }
  return text;
}

std::string drift_json(const std::vector<DayFigures>& days,
                       const std::vector<FigureDrift>& drifts) {
  nlohmann::ordered_json json;
  json["logs"] = nlohmann::ordered_json::array();
  for (const DayFigures& day : days) {
    json["logs"].push_back({{"log", day.log}, {"time_s", day.time_s}});
  }
  json["figures"] = nlohmann::ordered_json::array();
  for (const FigureDrift& drift : drifts) {
    nlohmann::ordered_json of;
    of["part"] = drift.part;
    of["figure"] = kind_of(drift.what).name;
    for (const DayValue& value : drift.values) {
      of["values"].push_back(
          {{"time_s", value.time_s},
           {"value", value.value},
           {"deviation", std::isfinite(value.deviation) ? nlohmann::json(value.deviation)
                                                        : nlohmann::json(nullptr)}});
    }
    of["known"] = drift.trend.known;
    if (drift.trend.known) {
      of["first"] = drift.trend.first;
      of["last"] = drift.trend.last;
      of["said_noise"] = drift.trend.said_noise;
      of["seen_noise"] = drift.trend.seen_noise;
    }
    of["beyond"] = drift.is_beyond;
    of["first_beyond_s"] = drift.first_beyond_s ? nlohmann::ordered_json(*drift.first_beyond_s)
                                                : nlohmann::ordered_json(nullptr);
    json["figures"].push_back(std::move(of));
  }
  json["work_orders"] = work_orders(drifts);
  return json.dump(2) + "\n";
}

}  // namespace graben::identify
