// SPDX-License-Identifier: Apache-2.0
#include "app/identify/motion_rivals.hpp"

#include "app/identify/joint_model.hpp"

namespace graben::identify {
namespace {

SimpleRun simple_run(const MotionRun& run, std::size_t joint, char judged) {
  SimpleRun simple;
  simple.time_s = run.time_s;
  simple.command.assign(run.command.begin(), run.command.end());
  simple.velocity = run.velocity_radps[joint];
  simple.pose.resize(kPose);
  for (std::size_t row = 0; row < run.size(); ++row) {
    simple.since.push_back(run.by_angle[joint] ? run.since[row] : row);
    const Pose pose = pose_of(angles_at(run, row));
    for (std::size_t part = 0; part < kPose; ++part) {
      simple.pose[part].push_back(pose[part]);
    }
  }
  simple.judged.assign(run.size(), judged);
  return simple;
}

}  // namespace

std::array<Rivals, kJoints> fit_rivals(const std::vector<MotionRun>& train,
                                       const std::vector<MotionRun>& judge) {
  std::array<Rivals, kJoints> rivals;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    std::vector<SimpleRun> runs;
    for (const MotionRun& run : train) {
      runs.push_back(simple_run(run, joint, 0));
    }
    for (const MotionRun& run : judge) {
      runs.push_back(simple_run(run, joint, 1));
    }
    rivals[joint] = {fit_curve(runs, joint), fit_ridge(runs, joint)};
  }
  return rivals;
}

}  // namespace graben::identify
