#pragma once
/// Slowing down where the bucket meets the ground.

#include "firmware/machine/excavator_profile.hpp"
#include "firmware/motion/stroke_end.hpp"

namespace graben {

/// `cap`, or the band's speed ratio at this height of the tip where that is less.
[[nodiscard]] VelocityCap contact_cap(const ContactBand& band, double tip_y_m,
                                      const VelocityCap& cap);

}  // namespace graben
