// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/dig_layers.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

double share_of(int bin) { return (bin + 0.5) / kStripBins; }

double bin_m2(const LayerPlan& plan) { return plan.way_m / kStripBins * plan.width_m; }

using Strip = std::array<float, kStripBins>;

const Strip& strip_of(const CutState& state, int strip) {
  return state.height_m[static_cast<unsigned>(strip)];
}

double highest_m(const Strip& strip) {
  return static_cast<double>(*std::max_element(strip.begin(), strip.end()));
}

/// What stands over a height, m3.
double volume_m3(const LayerPlan& plan, const Strip& strip, double height_m) {
  double sum_m = 0.0;
  for (const float top : strip) {
    sum_m += std::max(0.0, static_cast<double>(top) - height_m);
  }
  return sum_m * bin_m2(plan);
}

/// Over the design, on average.
double mean_m(const LayerPlan& plan, const Strip& strip) {
  return volume_m3(plan, strip, 0.0) / (plan.way_m * plan.width_m);
}

bool is_done(const LayerPlan& plan, const Strip& strip) {
  int rough = 0;
  double most_m = 0.0;
  for (int bin = 0; bin < kStripBins; ++bin) {
    const double steep = std::max(0.0, 1.0 - share_of(bin) * plan.way_m / plan.turns_m);
    const double allowed_m = bin == kStripBins - 1 ? kEnd_m : kFinish_m + kSteepHigher_m * steep;
    const double over_m = static_cast<double>(strip[static_cast<unsigned>(bin)]) - allowed_m;
    rough += over_m > 0.0 ? 1 : 0;
    most_m = std::max(most_m, over_m);
  }
  return rough == 0 || (rough == 1 && most_m <= kOnePlace_m);
}

/// The strip that stands highest of those that are not done; -1: all are.
int next_strip(const LayerPlan& plan, const CutState& state) {
  int next = -1;
  for (int strip = 0; strip < plan.strips; ++strip) {
    const bool higher = next < 0 || mean_m(plan, strip_of(state, strip)) >
                                        mean_m(plan, strip_of(state, next)) + 0.5 * kRough_m;
    if (!is_done(plan, strip_of(state, strip)) && higher) {
      next = strip;
    }
  }
  return next;
}

/// The lowest height that no more soil stands over than there is room for.
double filling_height_m(const LayerPlan& plan, const Strip& strip, double room_m3) {
  constexpr int kHalvings = 20;  ///< Halvings of a height. [-; size: 1 m down to 1 um]
  double low_m = 0.0;
  double high_m = highest_m(strip);
  if (volume_m3(plan, strip, low_m) <= room_m3) {
    return low_m;
  }
  for (int n = 0; n < kHalvings; ++n) {
    const double middle_m = 0.5 * (low_m + high_m);
    (volume_m3(plan, strip, middle_m) > room_m3 ? low_m : high_m) = middle_m;
  }
  return high_m;
}

/// A little more than fills the bucket, shared evenly, where that saves a round.
double room_of(const LayerPlan& plan, const Strip& strip, double full_m3) {
  const double above_m3 = volume_m3(plan, strip, kSparedAt_share * plan.bucket_m);
  const double fewest = std::ceil(above_m3 / (kOverfill * full_m3));
  return fewest >= 1.0 && fewest < std::ceil(above_m3 / full_m3) ? above_m3 / fewest : full_m3;
}

Cut cut_of(const LayerPlan& plan, const CutState& state, int strip) {
  const Strip& tops = strip_of(state, strip);
  const double highest = highest_m(tops);
  Cut cut;
  cut.strip = strip;
  cut.thin = highest <= kThinMost_share * plan.bucket_m;
  if (!cut.thin) {
    const double room_m3 = room_of(plan, tops, filling_m3(plan, state));
    cut.height_m =
        std::max({kLastLayer_share * plan.bucket_m, filling_height_m(plan, tops, room_m3),
                  mean_m(plan, tops) - state.depth_m, highest - kBump * state.depth_m});
  }
  const double over_m = cut.height_m + (cut.thin ? kFinish_m : kRough_m);
  int bin = 0;
  while (bin < kStripBins - 1 && static_cast<double>(tops[static_cast<unsigned>(bin)]) <= over_m) {
    ++bin;
  }
  if (bin > 0) {
    cut.from_share = std::max(
        0.0, static_cast<double>(bin) / kStripBins - kRunUp_share * plan.bucket_m / plan.way_m);
  }
  cut.stands_m = highest;
  cut.enters_m =
      std::max(ground_m(plan, cut.from_share), cut.height_m) + kEntersOver_share * plan.bucket_m;
  cut.volume_m3 = volume_m3(plan, tops, cut.height_m);
  return cut;
}

/// What stays up is taken for gone, so far along the line.
void give_up(double until_share, CutState& state) {
  const auto left = static_cast<float>(state.cut.height_m);
  auto& bins = state.height_m[static_cast<unsigned>(state.cut.strip)];
  for (int bin = 0; bin < kStripBins && share_of(bin) <= until_share; ++bin) {
    float& height = bins[static_cast<unsigned>(bin)];
    height = std::min(height, left);
  }
}

void choose(const LayerPlan& plan, CutState& state) {
  const int strip = next_strip(plan, state);
  state.met = strip < 0 || state.cuts >= kCutsMost;
  if (!state.met) {
    ++state.cuts;
    state.cut = cut_of(plan, state, strip);
  }
}

/// One that soil has fallen into, the last one first; -1: there is none, or it was swept enough.
int restless_strip(const LayerPlan& plan, const CutState& state, int last) {
  int found = -1;
  for (int strip = 0; strip < plan.strips; ++strip) {
    const auto at = static_cast<unsigned>(strip);
    const bool restless = state.moves[at] && state.sweeps[at] < kSweepsMost;
    if (restless && (found < 0 || strip == last)) {
      found = strip;
    }
  }
  return found;
}

/// Depth of the next cut, of this one's.
double deeper_by(const LayerPlan& plan, const CutEnd& end, const CutState& state) {
  const double wanted_m3 = std::min(state.cut.volume_m3, filling_m3(plan, state));
  if (!state.cut.thin && end.share > kGaveWayFrom && end.heavy > kCutLight &&
      end.filled_m3 < kGaveWay * wanted_m3) {
    return std::max(kShallowest, end.filled_m3 / (kGaveWay * wanted_m3) * kShallower);
  }
  return end.heavy > kCutHeavy ? kShallower : end.heavy < kCutLight ? kDeeper : 1.0;
}

void sweep(const LayerPlan& plan, int strip, CutState& state) {
  const auto at = static_cast<unsigned>(strip);
  ++state.sweeps[at];
  state.moves[at] = false;
  for (float& height : state.height_m[at]) {
    height = std::max(height, static_cast<float>(kRough_m));
  }
  choose(plan, state);
  state.swept = true;
}

}  // namespace

double ground_m(const LayerPlan& plan, double share) {
  return plan.ground_from_m + share * (plan.ground_to_m - plan.ground_from_m);
}

CutState undug(const LayerPlan& plan) {
  CutState state;
  for (int strip = 0; strip < plan.strips; ++strip) {
    for (int bin = 0; bin < kStripBins; ++bin) {
      state.height_m[static_cast<unsigned>(strip)][static_cast<unsigned>(bin)] =
          static_cast<float>(std::max(0.0, ground_m(plan, share_of(bin))));
    }
  }
  state.depth_m = std::clamp(plan.full_m3 / (kFullAt * plan.way_m * plan.width_m),
                             kDepthLeast_share * plan.bucket_m, plan.depth_most_m);
  choose(plan, state);
  return state;
}

double pass(const LayerPlan& plan, double share, double last_share, double height_m,
            CutState& state) {
  auto& bins = state.height_m[static_cast<unsigned>(state.cut.strip)];
  const int first = static_cast<int>(std::ceil(last_share * kStripBins - 0.5));
  double cut_m3 = 0.0;
  for (int bin = std::max(0, first); bin < kStripBins && share_of(bin) <= share; ++bin) {
    float& left = bins[static_cast<unsigned>(bin)];
    const auto gone_m = static_cast<double>(left) - height_m;
    if (gone_m > 0.0) {
      cut_m3 += gone_m * bin_m2(plan);
      left = static_cast<float>(height_m);
    }
  }
  return cut_m3;
}

void next_cut(const LayerPlan& plan, const CutEnd& end, CutState& state) {
  const double least_m = kDepthLeast_share * plan.bucket_m;
  const double factor = deeper_by(plan, end, state);
  // What less depth may still get is not given up.
  const bool may_get_more = !state.cut.thin && factor < 1.0 && state.depth_m > least_m;
  if (factor < 1.0 && state.depth_m <= kHarderFrom * least_m) {
    state.force = std::min(kHarder * state.force, kForceMost / kForceUsed);
  }
  state.depth_m = std::clamp(factor * state.depth_m, least_m, plan.depth_most_m);
  state.loaded_m3 += end.filled_m3;
  const int strip = state.cut.strip;
  const bool little = end.filled_m3 < kLittle * plan.full_m3;
  state.filled_m3 = 0.0;
  const int tries = little ? state.tries + (may_get_more ? 0 : 1) : 0;
  state.tries = static_cast<std::uint8_t>(tries);
  // A wall that stops a sweep has not fallen in: what is left is swept from within.
  const bool stopped = state.swept && end.heavy > 1.0 && little && state.cut.from_share < 0.0;
  state.wall_falls = state.wall_falls && !stopped;
  if (!stopped && state.tries >= (state.cut.thin ? kThinTriesMost : kTriesMost)) {
    give_up(end.share + kPastStop, state);
    state.tries = 0;
  }
  state.last_strip = strip;
  // Nobody knows what stands before a sweep.
  state.last_m3 = state.swept ? 0.0 : state.loaded_m3;
  state.swept = stopped;
  choose(plan, state);
  if (state.cut.strip != strip) {
    state.tries = 0;
  }
}

void abandon_cut(const LayerPlan& plan, CutState& state) {
  state.loaded_m3 += state.filled_m3;
  state.filled_m3 = 0.0;
  state.last_strip = -1;
  state.swept = false;
  choose(plan, state);
}

double filling_m3(const LayerPlan& plan, const CutState& state) {
  return plan.full_m3 / state.yields;
}

void weigh_cut(const LayerPlan& plan, double weighed_m3, CutState& state) {
  const int strip = state.last_strip;
  // Without pressures nothing is weighed, which says nothing.
  if (strip >= 0 && weighed_m3 > 0.0 && state.last_m3 > kTells * plan.full_m3) {
    const double yields = weighed_m3 / state.last_m3;
    state.yields =
        std::clamp(state.yields + kBelieved * (yields - state.yields), kYieldsLeast, kYieldsMost);
  }
  state.last_strip = -1;
  if (strip >= 0) {
    const double still_m3 = state.last_m3 > 0.0
                                ? kFallen * plan.full_m3 + (1.0 + kPassedOff) * state.last_m3
                                : kFallenToSweep * plan.full_m3;
    const bool fallen = weighed_m3 >= still_m3;
    const bool moved = weighed_m3 >= kMovesSoil * plan.full_m3;
    state.moves[static_cast<unsigned>(strip)] = fallen || moved;
  }
  const int restless =
      state.met && state.cuts < kCutsMost ? restless_strip(plan, state, strip) : -1;
  if (restless >= 0) {
    state.wall_falls = state.wall_falls || weighed_m3 > kWallFalls * plan.full_m3 ||
                       state.sweeps[static_cast<unsigned>(restless)] >= kWallSweeps;
    sweep(plan, restless, state);
  }
}

}  // namespace graben
