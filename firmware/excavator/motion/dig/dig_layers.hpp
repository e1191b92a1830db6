// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Digging down to a design in layers, cut by cut, as an operator does: a cut begins where soil
/// stands over the layer, and ends where the bucket is full; it gives way, upwards, where it gets
/// too heavy. What is left to be dug is what the edge itself has not yet passed.

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace graben {

/// Most strips side by side. [-; size: of CutState]
inline constexpr int kStripMost = 5;
/// Places along a strip whose height is kept. [-; size: of CutState]
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
  double bucket_m = 0.0;       ///< Its length, teeth to pin: a dig's own lengths are shares of it.
  double full_m3 = 0.0;        ///< Of the ground, that fills the bucket.
  double depth_most_m = 0.0;   ///< Of a cut.
  double force_n = 0.0;        ///< On the teeth, that a cut gives way to.
  double give_mpn = 0.0;       ///< The teeth may spring by that when the force goes.
  double give_down_mpn = 0.0;  ///< The same straight down, of what the ground bears.
  double speed_mps = 0.0;      ///< Along a cut.
  double enter_rad = 0.0;      ///< Attitude that the edge goes down with.
  double turns_m = 0.75;       ///< Way on which the bucket comes from that to its attitude.
  double touch_share =
      -1.0;                ///< Of the line, where the ground is first felt for; below 0: nowhere.
  double carry_rad = 0.0;  ///< Attitude that a full bucket is lifted at.
  int strips = 1;          ///< Side by side, about the swing axis.
  double strip_rad = 0.0;  ///< From one to the next, to the left.
  double first_rad = 0.0;  ///< Of the first, from the line's own swing.
};

/// One cut.
struct Cut {
  int strip = 0;
  double from_share = 0.0;  ///< Of the line.
  double height_m = 0.0;
  double enters_m = 0.0;   ///< Height from where the edge goes down to it, over all ground.
  double stands_m = 0.0;   ///< Height of the soil there.
  double volume_m3 = 0.0;  ///< Of the ground, that stands over it.
  bool thin = false;       ///< The last one down to the design.
  double steep = 1.0;      ///< Share of the steep attitude that the machine can have there.
};

/// What is left to be dug, by what the edge has passed. As constructed all is done.
struct CutState {
  std::array<std::array<float, kStripBins>, kStripMost> height_m{};
  Cut cut;
  double depth_m = 0.0;    ///< Of cuts, as the force lets them be.
  double force = 1.0;      ///< That a cut gives way to, of the plan's.
  double loaded_m3 = 0.0;  ///< Of the ground, in the bucket by what the edge has passed,
  double filled_m3 = 0.0;  ///< and what this cut adds to it.
  std::uint8_t tries = 0;  ///< Cuts of a strip in a row that got next to nothing.
  std::uint8_t cuts = 0;   ///< So far, of all.
  std::array<std::uint8_t, kStripMost> sweeps{};  ///< Of them, for what has fallen in there.
  std::array<bool, kStripMost> moves{};           ///< Its last cut brought soil that fell in.
  int last_strip = -1;      ///< Of the cut before; -1: there was none, or it was weighed.
  double last_m3 = 0.0;     ///< Of the ground, that its edge has passed.
  double yields = 0.9;      ///< Of what the edge passes, so much comes to be carried away.
  bool swept = false;       ///< The cut is for what has fallen in.
  bool wall_falls = false;  ///< At the line's beginning: sweeps come from beyond it.
  bool met = true;          ///< Nothing is left that stands too high.
};

/// Nothing is dug yet. `plan` has to have a step.
[[nodiscard]] CutState undug(const LayerPlan& plan);

/// Height of the undisturbed ground over the line.
[[nodiscard]] double ground_m(const LayerPlan& plan, double share);

/// The edge was here: what stood higher is gone. Returns what was cut, m3 of the ground.
double pass(const LayerPlan& plan, double share, double last_share, double height_m,
            CutState& state);

/// How a cut has gone.
struct CutEnd {
  double heavy = 0.0;      ///< How heavy on average; 1: as heavy as it may be.
  double filled_m3 = 0.0;  ///< Of the ground, by what the edge has passed.
  double share = 1.0;      ///< Of the line, that it has come to.
};

/// The cut has ended; the next one, or `met` where there is none. Of the strip that stands highest,
/// as low as fills the bucket, no deeper than the force lets it be, and never through the last thin
/// layer with the ones above it. Soil that stays up though it was cut kTriesMost times in a row is
/// left, as far as the last of these cuts has come and a little farther. Cuts after one that was
/// too heavy are less deep, after an easy one deeper.
void next_cut(const LayerPlan& plan, const CutEnd& end, CutState& state);

/// The cut was broken off, which says nothing of its depth: another one is chosen.
void abandon_cut(const LayerPlan& plan, CutState& state);

/// What the last cut has brought was weighed; 0: it was not. Less than its edge has passed: the
/// next one takes more to fill the bucket. More: soil has fallen in from beside it. Once the task
/// is through, such strips are cut again until no more has, kSweepsMost times each.
void weigh_cut(const LayerPlan& plan, double weighed_m3, CutState& state);

/// Of the ground, that the edge has to pass until the bucket is full.
[[nodiscard]] double filling_m3(const LayerPlan& plan, const CutState& state);

}  // namespace graben
