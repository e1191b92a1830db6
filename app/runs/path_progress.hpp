#pragma once
/// Where a run stands with respect to its path.

#include "firmware/core/time.hpp"
#include "firmware/excavator/field/rounded_rectangle.hpp"

namespace graben::runs {

/// Whether a pose is on the path: the attitude belongs to it, because an approach may cross the
/// path long before it has arrived. Not a number is not on it.
[[nodiscard]] bool near_path(const RoundedRectangle& path, const Eigen::Vector2d& tip_m,
                             double attitude_rad);

/// The path counts as reached when the pose has stayed near for half a second; from there on the
/// way along it adds up.
class PathProgress {
 public:
  /// `path` must outlive this.
  PathProgress(const RoundedRectangle& path, double loops) : path_(path), loops_(loops) {}

  void update(const Eigen::Vector2d& tip_m, bool near, TimeUs now_us);
  [[nodiscard]] bool on_path() const { return on_path_; }
  /// Of all loops together.
  [[nodiscard]] double share() const;

 private:
  const RoundedRectangle& path_;
  double loops_;
  bool on_path_ = false;
  TimeUs near_since_us_ = 0;
  double travelled_m_ = 0.0;
  Eigen::Vector2d last_tip_m_ = Eigen::Vector2d::Zero();
};

}  // namespace graben::runs
