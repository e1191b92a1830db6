// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/outputs/pump_demand.hpp"

#include <algorithm>
#include <random>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/optimiser.hpp"
#include "firmware/mcv/pump_need.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/rounds.hpp"

constexpr double kPeriod_s = 0.01;
constexpr double kReserve_n = 40e3;
constexpr unsigned kDraws = test::rounds(2000, 100);

const ExcavatorProfile& shipped() { return test::excavator().profile; }
const McvMachine& valve() {
  static const McvMachine machine = mcv_machine(shipped());
  return machine;
}

McvInput any_input(std::mt19937& random) {
  std::uniform_real_distribution<double> speed_mps(-0.3, 0.3);
  std::uniform_real_distribution<double> pressure_pa(0.0, 12e6);
  McvInput input;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    input.velocity_mps[i] = speed_mps(random);
    input.cap_pressure_pa[i] = pressure_pa(random);
    input.rod_pressure_pa[i] = pressure_pa(random);
  }
  return input;
}

/// Force that the axis has left over besides its need and the reserve, as it moves and back.
double spare_n(const McvInput& input, const McvSolution& solution, unsigned axis) {
  const McvActuator& actuator = valve().actuator[axis];
  const bool extends = input.velocity_mps[axis] > 0.0;
  const double cap_n = actuator.area_cap_m2 * input.cap_pressure_pa[axis];
  const double load_n = cap_n - actuator.area_rod_m2 * input.rod_pressure_pa[axis];
  const double back_m2 = extends ? actuator.area_rod_m2 : actuator.area_cap_m2;
  const double pump_pa = solution.point.pump_pressure_pa[static_cast<unsigned>(actuator.pump)];
  const double back_n = back_m2 * pump_pa + (extends ? load_n : -load_n) - actuator.force_offset_n;
  const double open =
      input.velocity_mps[axis] / (extends ? actuator.extend : actuator.retract).y_last();
  const double need_n = std::max(actuator.force_offset_n, open * open);
  const double ahead_n = solution.margins.force_n[axis] + actuator.force_offset_n - need_n;
  return std::min(ahead_n, back_n) - kReserve_n;
}

/// With the needed flow lambda is 1, and on each line the axis that lacks most has just its
/// reserve.
TEST(the_needed_flow_is_enough_and_no_more) {
  McvMachine unrelieved = valve();
  for (McvPump& pump : unrelieved.pump) {
    pump.has_relief = false;
  }
  std::mt19937 random(5);
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    McvInput input = any_input(random);
    input.pump_flow_m3ps = needed_flow_m3ps(unrelieved, input, {1.0, kReserve_n, 0.0, 1e9});
    const McvSolution enough = solve_mcv(unrelieved, input, McvPolicy::kGlobal);
    assert_near(enough.point.lambda, 1.0, 1e-6);
    const double boom_n = spare_n(input, enough, kBoom);
    const double arm_n = spare_n(input, enough, kArm);
    const double bucket_n = spare_n(input, enough, kBucket);
    for (const double least_n : {arm_n, std::min(boom_n, bucket_n)}) {
      assert_true(least_n > -1.0);
      // The gallery's pressure is approached from above.
      assert_true(least_n < 4e3);
    }
  }
}

/// Where nothing moves, nothing is needed but what the bypass takes without pressure.
TEST(at_rest_nothing_is_needed, McvInput input) {
  input.cap_pressure_pa.fill(8e6);
  for (const double flow_m3ps : needed_flow_m3ps(valve(), input, {1.0, kReserve_n, 0.6, 33e6})) {
    assert_near(flow_m3ps, 0.0, 0.0);
  }
}

/// What a line is asked for ends where its relief valve opens.
TEST(the_pressure_has_an_end, McvInput input) {
  input.velocity_mps[kBoom] = 0.1;
  input.cap_pressure_pa[kBoom] = 35e6;
  const double most_m3ps = needed_flow_m3ps(valve(), input, {1.0, kReserve_n, 0.6, 33e6})[1];
  input.cap_pressure_pa[kBoom] = 60e6;
  const double more_m3ps = needed_flow_m3ps(valve(), input, {1.0, kReserve_n, 0.6, 33e6})[1];
  assert_true(most_m3ps > 0.0);
  assert_near(most_m3ps, more_m3ps, 1e-12);
}

struct Digging {
  ExcavatorProfile profile = shipped();
  McvInput input;
  PumpDemand demand;
  double engine_radps = profile.pump[0].rated_speed_radps;
  PerPump<double> line_pa{};
  PerPump<double> short_share{};
  bool blocked = false;
  double reserve_ratio = 1.0;

  Digging() {
    input.velocity_mps = {0.05, 0.1, 0.02, 0.0};
    input.cap_pressure_pa.fill(4e6);
    step(false);
  }
  void step(bool active = true) {
    next_pump_demand(profile, valve(),
                     {input, line_pa, engine_radps, short_share, active, blocked, reserve_ratio},
                     kPeriod_s, demand);
  }
  double settled(unsigned pump) {
    repeat(2000, [&] { step(); });
    return demand.swash_ratio[pump];
  }
};

/// A motion that wants twice the reserve gets the flow that a profile with such a reserve asks for.
TEST(a_motion_may_want_more_reserve) {
  Digging usual;
  Digging twice;
  Digging told;
  twice.reserve_ratio = 2.0;
  told.profile.control.lambda_rise.reserve_n *= 2.0;
  for (int n = 0; n < 200; ++n) {
    usual.step();
    twice.step();
    told.step();
  }
  assert_true(twice.demand.swash_ratio == told.demand.swash_ratio);
  assert_true(twice.demand.swash_ratio[0] > usual.demand.swash_ratio[0] + 0.01);
}

double profile_most() { return shipped().demand_swash.most_ratio; }

/// More with the load, more with a slower engine, within the range, no more than the task's where a
/// load holds a drive, and the task's swash at rest or without a range.
TEST(the_swash_goes_by_what_is_needed) {
  const double light = Digging().settled(0);
  Digging heavy;
  heavy.input.cap_pressure_pa[kArm] = 8e6;
  assert_true(heavy.settled(0) > light + 0.05);
  Digging slow;
  slow.engine_radps *= 0.9;
  assert_near(slow.settled(0), light / 0.9, 1e-9);
  Digging empty;
  empty.input.velocity_mps = {};
  assert_near(empty.settled(0), shipped().demand_swash.least_ratio, 0.0);
  Digging rock;
  rock.input.cap_pressure_pa.fill(34e6);
  assert_near(rock.settled(1), shipped().demand_swash.most_ratio, 0.0);
  rock.blocked = true;
  rock.step();
  assert_near(rock.demand.swash_ratio[1], profile_most() - 0.01, 1e-12);
  assert_near(rock.settled(1), shipped().dig_swash_ratio[1], 0.0);
  rock.step(false);
  assert_true(rock.demand.swash_ratio == shipped().dig_swash_ratio);
  rock.profile.demand_swash = {};
  rock.step();
  assert_true(rock.demand.swash_ratio == shipped().dig_swash_ratio);
}

/// The pump of a drive that goes much slower than it should gives more than the model asks for, to
/// a bound; what is a little slow does not count, and what was added goes again.
TEST(a_drive_that_falls_short_gets_more, Digging digging) {
  digging.input.velocity_mps = {0.02, 0.03, 0.01, 0.0};
  digging.input.cap_pressure_pa.fill(1e6);
  const double light = digging.settled(0);
  const double other = digging.settled(1);
  digging.short_share[0] = 0.3;
  assert_near(digging.settled(0), light, 1e-9);
  digging.short_share[0] = 1.0;
  repeat(50, [&] { digging.step(); });
  assert_near(digging.demand.short_ratio[0], 0.25, 0.02);
  assert_near(digging.settled(0), light + 0.35, 1e-9);
  assert_near(digging.demand.swash_ratio[1], other, 1e-9);
  digging.short_share = {};
  repeat(100, [&] { digging.step(); });
  assert_near(digging.demand.short_ratio[0], 0.25, 0.02);
  assert_near(digging.settled(0), light, 1e-9);
  digging.short_share[0] = 1.0;
  digging.settled(0);
  digging.step(false);
  digging.step();
  assert_true(digging.demand.short_ratio[0] < 0.02);
  // A rock's way of falling short is not helped by oil.
  digging.settled(0);
  digging.blocked = true;
  digging.step();
  assert_near(digging.demand.short_ratio[0], 0.0, 0.0);
}

/// Up fast, down slowly.
TEST(it_changes_no_faster_than_it_should, Digging digging) {
  digging.input.cap_pressure_pa.fill(34e6);
  const double start = digging.demand.swash_ratio[0];
  digging.step();
  assert_near(digging.demand.swash_ratio[0], start + 0.01, 1e-12);
  digging.settled(0);
  digging.input.cap_pressure_pa.fill(0.0);
  digging.step();
  assert_near(digging.demand.swash_ratio[0], shipped().demand_swash.most_ratio - 0.001, 1e-12);
}

/// At full load both pumps together take what the engine can give, no more.
TEST(the_engine_is_not_asked_for_more_than_it_has, Digging rock) {
  rock.input.cap_pressure_pa.fill(34e6);
  rock.line_pa.fill(30e6);
  rock.profile.demand_swash.most_power_w = 120e3;
  rock.settled(0);
  double power_w = 0.0;
  for (unsigned j = 0; j < 2; ++j) {
    const PumpProfile& pump = rock.profile.pump[j];
    power_w += 30e6 * pump_flow_m3ps(pump, rock.engine_radps, rock.demand.swash_ratio[j]);
  }
  assert_near(power_w, rock.profile.demand_swash.most_power_w, 1.0);
}
