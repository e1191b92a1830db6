// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/log_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "app/identify/machine/log_split.hpp"
#include "app/identify/machine/prediction_score.hpp"

namespace graben::identify {
namespace {

/// Farther outside its cylinder no stroke is, whatever its sensor's zero.
constexpr double kOutside_m = 0.06;
/// Slower than this an engine stands.
constexpr double kRuns_radps = 20.0;

[[noreturn]] void refuse(const MachineLog& log, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", log.name, what));
}

void assert_strokes(const MachineLog& log, const LogSegment& segment,
                    const ExcavatorProfile& profile) {
  for (std::size_t k = 0; k < kAxisCount; ++k) {
    const std::vector<double>& stroke_m = segment.axis[k].stroke_m;
    const double most_m = profile.geometry.cylinder[k].stroke_m;
    const auto outside = std::find_if(stroke_m.begin(), stroke_m.end(), [&](double value_m) {
      return !(value_m > -kOutside_m && value_m < most_m + kOutside_m);
    });
    if (outside != stroke_m.end()) {
      refuse(log, fmt::format(
                      "at {:.2f} s the {}'s stroke is {:.3f} m; the profile's cylinder has "
                      "0 .. {} m",
                      segment.begin_s + kGrid_s * static_cast<double>(outside - stroke_m.begin()),
                      kAxisTexts[k], *outside, most_m));
    }
  }
}

}  // namespace

void assert_same_machine(const MachineLog& log, const std::vector<std::uint32_t>& hashes) {
  const bool same = std::find(hashes.begin(), hashes.end(), log.profile_hash) != hashes.end();
  if (log.profile_hash != 0 && !same) {
    refuse(log, fmt::format("is of a machine with profile {:08x}, and this is {:08x}; with "
                            "--any-machine that may be",
                            log.profile_hash, hashes.front()));
  }
}

void assert_plausible(const MachineLog& log, const ExcavatorProfile& profile) {
  bool runs = false;
  for (const LogSegment& segment : log.segments) {
    assert_strokes(log, segment, profile);
    runs = runs || std::any_of(segment.engine_radps.begin(), segment.engine_radps.end(),
                               [](double speed_radps) { return speed_radps > kRuns_radps; });
  }
  if (!runs) {
    refuse(log, "the engine stands throughout");
  }
  if (moving_stretches({log}).empty()) {
    refuse(log, "no cylinder moves by its valve");
  }
}

std::vector<std::string> log_notes(const MachineLog& log) {
  std::vector<std::string> notes = {fmt::format("{:.1f} s", log.length_s())};
  for (std::size_t n = 1; n < log.segments.size(); ++n) {
    const LogSegment& before = log.segments[n - 1];
    const double end_s = before.begin_s + before.length_s();
    notes.push_back(fmt::format("a gap of {:.1f} s at {:.2f} s: taken as two pieces",
                                log.segments[n].begin_s - end_s, end_s));
  }
  if (log.refused > 0) {
    notes.push_back(fmt::format("{} of {} frames have a wrong checksum or length and were left out",
                                log.refused, log.frames));
  }
  if (log.profile_hash == 0) {
    notes.push_back("no MachineIdentity is in it: whose log it is, nobody knows");
  }
  if (!log.segments.front().senses_spools) {
    notes.push_back("spools are not measured: duties stand for them");
  }
  return notes;
}

}  // namespace graben::identify
