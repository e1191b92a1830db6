#include "app/plant/swing_motor.hpp"

namespace graben::plant {

SwingMotor::SwingMotor(const SwingMotorData& data, double step_s)
    : chambers_({data.displacement_m3prad, data.displacement_m3prad, data.leak_m3pspa, data.oil},
                step_s),
      oil_(data.oil) {
  chambers_.start(data.chamber_volume_m3, data.start_pa, data.chamber_volume_m3, data.start_pa);
}

MotorLoad SwingMotor::load() const {
  const ChamberLoads oil = chambers_.load(rate_);
  const double left_share = flow_energy_share(oil_, left().pressure_pa());
  const double right_share = flow_energy_share(oil_, right().pressure_pa());
  return {left_share * oil.a.force - right_share * oil.b.force,
          left_share * oil.a.damping + right_share * oil.b.damping};
}

}  // namespace graben::plant
