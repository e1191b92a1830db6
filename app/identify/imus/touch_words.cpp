// SPDX-License-Identifier: Apache-2.0
#include "app/identify/imus/touch_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "app/identify/imus/touched_tip.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::identify {
namespace {

constexpr std::array<const char*, kAxisCount> kNames = {"boom", "arm", "bucket"};
/// A link that turns by more during a touch has sunk, or the touch was none: 0.5 deg.
constexpr double kSank_rad = 0.009;
/// A turn of a link between touches that tells it from the others.
constexpr double kEnough_rad = 0.9;

double degrees(double angle_rad) { return angle_rad * 360.0 / kTwoPi; }

/// Largest less smallest of a joint over all touches, rad.
double range_of(const TouchedTip& tip, const MountingAsk& ask, int joint) {
  double first = 0.0;
  double least = 1e9;
  double most = -1e9;
  for (const Peg& peg : ask.pegs) {
    for (const Rest& rest : peg.touches) {
      const double angle_rad = tip.joints_rad(rest, Eigen::Vector3d::Zero())[joint];
      first = least > most ? angle_rad : first;
      const double from_first = std::remainder(angle_rad - first, kTwoPi);
      least = std::min(least, from_first);
      most = std::max(most, from_first);
    }
  }
  return most - least;
}

std::string missing_movement(const TouchedTip& tip, const MountingAsk& ask) {
  const double arm_rad = range_of(tip, ask, kArm);
  const double bucket_rad = range_of(tip, ask, kBucket);
  const auto only = [](const char* link, double range_rad, const char* how) {
    return fmt::format("the {} turned by {:.0f} deg only between touches; {} ({:.0f} deg and more)",
                       link, degrees(range_rad), how, degrees(kEnough_rad));
  };
  if (bucket_rad < kEnough_rad) {
    return only("bucket", bucket_rad, "touch with it curled in and opened out");
  }
  if (arm_rad < kEnough_rad) {
    return only("arm", arm_rad, "touch a second peg, nearer or farther by some metres (--second)");
  }
  if (!ask.pegs.front().height_m && !ask.kept) {
    return "the height of the peg over the boom foot's pin, by a level (--height)";
  }
  if (ask.pegs.size() == 2 && !ask.rise_m) {
    return "how much higher the second peg is than the first (--rise), by a level";
  }
  return "more touches, each held for 10 s and longer";
}

}  // namespace

void assert_askable(const MountingAsk& ask, std::size_t least_touches) {
  if (ask.pegs.empty() || ask.pegs.front().touches.size() < least_touches) {
    throw std::runtime_error(fmt::format(
        "{} touches of the peg; at least {} are wanted, each in another posture, held for 10 s",
        ask.pegs.empty() ? 0 : ask.pegs.front().touches.size(), least_touches));
  }
  const bool level = ask.rise_m || ask.kept ||
                     std::any_of(ask.pegs.begin(), ask.pegs.end(),
                                 [](const Peg& peg) { return peg.height_m.has_value(); });
  if (!level) {
    throw std::runtime_error(
        "one combination can't be had from touches alone: all three IMUs turned alike look like a "
        "peg elsewhere. Say the peg's height over the boom foot's pin (--height, by a level), "
        "touch a second peg and say how much higher it is (--second, --rise), or name an IMU that "
        "is known to sit right (--keep)");
  }
  for (const Peg& peg : ask.pegs) {
    for (const Rest& rest : peg.touches) {
      for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
        if (std::abs(rest.turned_rad[axis]) > kSank_rad) {
          throw std::runtime_error(fmt::format(
              "the rest at {:.1f} s (line {}): the {} turned by {:.2f} deg in it; no touch of a "
              "fixed point",
              rest.begin_s, rest.line, kNames[axis], degrees(rest.turned_rad[axis])));
        }
      }
    }
  }
}

void refuse_stray(const TouchResult& touch, double off_m) {
  throw std::runtime_error(fmt::format(
      "the rest at {:.1f} s (line {}) is {:.0f} mm off the point that the others are on: no touch "
      "of it? Leave it out (--touches)",
      touch.rest.begin_s, touch.rest.line, 1e3 * off_m));
}

void refuse_scattered(const MountingFit& fit) {
  const auto worst =
      std::max_element(fit.touches.begin(), fit.touches.end(),
                       [](const auto& a, const auto& b) { return a.after_m < b.after_m; });
  throw std::runtime_error(fmt::format(
      "the touches are on no common point, however the IMUs are turned: {:.0f} mm off at {:.1f} s "
      "(line {}), {:.0f} mm RMS; allowed: {:.0f} mm. Rests that are no touches, IMUs under each "
      "other's address, 'backwards', 'on_rocker' or the links' lengths?",
      1e3 * worst->after_m, worst->rest.begin_s, worst->rest.line, 1e3 * fit.rms_m(),
      1e3 * kMostOff_m));
}

void refuse_alike(const ExcavatorProfile& profile, const MountingAsk& ask, const MountingFit& fit,
                  const Eigen::Vector3d& weakest) {
  std::string found;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    found += fmt::format("{}{} {:.1f}", axis == 0 ? "" : ", ", kNames[axis], 1e3 * fit.end_m[axis]);
  }
  const Eigen::Vector3d shown = weakest / weakest.cwiseAbs().maxCoeff();
  throw std::runtime_error(fmt::format(
      "the postures are too much alike: by the turns that were found the ends of the links are off "
      "by {} mm, standard deviation; allowed: {:.0f}. Least known is boom : arm : bucket = {:.1f} "
      ": "
      "{:.1f} : {:.1f} turned together. Missing: {}",
      found, 1e3 * kMostEnd_m, shown[0], shown[1], shown[2],
      missing_movement(TouchedTip(profile), ask)));
}

void refuse_far(std::size_t axis, double by_rad) {
  throw std::runtime_error(fmt::format(
      "the {}'s IMU would be turned by {:.0f} deg against its profile; allowed: {:.0f}. Is "
      "'backwards', 'turn' or its address wrong?",
      kNames[axis], degrees(by_rad), degrees(kMostMounting_rad)));
}

}  // namespace graben::identify
