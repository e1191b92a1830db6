// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_file.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::cli {
namespace {

using nlohmann::ordered_json;

using machines::kAxisNames;

const char* reach_name(ReachStatus status) {
  switch (status) {
    case ReachStatus::kOk:
      return "ok";
    case ReachStatus::kOutOfReach:
      return "out_of_reach";
    case ReachStatus::kBoomStroke:
      return "boom_stroke";
    case ReachStatus::kArmStroke:
      return "arm_stroke";
    case ReachStatus::kBucketStroke:
      return "bucket_stroke";
    case ReachStatus::kLinkageOpen:
      return "linkage_open";
    case ReachStatus::kSingular:
      return "singular";
    case ReachStatus::kNotFinite:
      return "not_finite";
  }
  return "unknown";
}

ExcavatorKinematics load_kinematics(const std::string& profile) {
  return ExcavatorKinematics(
      machines::load_excavator(machines::find_profile(profile)).profile.geometry);
}

void check_strokes(const ExcavatorGeometry& geometry, const std::vector<double>& strokes_m) {
  std::string errors;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double most_m = geometry.cylinder[i].stroke_m;
    const std::string told = std::isfinite(strokes_m[i])
                                 ? fmt::format("stroke {} m", strokes_m[i])
                                 : fmt::format("stroke: {} is no length", strokes_m[i]);
    // Written so that NaN fails too.
    if (!(strokes_m[i] >= 0.0 && strokes_m[i] <= most_m)) {
      errors += fmt::format("{}{} {}; allowed: 0 .. {} m", errors.empty() ? "" : "; ",
                            kAxisNames[i], told, most_m);
    }
  }
  if (!errors.empty()) {
    throw std::runtime_error(errors);
  }
}

void print_pose(const std::string& profile, const std::vector<double>& strokes_m,
                const double* swing_rad) {
  const ExcavatorKinematics kinematics = load_kinematics(profile);
  check_strokes(kinematics.geometry(), strokes_m);
  const JointResult joints =
      kinematics.joints_from_strokes({strokes_m[kBoom], strokes_m[kArm], strokes_m[kBucket]});
  if (joints.status != ReachStatus::kOk) {
    throw std::runtime_error(fmt::format("no pose there: {}", reach_name(joints.status)));
  }
  const TipPose pose = kinematics.pose_from_joints(joints.joints_rad);
  ordered_json result;
  result["x_m"] = pose.x_m;
  result["y_m"] = pose.y_m;
  result["attitude_rad"] = pose.attitude_rad;
  result["joints_rad"] = {joints.joints_rad[kBoom], joints.joints_rad[kArm],
                          joints.joints_rad[kBucket]};
  if (swing_rad != nullptr) {
    const SwingKinematics swinging(kinematics.geometry());
    DriveVector joints_rad;
    joints_rad << joints.joints_rad, *swing_rad;
    const Eigen::Vector3d at = swinging.teeth_from_joints(joints_rad).position_m;
    result["swing_rad"] = *swing_rad;
    result["position_m"] = {at.x(), at.y(), at.z()};
  }
  fmt::print("{}\n", result.dump());
}

void print_strokes(const std::string& profile, const TipPose& pose) {
  const StrokeResult strokes = load_kinematics(profile).strokes_from_pose(pose);
  ordered_json result;
  result["strokes_m"] = nullptr;
  if (strokes.status == ReachStatus::kOk) {
    result["strokes_m"] = {strokes.strokes_m[kBoom], strokes.strokes_m[kArm],
                           strokes.strokes_m[kBucket]};
  }
  result["status"] = reach_name(strokes.status);
  fmt::print("{}\n", result.dump());
}

}  // namespace

void add_pose(CLI::App& app, int& status) {
  struct PoseCommand {
    std::string profile;
    std::vector<double> strokes_m;
    double swing_rad = 0.0;
  };
  auto options = std::make_shared<PoseCommand>();
  CLI::App* command = add_command(app, "pose");
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->required();
  command
      ->add_option("--strokes", options->strokes_m,
                   "Boom,arm,bucket in m, counted from the closed cylinder")
      ->required()
      ->delimiter(',')
      ->expected(3);
  CLI::Option* swing = command->add_option(
      "--swing", options->swing_rad,
      "Swing in rad, left positive: adds the teeth's position in the ground frame, as in plan");
  add_examples(*command, {"pose --profile excavator_22t --strokes 1.0,1.1,0.4"});
  command->callback([options, swing, &status] {
    status = guarded("pose", [&] {
      assert_radians("--swing", options->swing_rad);
      print_pose(options->profile, options->strokes_m,
                 swing->count() > 0 ? &options->swing_rad : nullptr);
    });
  });
}

void add_strokes(CLI::App& app, int& status) {
  struct PoseCommand {
    std::string profile;
    TipPose pose;
  };
  auto options = std::make_shared<PoseCommand>();
  CLI::App* command = add_command(app, "strokes");
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->required();
  command->add_option("--x", options->pose.x_m, "Tip, forward of the boom foot, m")->required();
  command->add_option("--y", options->pose.y_m, "Tip, above the boom foot, m")->required();
  command
      ->add_option("--attitude", options->pose.attitude_rad,
                   "Direction from the tip to the bucket pin, rad")
      ->required();
  add_examples(*command, {"strokes --profile excavator_22t --x 6 --y -1 --attitude 1.5"});
  command->callback([options, &status] {
    status = guarded("strokes", [&] {
      assert_radians("--attitude", options->pose.attitude_rad);
      print_strokes(options->profile, options->pose);
    });
  });
}

}  // namespace graben::cli
