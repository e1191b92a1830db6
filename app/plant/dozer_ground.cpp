// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_ground.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {

Terrain::Terrain(double from_m, double to_m, double cell_m)
    : from_(from_m),
      cell_(cell_m),
      height_(static_cast<std::size_t>(std::ceil((to_m - from_m) / cell_m)) + 1, 0.0) {}

double Terrain::end_m() const { return from_ + cell_ * static_cast<double>(height_.size() - 1); }

double Terrain::node(long index) const {
  const long last = static_cast<long>(height_.size()) - 1;
  return height_[static_cast<std::size_t>(std::clamp(index, 0L, last))];
}

double Terrain::at(double place) const {
  const std::size_t last = height_.size() - 1;
  const double inside = std::clamp(place, 0.0, static_cast<double>(last));
  const std::size_t index = std::min(static_cast<std::size_t>(inside), last);
  const double below = height_[index];
  return below +
         (inside - static_cast<double>(index)) * (height_[std::min(index + 1, last)] - below);
}

double Terrain::mean_height_m(double x_m, double half_width_m) const {
  const double begin = place(x_m - half_width_m);
  const double end = place(x_m + half_width_m);
  const double first = std::ceil(begin);
  const double last = std::floor(end);
  if (first > last) {
    return at(0.5 * (begin + end));
  }
  // Straight pieces: each is worth its middle times its length.
  double sum = (first - begin) * at(0.5 * (begin + first)) + (end - last) * at(0.5 * (last + end));
  for (long i = static_cast<long>(first); i < static_cast<long>(last); ++i) {
    sum += 0.5 * (node(i) + node(i + 1));
  }
  return sum / (end - begin);
}

void Terrain::lower(long index, double height_m) {
  if (index >= 0 && index < static_cast<long>(height_.size())) {
    double& height = height_[static_cast<std::size_t>(index)];
    height = std::min(height, height_m);
  }
}

void Terrain::cut(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const double begin = place(from_m.x());
  const double end = place(to_m.x());
  for (long i = static_cast<long>(std::floor(begin)) + 1; i <= static_cast<long>(std::floor(end));
       ++i) {
    const double share = (static_cast<double>(i) - begin) / (end - begin);
    lower(i, from_m.y() + share * (to_m.y() - from_m.y()));
  }
  if (from_m.y() - to_m.y() > std::abs(to_m.x() - from_m.x())) {
    lower(std::lround(end), to_m.y());
  }
}

void Terrain::fill(double from_m, double to_m, double height_m) {
  const long last =
      std::min(static_cast<long>(std::floor(place(to_m))), static_cast<long>(height_.size()) - 1);
  for (long i = std::max(static_cast<long>(std::floor(place(from_m))) + 1, 0L); i <= last; ++i) {
    double& height = height_[static_cast<std::size_t>(i)];
    height = std::max(height, height_m);
  }
}

namespace {

/// 1 - (1 - exp(-u)) / u for u >= 0.
double mean_shear_stress(double u) {
  constexpr double kLinear = 1e-5;
  return u < kLinear ? 0.5 * u : 1.0 + std::expm1(-u) / u;
}

}  // namespace

Traction::Traction(const DozerPlantProfile& profile)
    : friction_(profile.ground.friction),
      modulus_(profile.ground.slip_modulus_m),
      contact_(profile.machine.body.track_contact_m),
      damping_(profile.shear_damping_nspm) {}

double Traction::step(double track_speed_mps, double ground_speed_mps, double load_n,
                      double step_s) {
  const double passing = std::max(std::abs(track_speed_mps), std::abs(ground_speed_mps));
  const double before = shear_;
  shear_ = (before + step_s * (track_speed_mps - ground_speed_mps)) /
           (1.0 + step_s * passing / contact_);
  const double most = friction_ * load_n;
  const double stress = std::copysign(mean_shear_stress(std::abs(shear_) / modulus_), shear_);
  const double damped = most * stress + damping_ * (shear_ - before) / step_s;
  force_ = std::clamp(damped, -most, most);
  return force_;
}

}  // namespace graben::plant
