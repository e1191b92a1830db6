#pragma once
/// The ground as a height field along x, which the blade cuts.

#include <Eigen/Core>
#include <vector>

namespace graben::plant {

/// World frame, z up. Heights stand at nodes and run straight between them; beyond either end the
/// last one goes on. Flat at z = 0 until it is cut.
class Terrain {
 public:
  Terrain(double from_m, double to_m, double cell_m);

  [[nodiscard]] double height_m(double x_m) const { return at(place(x_m)); }
  /// Mean over `half_width_m` to either side.
  [[nodiscard]] double mean_height_m(double x_m, double half_width_m) const;
  /// Its derivative.
  [[nodiscard]] double mean_slope(double x_m, double half_width_m) const {
    return (height_m(x_m + half_width_m) - height_m(x_m - half_width_m)) / (2.0 * half_width_m);
  }

  /// The cutting edge has gone straight from one place to the other. Each node that it passed on
  /// the way forward is lowered to it; where it was pressed in rather than driven (steeper than 45
  /// degrees), so is the node next to it. Nothing is ever raised.
  void cut(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m);

  [[nodiscard]] double cell_m() const { return cell_; }
  [[nodiscard]] double begin_m() const { return from_; }
  [[nodiscard]] double end_m() const;

 private:
  /// In cells from the first node on.
  [[nodiscard]] double place(double x_m) const { return (x_m - from_) / cell_; }
  [[nodiscard]] double at(double place) const;
  [[nodiscard]] double node(long index) const;
  void lower(long index, double height_m);

  double from_;
  double cell_;
  std::vector<double> height_;
};

}  // namespace graben::plant
