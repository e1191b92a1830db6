#pragma once
/// Digging down to a design in layers, cut by cut, as an operator does: a cut begins where soil
/// stands over the layer, and ends where the bucket is full; it gives way, upwards, where it gets
/// too heavy. What is left to be dug is what the edge itself has not yet passed.

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace graben {

inline constexpr int kStripMost = 5;
inline constexpr int kStripBins = 24;

/// How a dig step is done in layers. Heights are along `up`, from the step's line, which lies
/// `clearance` over the design; m, as seen at the line's own swing.
struct LayerPlan {
  int step = -1;  ///< Which of the program's; below 0: none.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double ground_from_m = 0.0;  ///< Of the ground at the line's beginning, as it is before the task,
  double ground_to_m = 0.0;    ///< and at its end; straight between.
  double ground_z_m = 0.0;     ///< Height of that ground over the ground frame.
  double way_m = 0.0;          ///< Length of the line.
  double width_m = 0.0;        ///< Of the bucket.
  double full_m3 = 0.0;        ///< Of the ground, that fills the bucket.
  double depth_most_m = 0.0;   ///< Of a cut.
  double force_n = 0.0;        ///< On the teeth, that a cut gives way to.
  double give_mpn = 0.0;       ///< The teeth may spring by that when the force goes.
  double speed_mps = 0.0;      ///< Along a cut.
  double enter_rad = 0.0;      ///< Attitude that the edge goes down with.
  double carry_rad = 0.0;      ///< Attitude that a full bucket is lifted at.
  int strips = 1;              ///< Side by side, about the swing axis.
  double strip_rad = 0.0;      ///< From one to the next, to the left.
  double first_rad = 0.0;      ///< Of the first, from the line's own swing.
};

/// One cut.
struct Cut {
  int strip = 0;
  double from_share = 0.0;  ///< Of the line.
  double height_m = 0.0;    ///< Of its layer.
  double enters_m = 0.0;    ///< Height from where the edge goes down to it, over all ground.
  double steep = 1.0;       ///< Share of the steep attitude that the machine can have there.
};

/// What is left to be dug, by what the edge has passed. As constructed all is done.
struct CutState {
  std::array<std::array<float, kStripBins>, kStripMost> height_m{};
  Cut cut;
  double depth_m = 0.0;    ///< Of cuts, as the force lets them be.
  double layer_m = 0.0;    ///< Height of the layer that is being cut.
  std::uint8_t tries = 0;  ///< At this place, in a row.
  std::uint8_t cuts = 0;   ///< So far, of all.
  bool met = true;         ///< Nothing is left that stands too high.
};

/// Nothing is dug yet. `plan` has to have a step.
[[nodiscard]] CutState undug(const LayerPlan& plan);

/// Height of the undisturbed ground over the line.
[[nodiscard]] double ground_m(const LayerPlan& plan, double share);

/// The edge was here: what stood higher is gone. Returns what was cut, m3 of the ground.
double pass(const LayerPlan& plan, double share, double last_share, double height_m,
            CutState& state);

/// The next cut, layer by layer, from strip to strip; `met` where there is none. Soil that stays up
/// though it was cut kTriesMost times in a row is left.
void next_cut(const LayerPlan& plan, CutState& state);

/// Of the cut that has ended: the next ones are less deep where it was too heavy, deeper where it
/// was easy. `heaviest`: the most of its force over that which is given way to.
void after_cut(const LayerPlan& plan, double heaviest, CutState& state);

/// Over a layer soil counts as left if it stands higher by so much, or by this share of a cut's
/// depth; over the design itself.
inline constexpr double kRough_m = 0.03;
inline constexpr double kRoughShare = 0.45;
inline constexpr double kFinish_m = 0.012;
/// The last layer's thickness: its force is small, and so is what the teeth spring by.
inline constexpr double kLastLayer_m = 0.06;
inline constexpr int kTriesMost = 3;
/// With so many cuts a task ends, whatever is left.
inline constexpr int kCutsMost = 250;

}  // namespace graben
