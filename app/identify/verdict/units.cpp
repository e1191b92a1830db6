// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace graben::identify {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// The value that is there most often, and its share.
std::pair<double, double> rest_of(const std::vector<double>& values) {
  std::map<double, std::size_t> counts;
  for (const double value : values) {
    ++counts[value];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return {most->first, static_cast<double>(most->second) / static_cast<double>(values.size())};
}

double scale_of(Unit unit) {
  switch (unit) {
    case Unit::kRatio:
    case Unit::kRad:
    case Unit::kMetre:
      return 1.0;
    case Unit::kPercent:
    case Unit::kCentimetre:
      return 1e-2;
    case Unit::kPermille:
    case Unit::kMrad:
    case Unit::kMillimetre:
      return 1e-3;
    case Unit::kDegree:
      return kDegree;
    default:
      return 0.0;
  }
}

std::string instead(Unit named, const std::string& is, const std::string& why) {
  return named == Unit::kUnknown || named == Unit::kOther
             ? fmt::format("{}, guessed", is)
             : fmt::format("{}, though it says {}: {}", is, unit_text(named), why);
}

}  // namespace

UnitGuess command_unit(const std::vector<double>& values, Unit named, bool one_sided) {
  constexpr double kRests = 0.15;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  UnitGuess guess;
  double centre = 0.0;
  if (*least > 0.0 && !one_sided && values.size() > 1) {
    const auto [rest, share] = rest_of(values);
    const double place = *most > *least ? (rest - *least) / (*most - *least) : 0.0;
    if (share > kRests && place > 0.2 && place < 0.8) {
      centre = rest;
    }
  }
  const double largest = std::max(std::abs(*least - centre), std::abs(*most - centre));
  const auto full = [&](Unit unit, double whole) {
    guess.scale = scale_of(unit);
    guess.said = unit == named
                     ? fmt::format("{} by its name", unit_text(unit))
                     : instead(named, unit_text(unit),
                               fmt::format("its largest is {:g} of {:g}", largest, whole));
  };
  if (centre != 0.0 || largest > 1000.5) {
    guess.scale = largest > 0.0 ? 1.0 / largest : 1.0;
    guess.said = centre != 0.0 ? fmt::format("parts of {:g} about {:g}, where it rests, guessed",
                                             largest, centre)
                               : fmt::format("parts of its largest, {:g}, guessed", largest);
  } else if (named == Unit::kOther) {
    guess.scale = largest > 0.0 ? 1.0 / largest : 1.0;
    guess.said = fmt::format("parts of its largest, {:g}", largest);
  } else if (largest <= 1.02 && (named != Unit::kPermille || largest > 0.0) &&
             (named != Unit::kPercent || largest > 0.0)) {
    full(Unit::kRatio, 1.0);
  } else if (named == Unit::kPermille) {
    full(Unit::kPermille, 1000.0);
  } else if (largest <= 100.5) {
    full(Unit::kPercent, 100.0);
  } else {
    full(Unit::kPermille, 1000.0);
  }
  guess.offset = -centre * guess.scale;
  return guess;
}

UnitGuess position_unit(const std::vector<double>& values, Unit named, bool length, bool turns) {
  // A link of an excavator turns by less than a full turn; a swing may count several.
  const double widest_rad = turns ? 60.0 : 6.4;
  constexpr double kWidest_m = 4.0;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double span = *most - *least;
  UnitGuess guess;
  const double named_scale = scale_of(named);
  const double widest = length ? kWidest_m : widest_rad;
  const bool of_kind =
      length ? named == Unit::kMetre || named == Unit::kMillimetre || named == Unit::kCentimetre
             : named == Unit::kRad || named == Unit::kMrad || named == Unit::kDegree;
  if (of_kind && span * named_scale <= widest) {
    guess.scale = named_scale;
    guess.said = fmt::format("{} by its name", unit_text(named));
    return guess;
  }
  const std::string why = fmt::format("it goes over {:.4g}", span);
  if (length) {
    const Unit unit = span > kWidest_m ? Unit::kMillimetre : Unit::kMetre;
    guess.scale = scale_of(unit);
    guess.said = instead(named, unit_text(unit), why);
  } else {
    const bool wide =
        span > widest_rad || (turns && std::max(std::abs(*least), std::abs(*most)) > 60.0);
    const Unit unit =
        span * kDegree > widest_rad ? Unit::kMrad : (wide ? Unit::kDegree : Unit::kRad);
    guess.scale = scale_of(unit);
    guess.said = instead(named, unit_text(unit), why);
  }
  return guess;
}

}  // namespace graben::identify
