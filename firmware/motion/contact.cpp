#include "firmware/motion/contact.hpp"

#include <algorithm>

namespace graben {

VelocityCap contact_cap(const ContactBand& band, double tip_y_m, const VelocityCap& cap) {
  const double height_m = tip_y_m - band.ground_y_m;
  const double outside_m = std::max({0.0, height_m - band.above_m, -band.below_m - height_m});
  const double share = std::min(1.0, outside_m / band.blend_m);
  const double factor = band.speed_ratio + share * (1.0 - band.speed_ratio);
  return factor < cap.factor ? VelocityCap{factor, {LimitKind::kContact, 0}} : cap;
}

}  // namespace graben
