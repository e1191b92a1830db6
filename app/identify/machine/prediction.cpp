// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/prediction.hpp"

#include <algorithm>
#include <cmath>

namespace graben::identify {
namespace {

/// Half a window, in grid points.
constexpr std::size_t kHalf = 5;
static_assert(2.0 * kHalf * kGrid_s == kSpeedWindow_s);
/// Cushions begin here.
constexpr double kEnds_m = 0.06;
constexpr double kPlatformSwings_s = 0.1;

/// Share of what is left that a first-order lag makes up in a grid step.
double share_of(double lag_s) { return lag_s > 0.0 ? 1.0 - std::exp(-kGrid_s / lag_s) : 1.0; }

/// A side's part of the duty at a grid point, so long before; the part of a step that a dead time
/// leaves over is a mean of both neighbours.
double late(const std::vector<double>& duty, std::size_t at, double dead_time_s, bool extends) {
  const double steps = dead_time_s / kGrid_s;
  const auto whole = static_cast<std::size_t>(steps);
  const double rest = steps - static_cast<double>(whole);
  const auto part = [&](std::size_t back) {
    const double value = back <= at ? duty[at - back] : 0.0;
    return extends ? std::max(value, 0.0) : std::min(value, 0.0);
  };
  return (1.0 - rest) * part(whole) + rest * part(whole + 1);
}

/// One drive's way from its duty to its spool's opening.
class SpoolModel {
 public:
  explicit SpoolModel(const SpoolAnswers& answer) : answer_(answer) {}

  /// Opening at this grid point, its sign the side; to be called for each in their order.
  double step(const std::vector<double>& duty, std::size_t at) {
    const double sent = late(duty, at, answer_.extend.dead_time_s, true) +
                        late(duty, at, answer_.retract.dead_time_s, false);
    const double share = share_of(side(sent != 0.0 ? sent : spool_).spool_time_constant_s);
    first_ += share * (sent - first_);
    spool_ += share * (first_ - spool_);
    if (spool_ == 0.0) {
      return 0.0;
    }
    return std::copysign(side(spool_).spool_to_duty.inverse(std::abs(spool_)), spool_);
  }

  /// What of a side's lag is not its spool's, s.
  [[nodiscard]] double rest_s(double way) const {
    return std::max(0.0, side(way).lag_s - 2.0 * side(way).spool_time_constant_s);
  }

 private:
  [[nodiscard]] const SpoolAnswer& side(double way) const { return answer_.towards(way); }

  const SpoolAnswers& answer_;
  double first_ = 0.0;
  double spool_ = 0.0;
};

/// Both know them.
std::size_t drives_of(const DriveModel& model, const LogSegment& segment) {
  return std::min(model.drives(), segment.drives);
}

ValveMoment moment_of(const DriveModel& model, const LogSegment& segment, std::size_t at) {
  ValveMoment moment;
  for (std::size_t k = 0; k < drives_of(model, segment); ++k) {
    moment.cap_pa[k] = segment.axis[k].cap_pa[at] - model.cap_zero_pa[k];
    moment.rod_pa[k] = segment.axis[k].rod_pa[at] - model.rod_zero_pa[k];
  }
  for (std::size_t j = 0; j < kPumpCount; ++j) {
    moment.swash[j] = segment.swash[j][at];
  }
  moment.engine_radps = segment.engine_radps[at];
  return moment;
}

/// Slope of the straight line through a window of a position.
double slope(const std::vector<double>& position_m, std::size_t at) {
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t k = 1; k <= kHalf; ++k) {
    const auto n = static_cast<double>(k);
    sum += n * (position_m[at + k] - position_m[at - k]);
    square += 2.0 * n * n;
  }
  return sum / square / kGrid_s;
}

void compare(const CylinderSeries& series, const std::vector<double>& way_m, const DriveRow& drive,
             PredictedAxis& axis) {
  const std::vector<double>& stroke_m = series.stroke_m;
  const std::size_t size = stroke_m.size();
  axis.predicted_mps.assign(size, 0.0);
  axis.measured_mps.assign(size, 0.0);
  axis.judged.assign(size, false);
  // A platform goes on by its mass, whatever its valve says.
  const double swings_s = drive.control.has_end_stops ? kSwings_s : kPlatformSwings_s;
  double neutral_s = kSwings_s;
  for (std::size_t at = 0; at < size; ++at) {
    neutral_s = series.duty[at] != 0.0 ? 0.0 : neutral_s + kGrid_s;
    if (at < kHalf || at + kHalf >= size) {
      continue;
    }
    axis.predicted_mps[at] = slope(way_m, at);
    axis.measured_mps[at] = slope(stroke_m, at);
    axis.judged[at] = neutral_s < swings_s && stroke_m[at] > drive.least_travel_m + kEnds_m &&
                      stroke_m[at] < drive.most_travel_m - kEnds_m;
  }
}

PredictedSegment predict(const DriveModel& model, const LogSegment& segment) {
  const std::size_t drives = drives_of(model, segment);
  std::vector<SpoolModel> spools;
  for (std::size_t k = 0; k < drives; ++k) {
    spools.emplace_back(model.drive[k].answer);
  }
  std::array<double, kDriveCount> speed_mps{};
  std::array<std::vector<double>, kDriveCount> way_m;
  for (std::size_t at = 0; at < segment.size(); ++at) {
    ValveMoment moment = moment_of(model, segment, at);
    for (std::size_t k = 0; k < drives; ++k) {
      moment.opening[k] = spools[k].step(segment.axis[k].duty, at);
    }
    const std::array<double, kDriveCount> wanted_mps = model.speeds_mps(moment);
    for (std::size_t k = 0; k < drives; ++k) {
      const double way = wanted_mps[k] != 0.0 ? wanted_mps[k] : speed_mps[k];
      speed_mps[k] += share_of(spools[k].rest_s(way)) * (wanted_mps[k] - speed_mps[k]);
      const double before_m = way_m[k].empty() ? 0.0 : way_m[k].back();
      way_m[k].push_back(before_m + kGrid_s * speed_mps[k]);
    }
  }
  PredictedSegment predicted;
  for (std::size_t k = 0; k < drives; ++k) {
    compare(segment.axis[k], way_m[k], model.drive[k], predicted.axis[k]);
  }
  return predicted;
}

}  // namespace

std::vector<std::vector<PredictedSegment>> predict_logs(const DriveModel& model,
                                                        const std::vector<MachineLog>& logs) {
  std::vector<std::vector<PredictedSegment>> all;
  for (const MachineLog& log : logs) {
    std::vector<PredictedSegment>& of = all.emplace_back();
    for (const LogSegment& segment : log.segments) {
      of.push_back(predict(model, segment));
    }
  }
  return all;
}

}  // namespace graben::identify
