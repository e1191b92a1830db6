// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/pressure_ratio.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/tuning.hpp"
#include "firmware/numeric/constants.hpp"
#include "firmware/numeric/cube_root.hpp"

namespace graben {
namespace {

/// Newton steps to a 1 / lambda. [-; size: as many as to a pressure, kPressureSteps]
constexpr int kRatioSteps = 24;

/// h(r)
Tangent demand(const FlowBalance& line, const Stretch& stretch, double ratio) {
  Tangent h{line.in_flow_m3ps + line.bypass * ratio, line.bypass};
  for (int i = 0; i < line.regeneration_count; ++i) {
    const RegenerationDemand& from = line.regeneration[static_cast<unsigned>(i)];
    const GalleryPressure phi = gallery_pressure(from.q_out_m3ps, ratio, from.c_drain, from.c_check,
                                                 from.opening >= stretch.high);
    h.value += from.c_drain * phi.sqrt_pressure;
    h.slope += from.c_drain * phi.slope;
  }
  return h;
}

/// A y under the root of flow y = h + quadratic / y^3.
double leaking_only(double flow, double h, double quadratic) {
  if (h >= 0.0) {
    return std::sqrt(std::sqrt(quadratic / flow));
  }
  return std::min(std::sqrt(std::sqrt(quadratic / (2.0 * flow))),
                  cube_root(quadratic / (-2.0 * h)));
}

/// A y under the root for a demand of h and both leakages.
double under_root(double flow, double h, double linear, double quadratic) {
  // Without the quadratic leakage a quadratic equation; h may be below 0 there.
  const double root = std::sqrt(h * h + 4.0 * flow * linear);
  const double y = h >= 0.0 ? (h + root) / (2.0 * flow) : 2.0 * linear / (root - h);
  return quadratic <= flow * y * y * y * y ? y : std::max(y, leaking_only(flow, h, quadratic));
}

}  // namespace

Stretch stretch_right_of(const FlowBalance& line, double ratio) {
  Stretch stretch{ratio, kInfinity};
  for (int i = 0; i < line.regeneration_count; ++i) {
    const double opening = line.regeneration[static_cast<unsigned>(i)].opening;
    if (opening > ratio) {
      stretch.high = std::min(stretch.high, opening);
    }
  }
  return stretch;
}

Stretch stretch_left_of(const FlowBalance& line, double ratio) {
  Stretch stretch{0.0, ratio};
  for (int i = 0; i < line.regeneration_count; ++i) {
    const double opening = line.regeneration[static_cast<unsigned>(i)].opening;
    if (opening < ratio) {
      stretch.low = std::max(stretch.low, opening);
    }
  }
  return stretch;
}

Tangent inverse_lambda(const FlowBalance& line, const Stretch& stretch, double ratio,
                       double least) {
  const double flow = line.ratio_flow_m3ps;
  const Tangent h = demand(line, stretch, ratio);
  const double held = line.has_relief ? ratio / line.sqrt_relief : 0.0;
  if (flow == 0.0 && h.value >= 0.0) {
    return {kInfinity, kInfinity};
  }
  const double linear = line.leak_linear * ratio * ratio;
  const double quadratic = line.leak_quadratic * ratio * ratio * ratio * ratio;
  bool near = quadratic > 0.0 && least > 0.0 && least < kInfinity;
  double y = near ? least : under_root(flow, h.value, linear, quadratic);
  // The quadratic leakage only raises y, and what is left over of the balance is convex in y: from
  // below Newton rises onto the root and never passes it.
  for (int step = 0; step < kRatioSteps && quadratic > 0.0 && may_step(line.work); ++step) {
    const double per_y = 1.0 / y;
    const double leak = quadratic * per_y * per_y * per_y;
    const double missing = h.value + linear * per_y + leak - flow * y;
    const double rise = missing / (flow + (linear * per_y + 3.0 * leak) * per_y);
    if (near && rise > kRatioGuessFar * y) {
      y = std::max(y, under_root(flow, h.value, linear, quadratic));
      near = false;
      continue;
    }
    near = false;
    y += rise;
    // The error after a step is at most about the square of its relative length.
    if (!(rise > kNewtonLastStep * y)) {
      break;
    }
  }
  if (held > y || y == 0.0) {
    return {held, line.has_relief ? 1.0 / line.sqrt_relief : 0.0};
  }
  const double per_y = 1.0 / y;
  const double leak = line.leak_quadratic * ratio * ratio * per_y * per_y;
  const double rise = h.slope + 2.0 * ratio * per_y * (line.leak_linear + 2.0 * leak);
  const double fall = flow + ratio * ratio * per_y * per_y * (line.leak_linear + 3.0 * leak);
  return {y, rise / fall};
}

bool is_starved(const FlowBalance& line) {
  return line.regeneration_count > 0 && line.ratio_flow_m3ps == 0.0;
}

bool is_stagnant(const FlowBalance& line) {
  return line.ratio_flow_m3ps == 0.0 && line.leak_linear == 0.0 && line.leak_quadratic == 0.0;
}

double fed_lambda(const FlowBalance& line) {
  return line.least_flow_m3ps > 0.0 ? line.flow_m3ps / line.least_flow_m3ps : kInfinity;
}

}  // namespace graben
