// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/valve_model.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/falling_flow.hpp"
#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/evaluation.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::identify {
namespace {

/// Slower than this a drive stands: what its sensor drifts moves no oil.
constexpr double kStands_mps = 0.002;
/// Less on the draining side is more zero and return line than pressure.
constexpr double kDrained_pa = 1.5e6;
constexpr double kStep_mps = 1e-4;
/// With less on the fed side make-up from the tank may be open.
constexpr double kFed_pa = 0.8e6;
/// Beyond this share of the drain's coefficient the gallery decides as much as the edge.
constexpr double kEdgeDecides = 0.6;
/// Less pressure left for an edge is more the line's error than the edge's.
constexpr double kSays_pa = 1.0e6;
/// Pumps that sense the load cut off so far under the relief at the most.
constexpr double kCutOff_pa = 2.0e6;
/// A pressure that rises faster takes oil that moves nothing.
constexpr double kRise_paps = 12e6;
// Of a line that gives way steeply, the speed is sought rather than taken from its slope.
constexpr double kSteep = 1.3;
constexpr double kFaster_mps = 0.02;
constexpr double kSame_mps = 1e-8;
constexpr int kDoublings = 6;
constexpr int kPositions = 30;
constexpr int kHalvings = 20;
/// A pump is later than a spool that goes on opening: where the bypass closes that is much.
constexpr double kRamp_ps = 0.03;
/// As fast as that, of what the pump has left for it, a drive shows the pump and not its edge.
constexpr double kOfMost = 0.95;

/// The speeds as the valve's model takes them: along their spools, or none.
McvInput input_at(const DriveModel& model, const SteadyPoint& point, double own_mps) {
  McvInput input;
  for (std::size_t k = 0; k < model.drives(); ++k) {
    const bool own = static_cast<int>(k) == point.axis;
    const double speed_mps = own ? own_mps : point.all_speed_mps[k];
    const bool with_spool = own || speed_mps * point.all_spool[k] > 0.0;
    input.velocity_mps[k] = with_spool && std::abs(speed_mps) > kStands_mps ? speed_mps : 0.0;
    input.cap_pressure_pa[k] = point.cap_pa[k];
    input.rod_pressure_pa[k] = point.rod_pa[k];
  }
  input.pump_flow_m3ps = model.flow_m3ps(point.engine_radps, point.swash);
  return input;
}

}  // namespace

PreparedPoint::PreparedPoint(const DriveModel& model, const SteadyPoint& point,
                             const DriveEstimates& drives)
    : point_(point) {
  const auto axis = static_cast<std::size_t>(point.axis);
  const DriveEstimate& drive = drives[axis];
  // At 1 m/s all that grows with its speed is its coefficient.
  const McvCircuit circuit =
      make_circuit(model.valve, input_at(model, point, extends() ? 1.0 : -1.0));
  axis_ = circuit.axis[axis];
  pump_ = model.valve.actuator[axis].pump;
  others_ = circuit.line[static_cast<std::size_t>(pump_)];
  others_.in_flow_m3ps -= axis_.q_in_m3ps - (axis_.regeneration ? axis_.q_out_m3ps : 0.0);
  for (int n = 0; n < others_.regeneration_count; ++n) {
    RegenerationDemand& demand = others_.regeneration[static_cast<std::size_t>(n)];
    if (axis_.regeneration && demand.q_out_m3ps == axis_.q_out_m3ps) {
      demand = others_.regeneration[static_cast<std::size_t>(--others_.regeneration_count)];
      break;
    }
  }
  full_mps_ = axis_.spool->y_last();
  const SpoolProfile& spool = model.drive[axis].spool;
  const double per_area = model.metering.discharge * std::sqrt(2.0 / model.metering.density_kgpm3);
  out_m3ps_ = per_area * (extends() ? spool.extend_out_m2 : spool.retract_out_m2);
  in_m3ps_ = per_area * (extends() ? spool.extend_in_m2 : spool.retract_in_m2);
  cap_m2_ = model.valve.actuator[axis].area_cap_m2;
  rod_m2_ = model.valve.actuator[axis].area_rod_m2;
  const double cap_pa = point.cap_pa[axis] - drive.cap_zero_pa.value;
  const double rod_pa = point.rod_pa[axis] - drive.rod_zero_pa.value;
  const double drained_pa = extends() ? rod_pa : cap_pa;
  const double fed_pa = extends() ? cap_pa : rod_pa;
  fed_ = fed_pa > kFed_pa;
  drains_ = drained_pa > kDrained_pa && std::abs(point.speed_mps) > kStands_mps;
  if (model.pump_kind() == PumpKind::kNegativeFlow) {
    actuator_ = &model.valve.actuator[axis];
    closes_at_ = closing_share(model, point.axis, extends());
    fed_ = fed_ && std::abs(point.spool_rise_ps) < kRamp_ps && is_at_rest();
    bypass_rest_ =
        orifice_resistance(others_.bypass) - orifice_resistance(actuator_->bypass_closed);
  }
  if (model.pump_kind() == PumpKind::kLoadSensing) {
    sense_loads(model, drives);
    // Nearer to the relief the line may have less than its margin over the load.
    const double relief_pa = model.pump[static_cast<std::size_t>(pump_)].relief_pa;
    const double line_pa = std::max({0.0, fed_pa, others_pa_}) + margin_pa_;
    const bool holds = line_pa < relief_pa - kCutOff_pa;
    bounds_ = holds && is_at_rest() && !fed_;
    fed_ = holds && is_at_rest() && fed_;
    const double gallery = std::abs(point.speed_mps) * axis_.q_out_m3ps / axis_.c_drain;
    returns_ = axis_.regeneration && gallery * gallery > line_pa;
  }
}

bool PreparedPoint::is_at_rest() const {
  return std::abs(extends() ? point_.cap_rise_paps : point_.rod_rise_paps) < kRise_paps;
}

void PreparedPoint::sense_loads(const DriveModel& model, const DriveEstimates& drives) {
  const PumpRegulator& by = model.pump[static_cast<std::size_t>(pump_)].regulator;
  senses_load_ = true;
  compensated_ = by.compensated;
  margin_pa_ = by.margin_pa;
  for (std::size_t k = 0; k < model.drives(); ++k) {
    const double speed_mps = point_.all_speed_mps[k];
    if (static_cast<int>(k) != point_.axis && model.valve.actuator[k].pump == pump_ &&
        speed_mps * point_.all_spool[k] > 0.0 && std::abs(speed_mps) > kStands_mps) {
      const double fed_pa = speed_mps > 0.0 ? point_.cap_pa[k] - drives[k].cap_zero_pa.value
                                            : point_.rod_pa[k] - drives[k].rod_zero_pa.value;
      others_pa_ = std::max(others_pa_, fed_pa);
    }
  }
}

double PreparedPoint::metered_mps(const ValveTry& tried, double area_ratio) const {
  const auto axis = static_cast<std::size_t>(point_.axis);
  const double fed_pa =
      extends() ? point_.cap_pa[axis] - tried.cap_zero_pa : point_.rod_pa[axis] - tried.rod_zero_pa;
  const double over_pa =
      margin_pa_ + (compensated_ ? 0.0 : std::max(0.0, others_pa_ - std::max(0.0, fed_pa)));
  return tried.coefficient_factor * in_m3ps_ * area_ratio * std::sqrt(over_pa) /
         axis_.inlet_area_m2;
}

double PreparedPoint::most_mps(const ValveTry& tried) const {
  if (returns_) {
    return kInfinity;
  }
  const auto axis = static_cast<std::size_t>(point_.axis);
  const double fed_pa =
      extends() ? point_.cap_pa[axis] - tried.cap_zero_pa : point_.rod_pa[axis] - tried.rod_zero_pa;
  const double sqrt_line = std::sqrt(std::max({0.0, fed_pa, others_pa_}) + margin_pa_);
  const double left_m3ps = flow_left(line_at(tried.pump_flow_factor, 0.0), 1.0, sqrt_line);
  return std::max(0.0, left_m3ps) / axis_.inlet_area_m2;
}

FlowBalance PreparedPoint::line_at(double flow_factor, double speed_mps) const {
  FlowBalance line = others_;
  line.flow_m3ps *= flow_factor;
  const double in_m3ps = speed_mps * axis_.q_in_m3ps;
  const double out_m3ps = speed_mps * axis_.q_out_m3ps;
  line.in_flow_m3ps += in_m3ps;
  line.least_flow_m3ps = line.in_flow_m3ps;
  if (axis_.regeneration) {
    line.in_flow_m3ps -= out_m3ps;
    line.least_flow_m3ps =
        line.in_flow_m3ps + out_m3ps * axis_.c_drain / (axis_.c_check + axis_.c_drain);
    line.regeneration[static_cast<std::size_t>(line.regeneration_count++)] = {
        out_m3ps, axis_.c_drain, axis_.c_check, out_m3ps / axis_.c_drain};
  }
  return line;
}

double PreparedPoint::sqrt_line(const ValveTry& tried, double speed_mps) const {
  FlowBalance line = line_at(tried.pump_flow_factor, speed_mps);
  if (actuator_ != nullptr) {
    const double start = tried.curve.start();
    line.bypass = bypass_with(std::max(0.0, std::abs(point_.spool) - start) / (1.0 - start),
                              tried.closes_at_factor * closes_at_);
    return falling_sqrt_pressure(line, tried.felt_factor);
  }
  // Many more than it takes: kPressureSteps end it.
  Work work{1000};
  line.work = &work;
  const PumpPressure solved = solve_pump_pressure(line, 1.0);
  return solved.fed ? solved.sqrt_pressure : 0.0;
}

double PreparedPoint::force_n(const ValveTry& tried, double speed_mps) const {
  const auto axis = static_cast<std::size_t>(point_.axis);
  const double load_n = cap_m2_ * (point_.cap_pa[axis] - tried.cap_zero_pa) -
                        rod_m2_ * (point_.rod_pa[axis] - tried.rod_zero_pa);
  CircuitAxis now = axis_;
  now.load_force_n = extends() ? load_n : -load_n;
  now.q_out_m3ps = speed_mps * axis_.q_out_m3ps;
  return drive_force(now, 1.0, sqrt_line(tried, speed_mps)).force_n;
}

double PreparedPoint::edge_before(double travel) const {
  if (actuator_ == nullptr) {
    return travel;
  }
  const auto axis = static_cast<std::size_t>(point_.axis);
  const double fed_pa = std::max(0.0, extends() ? point_.cap_pa[axis] : point_.rod_pa[axis]);
  const FlowBalance line =
      line_at(1.0, std::max(0.0, extends() ? point_.speed_mps : -point_.speed_mps));
  double low = 0.0;
  double high = 1.0;
  for (int n = 0; n < kHalvings; ++n) {
    const double closed = 0.5 * (low + high);
    FlowBalance tried = line;
    tried.bypass = bypass_with(closed * closes_at_, closes_at_);
    const double sqrt_pa = falling_sqrt_pressure(tried, 1.0);
    (sqrt_pa * sqrt_pa < fed_pa ? low : high) = closed;
  }
  const double closes = low * closes_at_;
  return (travel - closes) / (1.0 - closes);
}

double PreparedPoint::bypass_with(double behind_start, double closes_at) const {
  const double own = bypass_at(*actuator_, closes_at, behind_start);
  return 1.0 / std::sqrt(bypass_rest_ + orifice_resistance(own));
}

double PreparedPoint::settled_mps(const ValveTry& tried, double coefficient,
                                  double near_mps) const {
  const auto faster_mps = [&](double speed_mps) {
    return coefficient * std::sqrt(std::max(0.0, force_n(tried, speed_mps))) - speed_mps;
  };
  double low = 0.0;
  double low_left = faster_mps(low);
  if (low_left <= 0.0) {
    return 0.0;
  }
  double high = near_mps + kFaster_mps;
  double high_left = faster_mps(high);
  for (int n = 0; n < kDoublings && high_left > 0.0; ++n) {
    low = high;
    low_left = high_left;
    high *= 2.0;
    high_left = faster_mps(high);
  }
  // By false positions, an end that stays counting half.
  int stayed = 0;
  for (int n = 0; n < kPositions && high - low > kSame_mps; ++n) {
    const double middle = (low * high_left - high * low_left) / (high_left - low_left);
    const double left = faster_mps(middle);
    if (left > 0.0) {
      low = middle;
      low_left = left;
      high_left *= stayed > 0 ? 0.5 : 1.0;
      stayed = 1;
    } else {
      high = middle;
      high_left = left;
      low_left *= stayed < 0 ? 0.5 : 1.0;
      stayed = -1;
    }
    if (std::abs(left) < kSame_mps) {
      return middle;
    }
  }
  return 0.5 * (low + high);
}

SpeedError PreparedPoint::speed_error(const ValveTry& tried) const {
  const double seen_mps = extends() ? point_.speed_mps : -point_.speed_mps;
  if (senses_load_) {
    const double area_ratio = tried.curve.area_ratio(std::abs(point_.spool));
    const double error_mps = std::min(metered_mps(tried, area_ratio), most_mps(tried)) - seen_mps;
    return {fed_ ? error_mps : std::max(0.0, error_mps), 0.0};
  }
  const double speed_mps = std::max(0.0, seen_mps);
  const double coefficient =
      tried.coefficient_factor * full_mps_ * tried.curve.area_ratio(std::abs(point_.spool));
  const double force = force_n(tried, speed_mps);
  const double faster = force_n(tried, speed_mps + kStep_mps);
  const double closing = std::max(0.0, (force - faster) / kStep_mps);
  if (force <= 0.0 && actuator_ != nullptr) {
    return {settled_mps(tried, coefficient, speed_mps) - seen_mps, 0.0};
  }
  if (force <= 0.0) {
    // Even without a valve it would have to be slower by this.
    const double slower_mps = closing > 0.0 ? force / closing : -speed_mps;
    return {std::max(-speed_mps, slower_mps), closing > 0.0 ? 1.0 / closing : 0.0};
  }
  const double root = std::sqrt(force);
  const double slope = coefficient / (2.0 * root);
  const double own = 1.0 + slope * closing;
  if (actuator_ != nullptr && own > kSteep) {
    return {settled_mps(tried, coefficient, speed_mps) - seen_mps, slope / own};
  }
  return {(coefficient * root - seen_mps) / own, slope / own};
}

double PreparedPoint::out_error_mps(const ValveTry& tried) const {
  const auto axis = static_cast<std::size_t>(point_.axis);
  const double drained_pa =
      extends() ? point_.rod_pa[axis] - tried.rod_zero_pa : point_.cap_pa[axis] - tried.cap_zero_pa;
  const double seen_mps = extends() ? point_.speed_mps : -point_.speed_mps;
  double out = tried.out_area_factor * out_m3ps_ * tried.curve.area_ratio(std::abs(point_.spool));
  if (axis_.regeneration) {
    if (out > kEdgeDecides * axis_.c_drain) {
      return 0.0;
    }
    out = out * axis_.c_drain / std::hypot(out, axis_.c_drain);
  }
  return out * std::sqrt(std::max(0.0, drained_pa)) / axis_.q_out_m3ps - seen_mps;
}

double PreparedPoint::coefficient_share(const ValveTry& tried) const {
  const double speed_mps = std::max(0.0, extends() ? point_.speed_mps : -point_.speed_mps);
  if (senses_load_) {
    const bool metered = speed_mps < kOfMost * most_mps(tried);
    return fed_ && metered && speed_mps > kStands_mps ? speed_mps / metered_mps(tried, 1.0) : -1.0;
  }
  const double left_n = force_n(tried, speed_mps);
  const bool says = fed_ && speed_mps > kStands_mps && left_n > kSays_pa * axis_.inlet_area_m2;
  return says ? speed_mps / (full_mps_ * std::sqrt(left_n)) : -1.0;
}

double closing_share(const DriveModel& model, int axis, bool extends) {
  const auto k = static_cast<std::size_t>(axis);
  const DutyTable& duty = model.drive[k].answer.side(extends).spool_to_duty;
  const double start = duty.at(0.0);
  return (duty.at(model.valve.actuator[k].bypass_closes_at.side(extends)) - start) / (1.0 - start);
}

double coefficient_of(const DriveModel& model, int axis, bool extends, double in_factor,
                      double out_factor) {
  const McvActuator& actuator = model.valve.actuator[static_cast<std::size_t>(axis)];
  const double out_share = extends ? actuator.extend_outlet_share : actuator.retract_outlet_share;
  return 1.0 / std::sqrt((1.0 - out_share) / (in_factor * in_factor) +
                         out_share / (out_factor * out_factor));
}

std::vector<CurvePoint> curve_points(const DriveModel& model, const std::vector<MachineLog>& logs,
                                     const MachineEstimate& found) {
  std::vector<CurvePoint> all;
  for (const SteadyPoint& point : steady_points(logs, model)) {
    const DriveEstimate& drive = found.drive[static_cast<std::size_t>(point.axis)];
    const PreparedPoint prepared(model, point, found.drive);
    ValveTry tried;
    tried.cap_zero_pa = drive.cap_zero_pa.value;
    tried.rod_zero_pa = drive.rod_zero_pa.value;
    tried.curve = drive.side(prepared.extends()).curve();
    tried.pump_flow_factor =
        found.pump_flow_factor[static_cast<std::size_t>(prepared.pump())].value;
    tried.closes_at_factor = found.closes_at_factor;
    const double share = prepared.coefficient_share(tried);
    if (share >= 0.0) {
      // Both edges open alike: the coefficient's share is that of the feeding one.
      const SideEstimate& side = drive.side(prepared.extends());
      const bool by_edge = model.pump_kind() == PumpKind::kLoadSensing;
      const double whole = by_edge ? side.coefficient_factor.value / side.in_area_factor : 1.0;
      all.push_back({point.axis, prepared.extends(), std::abs(point.spool), whole * share});
    }
  }
  return all;
}

}  // namespace graben::identify
