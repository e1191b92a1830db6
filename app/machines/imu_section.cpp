// SPDX-License-Identifier: Apache-2.0
#include "app/machines/imu_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace graben::machines {
namespace {

constexpr std::array<const char*, kImuCount> kImuNames = {"boom", "arm", "bucket", "body"};

/// J1939's addresses that a sensor may have: none of ours, no global one.
constexpr int kFirstAddress = 132;
constexpr int kLastAddress = 253;

constexpr double kDegree_rad = 0.017453292519943295;
/// Honeywell TARS-LCASS, as its source address is shipped, and those after it.
constexpr std::uint8_t kUsualAddress = 0xE2;
/// Of a cylinder about its joint, at most, on machines of the class.
constexpr double kLever_m = 0.8;

ImuMount read_mount(TomlReader& reader, unsigned imu) {
  const std::string at = std::string("imu.") + kImuNames[imu] + ".";
  ImuMount mount;
  mount.address = static_cast<std::uint8_t>(
      reader.integer(at + "address", kFirstAddress, kLastAddress,
                     "J1939 source address of its frames; only with [imu]"));
  if (imu != kBodyImu) {
    mount.at_m = reader.point(at + "at", {-20.0, 20.0, "m"},
                              "where it sits, frame of its link, from the link's pin (of the "
                              "rocker's, from its pivot, x to its end); only with [imu]");
  }
  mount.turn_rad = reader.number_or(0.0, at + "turn", {-3.2, 3.2, "rad"},
                                    "its long axis against x of that frame");
  mount.backwards = reader.boolean_or(false, at + "backwards", "its front looks back");
  if (imu == kBucket) {
    mount.on_rocker = reader.boolean_or(false, at + "on_rocker",
                                        "it sits on the rocker of the linkage, not on the bucket");
  }
  return mount;
}

void check_addresses(TomlReader& reader, const ImuProfile& imu) {
  for (unsigned i = 0; i < kImuCount; ++i) {
    for (unsigned j = 0; j < i; ++j) {
      if (imu.mount[i].address != 0 && imu.mount[i].address == imu.mount[j].address) {
        reader.fail(fmt::format("imu.{}.address", kImuNames[i]),
                    fmt::format("{} is that of imu.{} too; allowed: one of its own",
                                imu.mount[i].address, kImuNames[j]));
      }
    }
  }
}

}  // namespace

ImuProfile read_imus(TomlReader& reader) {
  ImuProfile imu;
  if (!reader.has("imu")) {
    return imu;
  }
  static_cast<void>(reader.choice("imu.protection", {"range"},
                                  "what stands in for counter and CRC, which the frames of the "
                                  "standard lack; only with [imu]"));
  for (unsigned i = 0; i < kImuCount; ++i) {
    if (i != kBodyImu || reader.has("imu.body")) {
      imu.mount[i] = read_mount(reader, i);
    }
  }
  imu.rate_noise_radps = reader.number(
      "imu.rate_noise", {1e-5, 0.1, "rad/s"},
      "standard deviation of one reading of a gyro, vibration with it; only with [imu]");
  imu.rate_bias_radps = reader.number("imu.rate_bias", {1e-5, 0.1, "rad/s"},
                                      "the same of its bias, before it is learnt at rest");
  imu.force_noise_mps2 = reader.number("imu.acceleration_noise", {1e-3, 10.0, "m/s2"},
                                       "the same of one reading of an accelerometer, vibration "
                                       "with it; only with [imu]");
  imu.angle_error_rad = reader.number("imu.angle_error", {0.0, 0.1, "rad"},
                                      "the same of what each is off for good: alignment and "
                                      "accelerometer; only with [imu]");
  imu.latency_s = reader.number_or(0.0, "imu.latency", {0.0, 0.1, "s"},
                                   "age of a reading, of a sensor that does not say it");
  check_addresses(reader, imu);
  if (reader.has("sensors.stroke_zero")) {
    reader.fail("sensors.stroke_zero", "there is no stroke sensor beside [imu]");
  }
  return imu;
}

void fit_usual_imus(ExcavatorProfile& profile) {
  const ExcavatorGeometry& geometry = profile.geometry;
  const std::array<double, kAxisCount> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                                   geometry.bucket_length_m};
  ImuProfile& imu = profile.imu;
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    imu.mount[axis].address = static_cast<std::uint8_t>(kUsualAddress + axis);
    imu.mount[axis].at_m = {0.5 * length_m[axis], 0.0};
  }
  imu.rate_noise_radps = 0.1 * kDegree_rad;
  imu.rate_bias_radps = 0.2 * kDegree_rad;
  imu.force_noise_mps2 = 0.3;
  imu.angle_error_rad = 0.2 * kDegree_rad / std::sqrt(3.0);
  imu.latency_s = 0.02;
  // Two links' errors make a joint's.
  profile.fence.stroke_error_m =
      std::max(profile.fence.stroke_error_m, 2.0 * 0.2 * kDegree_rad * kLever_m);
}

}  // namespace graben::machines
