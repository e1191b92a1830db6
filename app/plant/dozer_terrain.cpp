#include "app/plant/dozer_terrain.hpp"

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

}  // namespace graben::plant
