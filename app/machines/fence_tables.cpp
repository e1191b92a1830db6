// SPDX-License-Identifier: Apache-2.0
#include "app/machines/fence_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "app/machines/toml_reader.hpp"

namespace graben::machines {
namespace {

enum class FenceKind { kCeiling = 0, kFloor = 1, kWall = 2, kBox = 3, kCylinder = 4 };

constexpr Range kFencePlace{-30.0, 30.0, "m"};
/// What is thinner than the sensors are sure of is no place to keep out of.
constexpr Range kSize{0.05, 60.0, "m"};

/// Above this a plane is level, upwards or downwards.
constexpr double kLevel = 0.999;

Fence read_wall(TomlReader& reader, const std::string& at) {
  Fence fence;
  const Eigen::Vector2d through_m =
      reader.point(at + ".through", kFencePlace, "a point of the wall: x, y");
  fence.normal =
      read_direction(reader, at + ".normal", 2, "towards the side that is forbidden: x, y");
  fence.offset_m = fence.normal.head<2>().dot(through_m);
  return fence;
}

Fence read_level(TomlReader& reader, const std::string& at, double up) {
  Fence fence;
  fence.normal = up * Eigen::Vector3d::UnitZ();
  fence.offset_m = up * reader.number(at + ".height", kFencePlace, "height of ceiling or floor");
  return fence;
}

void read_heights(TomlReader& reader, const std::string& at, Fence& fence) {
  const std::vector<double> height =
      reader.numbers(at + ".heights", kFencePlace, 2,
                     "lower and upper end of a box or cylinder, above the ground");
  if (height[1] - height[0] < kSize.least) {
    reader.fail(at + ".heights",
                fmt::format("[{}, {}] m; allowed: lower, then upper end, at least {} m higher",
                            height[0], height[1], kSize.least));
  }
  fence.centre_m.z() = 0.5 * (height[0] + height[1]);
  fence.half_m.z() = 0.5 * (height[1] - height[0]);
}

Fence read_box(TomlReader& reader, const std::string& at) {
  Fence fence;
  fence.shape = FenceShape::kBox;
  fence.centre_m.head<2>() = reader.point(at + ".centre", kFencePlace,
                                          "middle of a box or cylinder, seen from above: x, y");
  const std::vector<double> size =
      reader.numbers(at + ".size", kSize, 2, "sides of a box, seen from above");
  fence.half_m.head<2>() << 0.5 * size[0], 0.5 * size[1];
  const double turn_rad = reader.number_or(0.0, at + ".turn", {-3.2, 3.2, "rad"},
                                           "of a box's first side against x, to the left");
  fence.normal = {std::cos(turn_rad), std::sin(turn_rad), 0.0};
  read_heights(reader, at, fence);
  return fence;
}

Fence read_cylinder(TomlReader& reader, const std::string& at) {
  Fence fence;
  fence.shape = FenceShape::kCylinder;
  fence.centre_m.head<2>() = reader.point(at + ".centre", kFencePlace,
                                          "middle of a box or cylinder, seen from above: x, y");
  const double radius_m =
      reader.number(at + ".radius", {0.05, 30.0, "m"}, "of an upright cylinder");
  fence.half_m.head<2>().setConstant(radius_m);
  read_heights(reader, at, fence);
  return fence;
}

}  // namespace

Eigen::Vector3d read_direction(TomlReader& reader, const std::string& key, std::size_t count,
                               const char* help) {
  constexpr double kLeast = 1e-3;
  std::vector<double> values = reader.numbers(key, {-1e3, 1e3, ""}, count, help);
  values.resize(3, 0.0);
  const Eigen::Vector3d direction(values[0], values[1], values[2]);
  if (direction.norm() < kLeast) {
    reader.fail(key, "has no direction");
    return Eigen::Vector3d::UnitZ();
  }
  return direction.normalized();
}

Fence read_fence(TomlReader& reader, const std::string& at) {
  if (reader.lists() && reader.has(at)) {
    static_cast<void>(read_wall(reader, at));
    static_cast<void>(read_box(reader, at));
    static_cast<void>(read_cylinder(reader, at));
  }
  switch (static_cast<FenceKind>(reader.choice(
      at + ".kind", {"ceiling", "floor", "wall", "box", "cylinder"}, "kind of fence"))) {
    case FenceKind::kCeiling:
      return read_level(reader, at, 1.0);
    case FenceKind::kFloor:
      return read_level(reader, at, -1.0);
    case FenceKind::kWall:
      return read_wall(reader, at);
    case FenceKind::kBox:
      return read_box(reader, at);
    case FenceKind::kCylinder:
      break;
  }
  return read_cylinder(reader, at);
}

std::string fence_text(const Fence& fence) {
  const Eigen::Vector3d& centre_m = fence.centre_m;
  if (fence.is_surface()) {
    return "design surface";
  }
  if (fence.shape == FenceShape::kBox) {
    return fmt::format("box at {:.2f}, {:.2f} m", centre_m.x(), centre_m.y());
  }
  if (fence.shape == FenceShape::kCylinder) {
    return fmt::format("cylinder at {:.2f}, {:.2f} m", centre_m.x(), centre_m.y());
  }
  const double up = fence.normal.z();
  if (up > kLevel) {
    return fmt::format("ceiling at {:.2f} m", fence.offset_m);
  }
  if (up < -kLevel) {
    return fmt::format("floor at {:.2f} m", -fence.offset_m);
  }
  return "wall";
}

}  // namespace graben::machines
