// SPDX-License-Identifier: Apache-2.0
#include "app/machines/second_section.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/machines/axis_names.hpp"

namespace graben::machines {
namespace {

/// Of an encoder on a link's pin within 0.1 deg, at 0.8 m from the cylinder, beside a stroke sensor
/// within 2 mm: 3.4 mm, and what their resolutions and a worn pin add.
constexpr double kUsualOffset_m = 0.005;
/// Of two encoders within 0.1 deg each.
constexpr double kUsualSwingOffset_rad = 0.005;
/// Of a sound pin, and what both resolve.
constexpr double kUsualPlay_m = 0.001;
/// Of a ring gear with its pinion.
constexpr double kUsualSwingPlay_rad = 0.002;
/// Of a linkage whose pins are measured to 2 mm in a metre.
constexpr double kUsualScale = 0.002;
/// An encoder's cycle and a node's that converts.
constexpr double kUsualAge_s = 0.02;

}  // namespace

SecondSensors read_seconds(TomlReader& reader, bool has_swing) {
  SecondSensors second;
  if (!reader.has("second")) {
    return second;
  }
  for (unsigned i = 0; i < kDriveCount; ++i) {
    const std::string key = std::string("second.") + kDriveNames[i];
    second.has[i] = reader.boolean_or(
        false, key,
        "this joint has a second sensor: strokes in SecondStrokes, the swing's angle "
        "in SecondSwing");
  }
  second.offset_m =
      reader.number_or(kUsualOffset_m, "second.offset", {0.0005, 0.1, "m"},
                       "so far the two strokes of a cylinder may differ, anywhere in its travel: "
                       "zeros and linkage as they are installed");
  second.swing_offset_rad =
      reader.number_or(kUsualSwingOffset_rad, "second.swing_offset", {0.0005, 0.1, "rad"},
                       "the same of the swing's two angles");
  second.play_m =
      reader.number_or(kUsualPlay_m, "second.play", {0.0002, 0.1, "m"},
                       "so far the strokes' difference may change in motion: noise, play of pins");
  second.swing_play_rad = reader.number_or(kUsualSwingPlay_rad, "second.swing_play",
                                           {0.0002, 0.1, "rad"}, "the same of the swing's");
  second.scale = reader.number_or(kUsualScale, "second.scale", {0.0, 0.05, ""},
                                  "so much more of both for each metre or radian: of what is "
                                  "shown, and of the way since then");
  if (reader.has("second.age")) {
    const std::vector<double> age = reader.numbers(
        "second.age", {0.0, 0.1, "s"}, 2,
        "least and most: so much older than a first sensor's reading is a second's when its frame "
        "comes; 0 and 0.02 without it");
    second.least_age_s = age[0];
    second.most_age_s = age[1];
    if (age[0] > age[1]) {
      reader.fail("second.age", fmt::format("least {:g}, most {:g}; allowed: a least of at most "
                                            "the most",
                                            age[0], age[1]));
    }
  } else {
    second.most_age_s = kUsualAge_s;
  }
  second.arms_without =
      reader.boolean_or(false, "second.arms_without",
                        "the machine arms, and goes slowly, where a second sensor is missing");
  if (!second.any() && !reader.lists()) {
    reader.fail("second", "names no joint; allowed: boom, arm, bucket or swing = true");
  }
  if (second.has[kSwing] && !has_swing) {
    reader.fail("second.swing", "the machine has no swing drive; allowed: with valve.swing");
  }
  return second;
}

void fit_usual_seconds(ExcavatorProfile& profile) {
  SecondSensors& second = profile.second;
  for (int i = 0; i < profile.drive_count; ++i) {
    second.has[static_cast<unsigned>(i)] = true;
  }
  second.offset_m = kUsualOffset_m;
  second.swing_offset_rad = kUsualSwingOffset_rad;
  second.play_m = kUsualPlay_m;
  second.swing_play_rad = kUsualSwingPlay_rad;
  second.scale = kUsualScale;
  second.most_age_s = kUsualAge_s;
}

}  // namespace graben::machines
