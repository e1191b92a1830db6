#include "firmware/excavator/tasks/dig_layers.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr double kDepthLeast_m = 0.06;
/// A bucket is full before it has come to the line's end.
constexpr double kFullAt = 0.8;
/// Over the soil, that the edge comes down from.
constexpr double kOver_m = 0.25;
/// Before the soil that is to be cut, where there is room.
constexpr double kRunUp_m = 0.25;
/// Of what is given way to: lighter cuts become deeper.
constexpr double kLight = 0.6;
constexpr double kDeeper = 1.15;
constexpr double kShallower = 0.75;

double share_of(int bin) { return (bin + 0.5) / kStripBins; }

/// First bin of a strip in which soil stands over the height by more; kStripBins: none.
int first_over(const CutState& state, int strip, double height_m) {
  const auto& bins = state.height_m[static_cast<unsigned>(strip)];
  int bin = 0;
  while (bin < kStripBins && static_cast<double>(bins[static_cast<unsigned>(bin)]) <= height_m) {
    ++bin;
  }
  return bin;
}

double over_layer_m(const CutState& state) {
  return state.layer_m > 0.0 ? std::max(kRough_m, kRoughShare * state.depth_m) : kFinish_m;
}

double highest_m(const LayerPlan& plan, const CutState& state) {
  float highest = 0.0F;
  for (int strip = 0; strip < plan.strips; ++strip) {
    const auto& bins = state.height_m[static_cast<unsigned>(strip)];
    highest = std::max(highest, *std::max_element(bins.begin(), bins.end()));
  }
  return static_cast<double>(highest);
}

/// Below what stands highest, but for the last layer, which is thin.
double next_layer_m(double highest, double depth_m) {
  if (highest <= kLastLayer_m + kRough_m) {
    return 0.0;
  }
  return std::max(kLastLayer_m, highest - depth_m);
}

/// What stays up is taken for gone.
void give_up(CutState& state) {
  auto& bins = state.height_m[static_cast<unsigned>(state.cut.strip)];
  const auto left = static_cast<float>(state.layer_m);
  for (float& height : bins) {
    height = std::min(height, left);
  }
}

bool take(const LayerPlan& plan, CutState& state) {
  for (int strip = 0; strip < plan.strips; ++strip) {
    const int bin = first_over(state, strip, state.layer_m + over_layer_m(state));
    if (bin == kStripBins) {
      continue;
    }
    const double run_up = bin > 0 ? kRunUp_m / plan.way_m : 0.0;
    const double from =
        bin > 0 ? std::max(0.0, static_cast<double>(bin) / kStripBins - run_up) : 0.0;
    const bool again = strip == state.cut.strip && state.layer_m == state.cut.height_m &&
                       std::abs(from - state.cut.from_share) < 1.0 / kStripBins;
    state.tries = again ? static_cast<std::uint8_t>(state.tries + 1) : std::uint8_t{0};
    state.cut = {strip, from, state.layer_m,
                 std::max(ground_m(plan, from), state.layer_m) + kOver_m};
    return true;
  }
  return false;
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
  state.depth_m = std::clamp(plan.full_m3 / (kFullAt * plan.way_m * plan.width_m), kDepthLeast_m,
                             plan.depth_most_m);
  state.layer_m = next_layer_m(highest_m(plan, state), state.depth_m);
  state.cut.strip = -1;
  state.met = false;
  next_cut(plan, state);
  return state;
}

double pass(const LayerPlan& plan, double share, double last_share, double height_m,
            CutState& state) {
  auto& bins = state.height_m[static_cast<unsigned>(state.cut.strip)];
  const double bin_m2 = plan.way_m / kStripBins * plan.width_m;
  const int first = static_cast<int>(std::ceil(last_share * kStripBins - 0.5));
  double cut_m3 = 0.0;
  for (int bin = std::max(0, first); bin < kStripBins && share_of(bin) <= share; ++bin) {
    float& left = bins[static_cast<unsigned>(bin)];
    const auto gone_m = static_cast<double>(left) - height_m;
    if (gone_m > 0.0) {
      cut_m3 += gone_m * bin_m2;
      left = static_cast<float>(height_m);
    }
  }
  return cut_m3;
}

void next_cut(const LayerPlan& plan, CutState& state) {
  // Every layer is at least half of the last one lower, or the last; each may have to be left.
  constexpr int kMost = 64;
  if (state.cuts >= kCutsMost) {
    state.met = true;
    return;
  }
  ++state.cuts;
  for (int n = 0; n < kMost; ++n) {
    if (take(plan, state)) {
      if (state.tries < kTriesMost) {
        return;
      }
      give_up(state);
      state.tries = 0;
    } else if (state.layer_m <= 0.0) {
      break;
    } else {
      state.layer_m = next_layer_m(state.layer_m, state.depth_m);
    }
  }
  state.met = true;
}

void after_cut(const LayerPlan& plan, double heaviest, CutState& state) {
  const double factor = heaviest > 1.0 ? kShallower : heaviest < kLight ? kDeeper : 1.0;
  state.depth_m = std::clamp(factor * state.depth_m, kDepthLeast_m, plan.depth_most_m);
}

}  // namespace graben
