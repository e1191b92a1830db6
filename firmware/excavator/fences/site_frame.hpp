// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the machine stands on its site: the frame in which task files have their design, laid
/// under the machine by touched points, and given up once the tracks have moved. The machine stands
/// level.

#include "firmware/excavator/fences/fence.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben {

/// Points of the site that teeth can touch, in the frame in which task files have their design.
struct SitePoints {
  bool can_touch = false;  ///< There are these two.
  bool by_touch = false;   ///< That frame is known only once both are touched.
  Eigen::Vector3d benchmark_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d second_m = Eigen::Vector3d::Zero();
};

/// What is known of it; the numbers are on the bus.
enum class SiteKnown : std::uint8_t {
  kNone = 0,       ///< Nobody has asked yet; on the bus: there is no design.
  kUnknown = 1,    ///< Not given, or the tracks have moved since.
  kBenchmark = 2,  ///< The benchmark is touched, the heading is not known.
  kKnown = 3,
};

/// Teeth over the ground that the machine stands on, as the links look.
struct TeethPlace {
  double out_m = 0.0;      ///< From the swing axis,
  double swing_rad = 0.0;  ///< that way.
  double up_m = 0.0;
};

/// State from cycle to cycle.
struct SiteState {
  SiteKnown known = SiteKnown::kNone;
  bool begins_left = false;  ///< An earlier run has left the frame of the file, see is_left().
  bool placed = false;       ///< By touches; else the machine stands where its task file has it.
  FrameShift shift;
  TeethPlace benchmark;     ///< The teeth on it.
  double turned_rad = 0.0;  ///< The tracks, of late, by the platform's gyro and the swing's sensor.
  double swing_rad = 0.0;   ///< Of the last cycle.

  [[nodiscard]] bool is_lost() const {
    return known == SiteKnown::kUnknown || known == SiteKnown::kBenchmark;
  }
};

/// The last of a program's fences is its design.
[[nodiscard]] inline bool has_design(const FenceSet& fences) {
  return fences.count > 0 && fences.fence[static_cast<unsigned>(fences.count - 1)].is_design();
}

/// Nobody has asked yet: known as the file has it, unless an earlier run has left that.
void begin_site(const SitePoints& points, double swing_rad, SiteState& state);

/// The machine does not stand where the file has it, or nobody knows: a later run of the same file
/// must not believe that either. Of one that has to be touched anyway there is nothing to keep.
[[nodiscard]] inline bool is_left(const SitePoints& points, const SiteState& state) {
  return !points.by_touch && (state.is_lost() || state.placed || state.begins_left);
}

/// One touch on. What it makes of the frame: the benchmark begins anew; the second point ends that,
/// if it is as far from the benchmark and as high as the site has it; a place of the design within
/// kSiteBound_m leaves it as it is, another one makes it unknown. Refused ones change nothing else.
[[nodiscard]] MarkTouch next_site(const SitePoints& points, const FenceSet& fences, TouchKind kind,
                                  const TeethPlace& teeth, SiteState& state);

/// A cycle on: the tracks have turned where the platform turns (rad/s to the left) otherwise than
/// the swing does; then the frame is unknown. What a gyro's zero makes of it is forgotten.
void watch_tracks(double turning_radps, double swing_rad, double period_s, SiteState& state);

/// A program's fences with its design where it lies by now; without it where that is not known.
[[nodiscard]] inline FenceView placed(const FenceSet& fences, const SiteState& state) {
  FenceView view(fences);
  view.shift = state.placed ? &state.shift : nullptr;
  view.count -= state.is_lost() && has_design(fences) ? 1 : 0;
  return view;
}

}  // namespace graben
