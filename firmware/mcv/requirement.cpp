// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/requirement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/tuning.hpp"

namespace graben {
namespace {

/// Steps of a search, over all its stretches. [-; size: random circuits need at most a quarter]
constexpr int kSteps = 96;
/// Steps of a search on a starved line. [-; size: rounding can use them all up, then halving takes
/// over]
constexpr int kStarvedSteps = 32;

struct Lengths {
  Tangent drive;
  Tangent resist;
  Tangent inverse_lambda;  ///< 0 where it plays no part.
};

/// Length of a vector from its square and the half of that square's slope.
Tangent length(double square, double half_slope) {
  const double value = std::sqrt(square);
  return {value, value > 0.0 ? half_slope / value : 0.0};
}

/// `least`: of 1 / lambda, as `inverse_lambda` has it.
Lengths lengths(const Requirement& requirement, const FlowBalance& line, const Stretch& stretch,
                double ratio, double least) {
  double drive = requirement.drive_area_m2 * ratio * ratio;
  double drive_slope = requirement.drive_area_m2 * ratio;
  double resist = requirement.full_opening_n;
  double resist_slope = 0.0;
  GalleryPressure phi;
  if (requirement.resist_area_m2 > 0.0) {
    const RegenerationDemand& own = requirement.regeneration;
    phi = gallery_pressure(own.q_out_m3ps, ratio, own.c_drain, own.c_check,
                           own.opening >= stretch.high);
    resist += requirement.resist_area_m2 * phi.sqrt_pressure * phi.sqrt_pressure;
    resist_slope += requirement.resist_area_m2 * phi.sqrt_pressure * phi.slope;
  }
  Tangent y;
  if (requirement.load_n != 0.0) {
    y = inverse_lambda(line, stretch, ratio, least);
    const double weight = std::abs(requirement.load_n);
    (requirement.load_n > 0.0 ? resist : drive) += weight * y.value * y.value;
    (requirement.load_n > 0.0 ? resist_slope : drive_slope) += weight * y.value * y.slope;
  }
  Lengths at{length(drive, drive_slope), length(resist, resist_slope), y};
  // At length 0 (a pump that exactly feeds its line: r = 0) it grows as fast as the vector does.
  const double load_slope_square = std::abs(requirement.load_n) * y.slope * y.slope;
  if (drive == 0.0) {
    at.drive.slope =
        std::sqrt(requirement.drive_area_m2 + (requirement.load_n > 0.0 ? 0.0 : load_slope_square));
  }
  if (resist == 0.0) {
    at.resist.slope = std::sqrt(requirement.resist_area_m2 * phi.slope * phi.slope +
                                (requirement.load_n > 0.0 ? load_slope_square : 0.0));
  }
  return at;
}

}  // namespace

Requirement no_back_flow(const CircuitAxis& axis) {
  return {axis.inlet_area_m2,
          axis.regeneration ? axis.outlet_area_m2 : 0.0,
          axis.load_force_n + axis.force_offset_n,
          0.0,
          {axis.q_out_m3ps, axis.c_drain, axis.c_check, axis.opening}};
}

Requirement spool_travel(const CircuitAxis& axis) {
  Requirement requirement = no_back_flow(axis);
  requirement.load_n = axis.load_force_n;
  requirement.full_opening_n = axis.full_opening_force_n;
  return requirement;
}

namespace {

/// One stretch's share of a search.
class StretchSearch {
 public:
  StretchSearch(const Requirement& requirement, const FlowBalance& line, Towards towards,
                const Stretch& stretch)
      : requirement_(requirement),
        line_(line),
        stretch_(stretch),
        slower_(towards == Towards::kSlower),
        // The driving length is a straight line where no load helps.
        straight_(slower_ && requirement.load_n > 0.0),
        most_steps_(is_starved(line) ? kStarvedSteps : kSteps) {}

  /// Moves `change.ratio` up to `end`, or to the change if that comes first.
  void run(Change& change, double end) const {
    double reach = std::abs(end - change.ratio);
    double looked_to = change.ratio;
    double nudge = 4.440892098500626e-16;
    Lengths at = lengths(requirement_, line_, stretch_, change.ratio, 0.0);
    // Each of the lengths below is paid for by itself: they are the dearest of a round.
    while (change.ratio != end) {
      if (++change.steps > most_steps_ || !may_step(line_.work)) {
        change.bounded = false;
        return;
      }
      if (slower_ && at.inverse_lambda.value * kStandstillLambda > 1.0) {
        change.ratio = end;  // What is further right stands still.
        return;
      }
      const Gap gap = gap_of(at);
      if (!(gap.missing > kGapRoundingShare * gap.size)) {
        change.found = true;
        return;
      }
      const double left = std::abs(end - change.ratio);
      const double newton = gap.closing > 0.0 ? gap.missing / gap.closing : left;
      const double share = newton * at.inverse_lambda.slope / at.inverse_lambda.value;
      if (newton < left && share < kLastNewtonShare) {
        change.ratio += sign() * newton;
        change.found = true;
        return;
      }
      Free free{newton, reach, false, {}};
      if (!straight_) {
        if (slower_ && change.ratio >= looked_to) {
          looked_to = ratio_at(at.inverse_lambda.value * kFirstChordSpan, change.ratio);
          reach = looked_to > change.ratio ? std::min(left, looked_to - change.ratio) : left;
        }
        if (!may_step(line_.work)) {
          change.bounded = false;
          return;
        }
        free = free_by_chord(at, gap, change.ratio, std::min({newton, left, reach}));
        reach = free.reach;
      }
      const double ratio = change.ratio;
      const double next = ratio + sign() * free.length;
      if (!(free.length < left)) {
        change.ratio = end;
        return;
      }
      if (free.length > 0.0 && next == change.ratio) {
        // So steep that the change is nearer than a number can say, or rounding says so.
        change.ratio *= 1.0 + sign() * nudge;
        nudge *= 4.0;
      } else {
        change.ratio = next;
        change.found = share < kLastChordShare;
      }
      if (change.found) {
        return;
      }
      if (!may_step(line_.work)) {
        change.bounded = false;
        return;
      }
      at = free.whole ? free.there : lengths_from(at, ratio, change.ratio);
    }
  }

 private:
  /// What must still rise, over what, along the way.
  struct Gap {
    Tangent rising;
    Tangent level;
    double missing = 0.0;
    double closing = 0.0;
    double size = 0.0;
  };

  /// How far from a point there can be no change.
  struct Free {
    double length = 0.0;
    /// What a next chord is good for: one over a steep bend says next to nothing.
    double reach = 0.0;
    bool whole = false;  ///< All of the chord; `there` is its end.
    Lengths there;
  };

  [[nodiscard]] double sign() const { return slower_ ? 1.0 : -1.0; }
  [[nodiscard]] Tangent along(const Tangent& over_ratio) const {
    return {over_ratio.value, sign() * over_ratio.slope};
  }
  [[nodiscard]] Gap gap_of(const Lengths& at) const {
    Gap gap;
    gap.rising = along(slower_ ? at.drive : at.resist);
    gap.level = along(slower_ ? at.resist : at.drive);
    gap.missing = gap.level.value - gap.rising.value;
    gap.closing = gap.rising.slope - gap.level.slope;
    gap.size = gap.level.value + gap.rising.value;
    return gap;
  }

  /// At another r of the stretch: 1 / lambda is nowhere under its tangent.
  [[nodiscard]] Lengths lengths_from(const Lengths& at, double ratio, double there) const {
    const Tangent& y = at.inverse_lambda;
    return lengths(requirement_, line_, stretch_, there, y.value + y.slope * (there - ratio));
  }

  /// r at 1 / lambda; `otherwise` where lambda bounds nothing.
  [[nodiscard]] double ratio_at(double inverse_lambda, double otherwise) const {
    const double lambda = 1.0 / inverse_lambda;
    return std::isfinite(lambda) ? solve_pump_pressure(line_, lambda).sqrt_pressure * inverse_lambda
                                 : otherwise;
  }

  [[nodiscard]] Free free_by_chord(const Lengths& at, const Gap& gap, double ratio,
                                   double length) const {
    Free free{length, 4.0 * length, true, lengths_from(at, ratio, ratio + sign() * length)};
    const double end = (slower_ ? free.there.drive : free.there.resist).value;
    if (!std::isfinite(end)) {
      return {0.0, 0.25 * length, false, {}};  // The chord's end is beyond lambda = 0.
    }
    const double chord = (end - gap.rising.value) / length - gap.level.slope;
    if (chord > 0.0 && gap.missing < chord * length) {
      free.length = gap.missing / chord;
      free.reach = 4.0 * free.length;
      free.whole = false;
    }
    return free;
  }

  const Requirement& requirement_;
  const FlowBalance& line_;
  const Stretch& stretch_;
  bool slower_;
  bool straight_;
  int most_steps_;
};

}  // namespace

Change first_change(const Requirement& requirement, const FlowBalance& line, Towards towards,
                    double from, double end) {
  Change change;
  change.ratio = from;
  // One stretch more than there are check valves.
  for (int n = 0; n <= kMaxActuators && change.bounded && !change.found && change.ratio != end;
       ++n) {
    const bool slower = towards == Towards::kSlower;
    const Stretch stretch =
        slower ? stretch_right_of(line, change.ratio) : stretch_left_of(line, change.ratio);
    const double stretch_end = slower ? std::min(stretch.high, end) : std::max(stretch.low, end);
    change.bounded = may_step(line.work);
    if (change.bounded) {
      StretchSearch(requirement, line, towards, stretch).run(change, stretch_end);
    }
  }
  return change;
}

double lambda_at_fixed_ratio(const Requirement& requirement, double ratio) {
  if (requirement.load_n > 0.0) {
    return 0.0;  // Force falls with lambda^2, the load does not.
  }
  double over_lambda2 = requirement.drive_area_m2 * ratio * ratio - requirement.full_opening_n;
  if (requirement.resist_area_m2 > 0.0) {
    const RegenerationDemand& own = requirement.regeneration;
    const double phi =
        return_gallery(own.q_out_m3ps, ratio, own.c_drain, own.c_check).sqrt_pressure;
    over_lambda2 -= requirement.resist_area_m2 * phi * phi;
  }
  return over_lambda2 >= 0.0 ? std::numeric_limits<double>::infinity()
                             : std::sqrt(requirement.load_n / over_lambda2);
}

}  // namespace graben
