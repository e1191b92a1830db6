// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/results.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace graben::faults {
namespace {

constexpr const char* kOr = " | ";

std::vector<std::string> alternatives(const std::string& expected) {
  std::vector<std::string> found;
  std::size_t from = 0;
  for (std::size_t at = 0; at != std::string::npos; from = at + std::string(kOr).size()) {
    at = expected.find(kOr, from);
    found.push_back(expected.substr(from, at - from));
    if (at == std::string::npos) {
      break;
    }
  }
  return found;
}

std::string milliseconds(TimeUs time_us) {
  return time_us < 0 ? "-" : fmt::format("{}", time_us / kMillisecondUs);
}

std::string percent(double share) {
  return share < 0.0 ? "-" : fmt::format("{:.2f}", 100.0 * share);
}

std::string numbers(const FaultSet& codes) {
  std::string text;
  for (Fault fault = codes.first(); fault != Fault::kNone; fault = codes.after(fault)) {
    text += fmt::format("{}{}", text.empty() ? "" : " ", static_cast<int>(fault));
  }
  return text.empty() ? "-" : text;
}

/// Characters, not bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

}  // namespace

void RowResult::add(std::uint64_t seed, Outcome outcome) {
  const std::vector<std::string> allowed = alternatives(row_.expected);
  if (std::find(allowed.begin(), allowed.end(), outcome.seen) == allowed.end()) {
    outcome.failures.push_back(fmt::format("saw '{}', expected '{}'", outcome.seen, row_.expected));
  }
  ++seen_[outcome.seen.empty() ? "none" : outcome.seen];
  worst_.codes.add(outcome.codes);
  worst_.to_detection_us = std::max(worst_.to_detection_us, outcome.to_detection_us);
  worst_.detection_to_neutral_us =
      std::max(worst_.detection_to_neutral_us, outcome.detection_to_neutral_us);
  worst_.to_neutral_us = std::max(worst_.to_neutral_us, outcome.to_neutral_us);
  worst_.by_valve = worst_.by_valve || outcome.by_valve;
  worst_.beyond_share = std::max(worst_.beyond_share, outcome.beyond_share);
  worst_.creep_share = std::max(worst_.creep_share, outcome.creep_share);
  worst_.rest_us = std::max(worst_.rest_us, outcome.rest_us);
  worst_.rolled_m = std::max(worst_.rolled_m, outcome.rolled_m);
  if (outcome.harm > worst_.harm) {
    worst_.harm = outcome.harm;
    worst_.harm_unit = outcome.harm_unit;
  }
  for (const std::string& failure : outcome.failures) {
    failures_.push_back(fmt::format("row {}, seed {}: {}", row_.number, seed, failure));
  }
}

std::vector<std::string> RowResult::cells() const {
  std::string seen;
  for (const auto& [reaction, count] : seen_) {
    seen += fmt::format("{}{} x{}", seen.empty() ? "" : ", ", reaction, count);
  }
  if (!row_.is_tried) {
    seen = "not tried";
  }
  const char* valve = worst_.by_valve ? " v" : "";
  return {fmt::format("{}", row_.number),
          row_.fault,
          row_.expected,
          seen,
          numbers(worst_.codes),
          milliseconds(worst_.to_detection_us),
          milliseconds(worst_.detection_to_neutral_us) + valve,
          milliseconds(worst_.to_neutral_us) + valve,
          percent(worst_.beyond_share),
          percent(worst_.creep_share),
          milliseconds(worst_.rest_us),
          worst_.rolled_m < 0.0 ? "-" : fmt::format("{:.2f}", worst_.rolled_m),
          worst_.harm < 0.0 ? "-" : fmt::format("{:.3g} {}", worst_.harm, worst_.harm_unit)};
}

void print_table(const std::vector<RowResult>& results) {
  std::vector<std::vector<std::string>> lines = {
      {"#", "fault", "expected", "seen", "codes", "to detection", "to neutral", "in all", "beyond",
       "creep", "to rest", "rolled", "harm"},
      {"", "", "", "", "", "ms", "ms", "ms", "% stroke", "% stroke", "ms", "m", ""}};
  for (const RowResult& result : results) {
    lines.push_back(result.cells());
  }
  std::vector<std::size_t> widths(lines[0].size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      widths[i] = std::max(widths[i], width(line[i]));
    }
  }
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      fmt::print("{}{}", line[i], std::string(widths[i] - width(line[i]) + 2, ' '));
    }
    fmt::print("\n");
  }
  fmt::print(
      "N neutral, L latched, D goes on slower, W goes on and warns, I ignored and counted; worst "
      "of all seeds. 'to "
      "neutral' from detection,\n'in all' from the first wrong thing (in silence from the last "
      "right frame); v: the bus carried no frame of the\ncontroller's, the valve side closed by "
      "its own 100 ms. 'beyond': what closing the spools allows, 'creep': after it.\n"
      "'to rest', 'rolled': of a machine that drives, from neutral until its tracks stand. 'harm': "
      "how far the "
      "machine or its tool came,\ntruly, from where it should be until it was stopped or "
      "slowed.\n");
}

}  // namespace graben::faults
