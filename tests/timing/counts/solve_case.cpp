// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/counts/solve_case.hpp"

#include <cstring>

namespace graben::timing {
namespace {

// Targets without an operating system are little-endian too, and have the same doubles.
static_assert(sizeof(double) == 8);

class Writer {
 public:
  explicit Writer(std::FILE* file) : file_(file) {}

  void number(double value) { right_ = right_ && std::fwrite(&value, sizeof value, 1, file_) == 1; }
  template <class Whole>
  void whole(Whole value) {
    number(static_cast<double>(value));
  }
  void table(const MonotoneTable& table) {
    whole(table.size());
    for (int i = 0; i < table.size(); ++i) {
      number(table.x(i));
      number(table.y(i));
    }
  }
  [[nodiscard]] bool right() const { return right_; }

 private:
  std::FILE* file_;
  bool right_ = true;
};

class Reader {
 public:
  explicit Reader(std::FILE* file) : file_(file) {}

  void number(double& value) { right_ = right_ && std::fread(&value, sizeof value, 1, file_) == 1; }
  template <class Whole>
  void whole(Whole& value) {
    double read = 0.0;
    number(read);
    value = static_cast<Whole>(read);
  }
  void table(MonotoneTable& table) {
    std::array<double, MonotoneTable::capacity()> x{};
    std::array<double, MonotoneTable::capacity()> y{};
    int count = 0;
    whole(count);
    right_ = right_ && count <= MonotoneTable::capacity();
    for (unsigned i = 0; right_ && i < static_cast<unsigned>(count); ++i) {
      number(x[i]);
      number(y[i]);
    }
    right_ = right_ && table.fill(x.data(), y.data(), count) == MonotoneTable::Fill::kOk;
  }
  [[nodiscard]] bool right() const { return right_; }

 private:
  std::FILE* file_;
  bool right_ = true;
};

template <class Way, class Actuator>
void pass(Way& way, Actuator& actuator) {
  way.number(actuator.area_cap_m2);
  way.number(actuator.area_rod_m2);
  way.whole(actuator.pump);
  way.whole(actuator.regeneration);
  way.number(actuator.c_drain);
  way.number(actuator.c_check);
  way.number(actuator.bypass_open);
  way.number(actuator.bypass_closed);
  way.number(actuator.force_offset_n);
  way.number(actuator.c_inflow_check);
  way.table(actuator.extend);
  way.table(actuator.retract);
}

template <class Way, class Case>
void pass_case(Way& way, Case& one) {
  way.whole(one.machine.actuator_count);
  way.whole(one.machine.pump_count);
  // Those that are not there have no tables.
  for (unsigned i = 0; way.right() && i < static_cast<unsigned>(one.machine.actuator_count); ++i) {
    pass(way, one.machine.actuator[i]);
    way.number(one.input.velocity_mps[i]);
    way.number(one.input.cap_pressure_pa[i]);
    way.number(one.input.rod_pressure_pa[i]);
  }
  for (unsigned j = 0; way.right() && j < static_cast<unsigned>(one.machine.pump_count); ++j) {
    auto& pump = one.machine.pump[j];
    way.number(pump.leak_linear);
    way.number(pump.leak_quadratic);
    way.number(pump.series_resistance);
    way.whole(pump.has_relief);
    way.number(pump.relief_pa);
    way.number(one.input.pump_flow_m3ps[j]);
  }
  way.number(one.rise.rate_ps);
  way.number(one.rise.reserve_n);
  way.number(one.rise.hold_share);
  way.number(one.last_lambda);
}

}  // namespace

bool write(std::FILE* file, const SolveCase& written) {
  Writer writer(file);
  pass_case(writer, written);
  return writer.right();
}

bool read(std::FILE* file, SolveCase& found) {
  found = {};
  Reader reader(file);
  pass_case(reader, found);
  return reader.right() && found.machine.actuator_count <= kMaxActuators &&
         found.machine.pump_count <= kMaxPumps;
}

}  // namespace graben::timing
