// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A place that the tool is set to by hand, to see whether it is where it is shown.

#include <Eigen/Core>

namespace graben {

/// Ranges are checked where it is read. As constructed there is no mark.
struct MarkProfile {
  /// Of an excavator's teeth: from the swing axis on the ground, x forward, y to the left, z up;
  /// without a swing drive y is 0. Of a dozer's edge: in the world of its design.
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  double tolerance_m = 0.0;  ///< So far off it may be shown; 0: there is no mark.
  double most_age_s = 0.0;   ///< So old may a check be until it is said; 0: as old as it is.
  bool required = false;     ///< Nothing arms while the check is older, or there was none.

  [[nodiscard]] bool known() const { return tolerance_m > 0.0; }
};

}  // namespace graben
