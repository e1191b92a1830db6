// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/velocity_cap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graben {
namespace {

struct Priority {
  LimitKind kind;
  int rank;  ///< The lowest is reported.
};

/// Rank of no limit. [-; derived: one after the last rank below]
constexpr int kLastRank = 5;
constexpr std::array<Priority, kLimitKindCount> kPriorities = {{{LimitKind::kNone, kLastRank},
                                                                {LimitKind::kPumpFlow, 0},
                                                                {LimitKind::kBackFlow, 0},
                                                                {LimitKind::kSpoolTravel, 0},
                                                                {LimitKind::kStrokeEnd, 1},
                                                                {LimitKind::kRise, 3},
                                                                {LimitKind::kDegraded, 4},
                                                                {LimitKind::kImplementFlow, 2},
                                                                {LimitKind::kTransmissionFlow, 2},
                                                                {LimitKind::kAhead, 2},
                                                                {LimitKind::kOffGrade, 2},
                                                                {LimitKind::kSwingEnd, 1},
                                                                {LimitKind::kFence, 1},
                                                                {LimitKind::kOffPath, 2},
                                                                {LimitKind::kExternalLimit, 0}}};

constexpr bool rows_are_in_order() {
  for (std::size_t i = 0; i < kPriorities.size(); ++i) {
    if (static_cast<std::size_t>(kPriorities[i].kind) != i) {
      return false;
    }
  }
  return true;
}
static_assert(rows_are_in_order());

int rank_of(LimitKind kind) { return kPriorities[static_cast<std::size_t>(kind)].rank; }

}  // namespace

void approach(double gain_ps, double deceleration, double distance, double closing, Limit limit,
              VelocityCap& cap) {
  if (closing <= kStandsStill) {
    return;
  }
  const double left = std::max(0.0, distance);
  cap.tighten(closing, std::min(gain_ps * left, std::sqrt(2.0 * deceleration * left)), limit);
}

double end_speed_mps(const DriveRow& drive, double stroke_m, double velocity_mps) {
  const double left_m =
      velocity_mps > 0.0 ? drive.most_travel_m - stroke_m : stroke_m - drive.least_travel_m;
  return drive.control.stroke_end_gain_ps * std::max(0.0, left_m);
}

void slow_at_ends(DriveRows drives, Span<const ValidDrive> seen, Span<const double> velocity_mps,
                  VelocityCap& cap) {
  for (int i = 0; i < drives.count(); ++i) {
    const double velocity = velocity_mps[i];
    cap.tighten(std::abs(velocity), end_speed_mps(drives[i], seen[i].stroke_m, velocity),
                drives[i].control.at_end);
  }
}

void approach_ends(DriveRows drives, Span<const double> then_m, Span<const double> velocity_mps,
                   VelocityCap& cap) {
  for (int i = 0; i < drives.count(); ++i) {
    const DriveRow& drive = drives[i];
    const double velocity = velocity_mps[i];
    const double left_m = velocity > 0.0
                              ? drive.most_travel_m + drive.control.end_slack_m - then_m[i]
                              : then_m[i] - (drive.least_travel_m - drive.control.end_slack_m);
    approach(drive.control.stroke_end_gain_ps, drive.control.deceleration_mps2, left_m,
             std::abs(velocity), drive.control.at_end, cap);
  }
}

Limit held_by(std::initializer_list<Limit> limits) {
  Limit held;
  for (const Limit& limit : limits) {
    if (rank_of(limit.kind) < rank_of(held.kind)) {
      held = limit;
    }
  }
  return held;
}

Limit degraded_limit(const FaultSet& degraded) {
  return degraded.empty()
             ? Limit{}
             : Limit{LimitKind::kDegraded, static_cast<std::uint8_t>(degraded.first())};
}

}  // namespace graben
