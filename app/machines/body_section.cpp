// SPDX-License-Identifier: Apache-2.0
#include "app/machines/body_section.hpp"

#include <fmt/format.h>

#include <vector>

#include "app/machines/toml_reader.hpp"

namespace graben::machines {
namespace {

Counterweight read_counterweight(TomlReader& reader) {
  Counterweight weight;
  const std::string at = "body.counterweight.";
  if (!reader.has("body.counterweight")) {
    return weight;
  }
  weight.radius_m = reader.number(at + "radius", {0.5, 10.0, "m"},
                                  "swing axis to the counterweight's farthest point");
  const double width_m =
      reader.number(at + "width", {0.5, 10.0, "m"}, "of the counterweight, less than its diameter");
  weight.half_width_m = 0.5 * width_m;
  weight.corner_m = reader.number(at + "corner", {0.0, 3.0, "m"},
                                  "radius of its corners, seen from above; at most half the width");
  const std::vector<double> height = reader.numbers(at + "height", {0.0, 10.0, "m"}, 2,
                                                    "from the one to the other, above the ground");
  weight.low_m = height[0];
  weight.high_m = height[1];
  if (weight.half_width_m >= weight.radius_m) {
    reader.fail(at + "width", fmt::format("{} m; allowed: less than twice the radius, {} m",
                                          width_m, 2.0 * weight.radius_m));
  }
  if (weight.corner_m > weight.half_width_m) {
    reader.fail(at + "corner", fmt::format("{} m; allowed: at most half the width, {} m",
                                           weight.corner_m, weight.half_width_m));
  }
  if (weight.high_m < weight.low_m) {
    reader.fail(at + "height", "must be given as [lower, upper]");
  }
  return weight;
}

}  // namespace

ExcavatorBody read_outline(TomlReader& reader) {
  ExcavatorBody body;
  const Range radius{0.0, 2.0, "m"};
  body.counterweight = read_counterweight(reader);
  if (!reader.has("bucket.width")) {
    return body;
  }
  body.bucket_width_m = reader.number("bucket.width", {0.1, 5.0, "m"},
                                      "of the edge, for fences; without it they guard the edge's "
                                      "middle and the pins as points");
  body.floor_m = reader.number("bucket.floor", {0.1, 3.0, "m"},
                               "from the teeth to the heel; with bucket.width");
  body.floor_rad =
      reader.number("bucket.floor_angle", {0.1, 1.4, "rad"},
                    "from the line teeth to bucket pin down to the floor; with bucket.width");
  body.boom_bend_m = reader.point("boom.bend", {-10.0, 10.0, "m"},
                                  "where the boom's line bends, boom frame; with bucket.width");
  body.capacity_m3 =
      reader.number("bucket.capacity", {0.005, 30.0, "m3"},
                    "of loose soil, heaped: what a dig in layers fills; with bucket.width");
  body.boom_radius_m = reader.number("boom.radius", radius,
                                     "of what is round the line of boom foot, bend and arm pin, "
                                     "cylinders and hoses with it; with bucket.width");
  body.arm_radius_m = reader.number("arm.radius", radius,
                                    "the same round the line of the arm's pins; with bucket.width");
  return body;
}

FenceProfile read_fence_margins(TomlReader& reader) {
  FenceProfile fence{2.1e-3, 3.1e-3, 0.02, 0.01, 0.03};
  if (!reader.has("fence")) {
    return fence;
  }
  fence.stroke_error_m =
      reader.number("fence.stroke_error", {0.0, 0.1, "m"},
                    "a stroke may be so far from what is measured: bias and resolution; without "
                    "[fence] 2.1e-3, the others 3.1e-3, 0.02, 0.01 and 0.03");
  fence.swing_error_rad =
      reader.number("fence.swing_error", {0.0, 0.1, "rad"},
                    "the same of the swing's angle, and what the platform swings about its place");
  fence.give_m = reader.number(
      "fence.give", {0.0, 1.0, "m"},
      "so far a point goes on, on its oil and by its lag, where its drives are stopped");
  fence.room_m = reader.number("fence.room", {0.0, 1.0, "m"},
                               "so much more a planned way keeps from a fence than the machine is "
                               "held at");
  fence.room_s = reader.number("fence.room_per_speed", {0.0, 1.0, "s"},
                               "and so much more for each m/s of a point's planned speed");
  return fence;
}

}  // namespace graben::machines
