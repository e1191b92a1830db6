// SPDX-License-Identifier: Apache-2.0
// What the optimiser makes of every reference case by each policy, as the bits of its doubles, the
// same on every target: print_bits WORDS, a file of plain_cases.py.

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/optimiser.hpp"

namespace {

using namespace graben;

constexpr int kPolicies = 3;

[[noreturn]] void refuse(const char* what) {
  std::printf("print_bits: %s\n", what);
  std::exit(2);
}

class Words {
 public:
  explicit Words(const char* path) : file_(std::fopen(path, "r")) {
    if (file_ == nullptr) {
      refuse("the cases can't be read");
    }
  }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;
  ~Words() { std::fclose(file_); }

  /// False at the end of the file.
  bool next() { return std::fscanf(file_, "%63s", word_) == 1; }
  [[nodiscard]] const char* word() const { return word_; }
  int integer() {
    expect();
    return static_cast<int>(std::strtol(word_, nullptr, 10));
  }
  int integer(int least, int most) {
    const int value = integer();
    if (value < least || value > most) {
      refuse("a number is out of its range");
    }
    return value;
  }
  double number() {
    expect();
    const std::uint64_t bits = std::strtoull(word_, nullptr, 16);
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  void expect() {
    if (!next()) {
      refuse("the cases end in the middle of one");
    }
  }

  std::FILE* file_;
  char word_[64] = {};
};

MonotoneTable read_table(Words& words) {
  double travel[MonotoneTable::capacity()];
  double coefficient[MonotoneTable::capacity()];
  const int count = words.integer(2, MonotoneTable::capacity());
  for (int i = 0; i < count; ++i) {
    travel[i] = words.number();
    coefficient[i] = words.number();
  }
  MonotoneTable table;
  if (table.fill(travel, coefficient, count) != MonotoneTable::Fill::kOk) {
    refuse("a table is not monotone");
  }
  return table;
}

McvActuator read_actuator(Words& words) {
  McvActuator actuator;
  actuator.area_cap_m2 = words.number();
  actuator.area_rod_m2 = words.number();
  actuator.pump = words.integer();
  actuator.regeneration = static_cast<RegenerationSide>(words.integer(-1, 1));
  actuator.c_drain = words.number();
  actuator.c_check = words.number();
  actuator.bypass_open = words.number();
  actuator.bypass_closed = words.number();
  actuator.force_offset_n = words.number();
  actuator.c_inflow_check = words.number();
  actuator.extend = read_table(words);
  actuator.retract = read_table(words);
  return actuator;
}

McvPump read_pump(Words& words, double& flow_m3ps) {
  McvPump pump;
  flow_m3ps = words.number();
  pump.leak_linear = words.number();
  pump.leak_quadratic = words.number();
  for (int left = words.integer(0, kMaxBypassSeries); left > 0; --left) {
    pump.series_resistance += orifice_resistance(words.number());
  }
  pump.relief_pa = words.number();
  pump.has_relief = pump.relief_pa > 0.0;
  return pump;
}

void print(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  // newlib may be without 64-bit formats.
  std::printf(" %08" PRIx32 "%08" PRIx32, static_cast<std::uint32_t>(bits >> 32),
              static_cast<std::uint32_t>(bits));
}

template <class Array>
void print(const Array& values, int count) {
  for (int i = 0; i < count; ++i) {
    print(values[static_cast<unsigned>(i)]);
  }
}

/// Status and limit, lambda and shortfall; spools, pressures and forces of what is there.
void print(const McvMachine& machine, const McvSolution& solution) {
  std::printf(" %d %d %d", static_cast<int>(solution.status), static_cast<int>(solution.limit.kind),
              static_cast<int>(solution.limit.index));
  print(solution.point.lambda);
  print(solution.shortfall);
  print(solution.point.spool_m, machine.actuator_count);
  print(solution.point.pump_pressure_pa, machine.pump_count);
  print(solution.point.out_pressure_pa, machine.actuator_count);
  print(solution.point.drive_force_n, machine.actuator_count);
  std::printf("\n");
}

/// What a controller asks for: a rise that ends, a reserve for it, and less of that to stay.
constexpr LambdaRange kAsInACycle{0.9, 5000.0, 0.3, 0.75};

/// The id is the word that was read last, a + behind the policy the second of its results.
void solve_case(Words& words) {
  char id[64];
  std::memcpy(id, words.word(), sizeof id);
  McvMachine machine;
  McvInput input;
  machine.actuator_count = words.integer(1, kMaxActuators);
  machine.pump_count = words.integer(1, kMaxPumps);
  const auto actuators = static_cast<unsigned>(machine.actuator_count);
  for (unsigned i = 0; i < actuators; ++i) {
    machine.actuator[i] = read_actuator(words);
  }
  for (unsigned j = 0; j < static_cast<unsigned>(machine.pump_count); ++j) {
    machine.pump[j] = read_pump(words, input.pump_flow_m3ps[j]);
  }
  for (auto* values : {&input.velocity_mps, &input.cap_pressure_pa, &input.rod_pressure_pa}) {
    for (unsigned i = 0; i < actuators; ++i) {
      (*values)[i] = words.number();
    }
  }
  for (int policy = 0; policy < kPolicies; ++policy) {
    std::printf("%s %d", id, policy);
    print(machine, solve_mcv(machine, input, static_cast<McvPolicy>(policy)));
    std::printf("%s %d+", id, policy);
    print(machine, solve_mcv(machine, input, static_cast<McvPolicy>(policy), kAsInACycle));
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    refuse("print_bits WORDS");
  }
  Words words(arguments[1]);
  while (words.next()) {
    solve_case(words);
  }
  return 0;
}
