// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/hand/assist_line.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Halves of the edge's width at which a surface is looked at: its corners and its middle, over
/// which a ridge may stand. [-; size: left, middle, right]
constexpr int kAcrossEdge = 3;

AssistLine line_of_plane(const ExcavatorProfile& profile, const Fence& plane, double swing_rad,
                         const Eigen::Vector3d& origin_m, const Eigen::Vector2d& shown_off_m) {
  AssistLine line;
  line.known = true;
  const double cosine = std::cos(swing_rad);
  const double sine = std::sin(swing_rad);
  // The fence looks into the ground.
  const Eigen::Vector2d up(-plane.normal.x() * cosine - plane.normal.y() * sine, -plane.normal.z());
  const double across = plane.normal.x() * sine - plane.normal.y() * cosine;
  const double corner_m = 0.5 * profile.geometry.body.bucket_width_m * std::abs(across);
  const double length = up.norm();
  line.up = up / length;
  line.from_foot_m = (corner_m - plane.offset_m + plane.normal.dot(origin_m)) / length +
                     profile.assist.offset_m +
                     line.up.dot(shown_off_m - profile.geometry.boom_foot_m);
  return line;
}

struct SectionPlace {
  bool known = false;
  double y_m = 0.0;  ///< Over the boom foot's pin, as the sensors show it.
};

class Section {
 public:
  Section(const ExcavatorProfile& profile, const DesignSurface& surface, double swing_rad,
          const Eigen::Vector3d& origin_m, const Eigen::Vector2d& shown_off_m)
      : surface_(surface),
        outwards_(std::cos(swing_rad), std::sin(swing_rad)),
        half_m_(0.5 * profile.geometry.body.bucket_width_m),
        offset_m_(profile.assist.offset_m),
        pin_m_(profile.geometry.boom_foot_m - shown_off_m),
        origin_m_(origin_m) {}

  /// As high as the highest that is under the edge; for what lies ahead its corners are enough.
  [[nodiscard]] SectionPlace place(double x_m, int step = 1) const {
    const double out_m = x_m + pin_m_.x();
    double most_m = -kNoSurface_m;
    for (int i = 0; i < kAcrossEdge; i += step) {
      const double left_m = half_m_ * (i - 1);
      double height_m = 0.0;
      if (!surface_.height_at(out_m * outwards_.x() - left_m * outwards_.y() + origin_m_.x(),
                              out_m * outwards_.y() + left_m * outwards_.x() + origin_m_.y(),
                              height_m)) {
        return {};
      }
      most_m = std::max(most_m, height_m);
    }
    return {true, most_m - pin_m_.y() - origin_m_.z()};
  }

  [[nodiscard]] SectionPlace corners(double x_m) const { return place(x_m, kAcrossEdge - 1); }

  [[nodiscard]] AssistLine line(double x_m) const {
    AssistLine line;
    const SectionPlace near = place(x_m - kAssistKink_m);
    const SectionPlace here = place(x_m);
    const SectionPlace far = place(x_m + kAssistKink_m);
    line.known = near.known && here.known && far.known;
    if (line.known) {
      line.up = Eigen::Vector2d(near.y_m - far.y_m, 2.0 * kAssistKink_m).normalized();
      line.from_foot_m = line.up.dot(Eigen::Vector2d(x_m, here.y_m)) + offset_m_;
    }
    return line;
  }

  /// The same where the edge is measured: its height at once, its slope from where it is planned.
  [[nodiscard]] AssistLine line(double x_m, const AssistLine& planned) const {
    AssistLine line = planned;
    const SectionPlace here = place(x_m);
    line.known = here.known && planned.known;
    line.from_foot_m = line.up.dot(Eigen::Vector2d(x_m, here.y_m)) + offset_m_;
    return line;
  }

  /// Slow enough before every kink that the edge can follow it, and to rest before the border.
  void look_ahead(double x_m, double way, Limit why, SpeedCap& cap) const {
    const double step_m = 2.0 * kAssistKink_m;
    const SectionPlace before = corners(x_m - way * step_m);
    SectionPlace here = corners(x_m);
    double slope = way * (here.y_m - before.y_m) / step_m;
    double last_turn = 0.0;
    for (int i = 0; i < kAssistAheadSteps; ++i) {
      const SectionPlace next = corners(x_m + way * step_m * (i + 1));
      const double from_m = step_m * std::max(0, i - 1);
      if (!next.known) {
        cap.tighten(std::sqrt(2.0 * kAssistBrakes_mps2 * from_m), why);
        return;
      }
      const double next_slope = way * (next.y_m - here.y_m) / step_m;
      // The angle's tangent: never less than the angle.
      const double turn =
          std::abs(next_slope - slope) / std::max(kAssistSteepKink, 1.0 + next_slope * slope);
      // A kink may lie across two steps.
      const double kink = turn + last_turn;
      if (kink > kAssistStraight_rad) {
        cap.tighten(
            std::sqrt(kAssistTurns_mps2 * step_m / kink + 2.0 * kAssistBrakes_mps2 * from_m), why);
      }
      here = next;
      slope = next_slope;
      last_turn = turn;
    }
  }

 private:
  const DesignSurface& surface_;
  Eigen::Vector2d outwards_;
  double half_m_;
  double offset_m_;
  Eigen::Vector2d pin_m_;     ///< In the ground frame in which the surface lies where it is shown.
  Eigen::Vector3d origin_m_;  ///< Of that in the surface's own frame.
};

}  // namespace

AssistDesign assist_design(const ExcavatorProfile& profile, const FenceView& fences,
                           double swing_rad, const Eigen::Vector2d& shown_off_m,
                           const AssistView& view) {
  AssistDesign design;
  if (fences.count == 0) {
    return design;
  }
  const Fence& fence = fences.at(fences.count - 1);
  design.present = fence.is_design();
  if (!design.present) {
    return design;
  }
  const FrameShift shift = fences.shift != nullptr ? *fences.shift : FrameShift{};
  swing_rad -= shift.turn_rad;
  if (!fence.is_surface()) {
    design.now = design.at = line_of_plane(profile, fence, swing_rad, shift.origin_m, shown_off_m);
    return design;
  }
  const Section section(profile, *fence.surface, swing_rad, shift.origin_m, shown_off_m);
  design.at = section.line(view.at_m);
  design.now = view.now_m == view.at_m ? design.at : section.line(view.now_m, design.at);
  if (design.at.known && view.way != 0.0) {
    section.look_ahead(view.at_m, view.way, {LimitKind::kAhead, 0}, design.ahead);
  }
  return design;
}

}  // namespace graben
