// SPDX-License-Identifier: Apache-2.0
/// The optimiser on any machine and any input: every field as raw as a caller could hand it over.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "firmware/mcv/optimiser.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/plain_circuit.hpp"

namespace graben::test {
namespace {

constexpr int kTablePoints = 8;

struct RawTable {
  std::array<double, kTablePoints> x;
  std::array<double, kTablePoints> y;
};

struct RawActuator {
  double area_cap_m2;
  double area_rod_m2;
  double c_drain;
  double c_check;
  double bypass_open;
  double bypass_closed;
  double force_offset_n;
  double c_inflow_check;
  double extend_bypass_closes_at;
  double retract_bypass_closes_at;
  double extend_outlet_share;
  double retract_outlet_share;
  RawTable extend;
  RawTable retract;
  std::int8_t pump;
  std::int8_t regeneration;
  std::array<std::int8_t, 6> unused;
};

struct RawPump {
  double leak_linear;
  double leak_quadratic;
  double series_resistance;
  double relief_pa;
  double margin_pa;
  double full_swash_pa;
  double least_swash_pa;
  double least_swash_ratio;
  double response_s;
  double tank_orifice;
  std::int8_t has_relief;
  std::int8_t kind;
  std::int8_t compensated;
  std::array<std::int8_t, 5> unused;
};

struct RawSolve {
  std::int32_t actuator_count;
  std::int32_t pump_count;
  double most;
  double reserve_n;
  double hold;
  double hold_share;
  double rise_ps;
  double last_lambda;
  double period_s;
  McvInput input;
  PerPump<RawPump> pump;
  PerActuator<RawActuator> actuator;
};

MonotoneTable table_from(const RawTable& raw) {
  MonotoneTable table;
  static_cast<void>(table.fill(raw.x.data(), raw.y.data(), kTablePoints));
  return table;
}

/// A table's ends and points between them.
RawTable raw_from(const MonotoneTable& table) {
  RawTable raw{};
  for (int n = 0; n < kTablePoints; ++n) {
    const auto k = static_cast<unsigned>(n);
    raw.x[k] = table.x_last() * n / (kTablePoints - 1);
    raw.y[k] = n == 0 ? 0.0 : table.at(raw.x[k]);
  }
  return raw;
}

McvMachine machine_from(const RawSolve& raw) {
  McvMachine machine;
  machine.actuator_count = raw.actuator_count;
  machine.pump_count = raw.pump_count;
  for (unsigned j = 0; j < kMaxPumps; ++j) {
    const RawPump& from = raw.pump[j];
    machine.pump[j] = {
        from.leak_linear,
        from.leak_quadratic,
        from.series_resistance,
        from.has_relief % 2 == 1,
        from.relief_pa,
        {static_cast<PumpKind>(from.kind), from.margin_pa, from.compensated % 2 == 1,
         from.full_swash_pa, from.least_swash_pa, from.least_swash_ratio, from.response_s},
        from.tank_orifice};
  }
  for (unsigned i = 0; i < kMaxActuators; ++i) {
    const RawActuator& from = raw.actuator[i];
    machine.actuator[i] = {from.area_cap_m2,
                           from.area_rod_m2,
                           from.pump,
                           static_cast<RegenerationSide>(from.regeneration),
                           from.c_drain,
                           from.c_check,
                           from.bypass_open,
                           from.bypass_closed,
                           from.force_offset_n,
                           from.c_inflow_check,
                           {from.extend_bypass_closes_at, from.retract_bypass_closes_at},
                           from.extend_outlet_share,
                           from.retract_outlet_share,
                           table_from(from.extend),
                           table_from(from.retract)};
  }
  return machine;
}

/// Pumps of each kind in turn, as our twins have them.
void regulate(std::uint64_t seed, RawSolve& raw) {
  const auto kind = static_cast<std::int8_t>(seed % 3);
  for (RawPump& pump : raw.pump) {
    pump.kind = kind;
    pump.compensated = static_cast<std::int8_t>(seed / 3 % 2);
    pump.margin_pa = 2e6;
    pump.full_swash_pa = 1e6;
    pump.least_swash_pa = 3e6;
    pump.least_swash_ratio = 0.1;
    pump.response_s = 0.07;
    pump.tank_orifice = pump.series_resistance > 0.0 ? 2.0 * pump.series_resistance : 5e-6;
  }
  for (RawActuator& actuator : raw.actuator) {
    actuator.extend_bypass_closes_at = seed % 2 == 0 ? 0.5 : 0.0;
    actuator.retract_bypass_closes_at = seed % 2 == 0 ? 0.4 : 0.0;
    actuator.extend_outlet_share = actuator.retract_outlet_share = 0.2;
  }
}

RawSolve raw_from(const RandomCase& sound) {
  RawSolve raw{};
  raw.actuator_count = sound.machine.actuator_count;
  raw.pump_count = sound.machine.pump_count;
  raw.most = 1.0;
  raw.hold = 0.25;
  raw.hold_share = 0.75;
  raw.rise_ps = 4.0;
  raw.last_lambda = 0.5;
  raw.period_s = 0.01;
  raw.input = sound.input;
  for (unsigned j = 0; j < kMaxPumps; ++j) {
    const McvPump& from = sound.machine.pump[j];
    raw.pump[j].leak_linear = from.leak_linear;
    raw.pump[j].leak_quadratic = from.leak_quadratic;
    raw.pump[j].series_resistance = from.series_resistance;
    raw.pump[j].relief_pa = from.relief_pa;
    raw.pump[j].has_relief = from.has_relief ? 1 : 0;
  }
  for (unsigned i = 0; i < static_cast<unsigned>(sound.machine.actuator_count); ++i) {
    const McvActuator& from = sound.machine.actuator[i];
    raw.actuator[i] = {from.area_cap_m2,
                       from.area_rod_m2,
                       from.c_drain,
                       from.c_check,
                       from.bypass_open,
                       from.bypass_closed,
                       from.force_offset_n,
                       from.c_inflow_check,
                       from.bypass_closes_at.extend,
                       from.bypass_closes_at.retract,
                       from.extend_outlet_share,
                       from.retract_outlet_share,
                       raw_from(from.extend),
                       raw_from(from.retract),
                       static_cast<std::int8_t>(from.pump),
                       static_cast<std::int8_t>(from.regeneration),
                       {}};
  }
  return raw;
}

}  // namespace

std::string check_bytes(const std::uint8_t* data, std::size_t size) {
  const auto raw = raw_from_bytes<RawSolve>(data, size);
  const McvMachine machine = machine_from(raw);
  const LambdaRange range{raw.most, raw.reserve_n, raw.hold, raw.hold_share};
  for (const McvPolicy policy :
       {McvPolicy::kAlgorithm1, McvPolicy::kConnected, McvPolicy::kGlobal}) {
    const std::string wrong =
        unsafe(machine, raw.input, range, solve_mcv(machine, raw.input, policy, range));
    if (!wrong.empty()) {
      return fmt::format("policy {}: {}", static_cast<int>(policy), wrong);
    }
  }
  // A bound below lambda's last value holds nothing back.
  const LambdaRise rise{raw.rise_ps, raw.reserve_n, raw.hold_share};
  const double bound = std::clamp(raw.last_lambda + rise.rate_ps * raw.period_s, 1e-3, 1.0);
  const LambdaRange steady{std::max(bound, std::clamp(raw.last_lambda, 0.0, 1.0)), rise.reserve_n,
                           0.0, rise.hold_share};
  return unsafe(
      machine, raw.input, steady,
      steady_lambda(machine, raw.input, McvPolicy::kGlobal, rise, raw.last_lambda, raw.period_s));
}

bool inputs_are_numbers() { return true; }

std::vector<Bytes> seed_inputs() {
  std::vector<Bytes> seeds;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    RawSolve raw = raw_from(random_case(seed));
    regulate(seed, raw);
    seeds.push_back(bytes_from_raw(raw));
  }
  return seeds;
}

}  // namespace graben::test
