#include "app/plant/swing_inertia.hpp"

namespace graben::plant {

SwingInertia::SwingInertia(const ExcavatorPlantProfile& profile)
    : body_(profile.link),
      link_length_{profile.machine.geometry.boom_length_m, profile.machine.geometry.arm_length_m,
                   profile.machine.geometry.bucket_length_m},
      boom_foot_m_(profile.machine.geometry.boom_foot_m.x()) {}

void SwingInertia::update(const JointRotations& joint) {
  inertia_ = 0.0;
  gradient_ = {};
  Rotation link;
  double pin_radius = boom_foot_m_;
  // By how much the pin's radius falls with the angle of each link before it.
  JointArray pin_drop{};
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    link = link.then(joint[i]);
    const LinkBody& body = body_[i];
    const Eigen::Vector2d centre = link.apply(body.mass_centre_m);
    const double moment = body.mass_kg * (pin_radius + centre.x());
    const double own = body.inertia_kgm2 * link.cosine;
    inertia_ += moment * (pin_radius + centre.x()) + own * link.cosine;
    for (std::size_t j = 0; j < i; ++j) {
      gradient_[j] -= 2.0 * moment * pin_drop[j];
    }
    gradient_[i] -= 2.0 * (moment * centre.y() + own * link.sine);
    pin_radius += link_length_[i] * link.cosine;
    pin_drop[i] = link_length_[i] * link.sine;
  }
}

}  // namespace graben::plant
