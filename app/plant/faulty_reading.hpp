#pragma once
/// One sensor's reading as the bus is told of it, faults included.

#include "app/plant/node_faults.hpp"
#include "can_dbc/codec.hpp"

namespace graben::plant {

/// What a sensor shows, in its reading's unit.
struct ReadingFault {
  bool stuck = false;     ///< What it showed when this began.
  double jump = 0.0;      ///< Added.
  double drift_ps = 0.0;  ///< Added, growing by that much a second from 0 on; 0 takes it back.
  dbc::RawState state{};  ///< kValid shows the reading; else 'error' or 'not available'.

  ReadingFault() = default;
  explicit ReadingFault(const StrokeFault& fault)
      : stuck(fault.stuck), jump(fault.jump_m), drift_ps(fault.drift_mps), state(fault.state) {}
  explicit ReadingFault(const AngleFault& fault)
      : stuck(fault.stuck), jump(fault.jump_rad), drift_ps(fault.drift_radps), state(fault.state) {}
};

/// A sensor that can fail. A reading is taken once a cycle of 10 ms.
class FaultyReading {
 public:
  [[nodiscard]] dbc::Physical show(double reading, const ReadingFault& fault) {
    constexpr double kCycle_s = 0.01;
    drift_ = fault.drift_ps == 0.0 ? 0.0 : drift_ + kCycle_s * fault.drift_ps;
    if (!fault.stuck) {
      shown_ = reading + fault.jump + drift_;
    }
    return {fault.state == dbc::RawState::kValid ? shown_ : 0.0, fault.state};
  }

 private:
  double shown_ = 0.0;  ///< Last: a stuck sensor goes on showing it.
  double drift_ = 0.0;
};

}  // namespace graben::plant
