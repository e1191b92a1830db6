// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine's setup as constant data: worked out by write_setup where the images are built, so
/// that it lies in flash. Its types are Eigen's too, which GCC cannot initialise before the start;
/// therefore it is written as the bytes that it has on the machine that wrote it, and kLayout says
/// whether they mean the same on the one that reads it.
/// Beside it a run of the simulated machine as frames.

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/excavator/excavator_controller.hpp"

namespace graben::memory {

template <class Setup>
struct HeldSetup {
  const Setup& setup;
  std::uint32_t profile_hash;
};

/// A setup by its bytes: written as the one, read as the other.
template <class Setup>
union SetupBytes {
  std::uint64_t word[sizeof(Setup) / sizeof(std::uint64_t)];
  Setup setup;
};

/// Defined by what write_setup writes.
template <class Setup>
[[nodiscard]] HeldSetup<Setup> held_setup();
template <>
HeldSetup<ExcavatorSetup> held_setup<ExcavatorSetup>();
template <>
HeldSetup<DozerSetup> held_setup<DozerSetup>();

/// Sizes and alignments of all that a setup is made of, the small ones first: no member can lie
/// elsewhere than where the writer has it without one of these being another.
template <class... Parts>
inline constexpr std::array<std::size_t, 2 * sizeof...(Parts)> kLayoutOf = {sizeof(Parts)...,
                                                                            alignof(Parts)...};
template <class Setup>
inline constexpr int kLayout = 0;
template <>
inline constexpr auto kLayout<ExcavatorSetup> =
    kLayoutOf<bool, std::uint8_t, int, double, StepKind, FenceGuard, McvPolicy, RegenerationSide,
              ReachStatus, Eigen::Vector2d, Eigen::Vector3d, DriveVector, MonotoneTable, DutyTable,
              CylinderGeometry, BucketLinkage, ExcavatorGeometry, SwingProfile, LineProfile,
              SpoolMetering, SpoolProfile, SaidAnswer, SaidAnswers, ValveProfile, PumpProfile,
              Limit, DriveControl, DriveFeedback, DriveWatch, SpoolAnswer, SpoolAnswers, DriveRow,
              ExcavatorBank, DigPath, LambdaRise, ControlProfile, SafetyProfile, ExcavatorProfile,
              TeethPose, TeethLine, SineRamp, LinePlan, DrivePlan, TaskStep, Fence, FenceSet,
              TaskProgram, TaskBook, CylinderTriangle, BucketLinkageSolver, ExcavatorKinematics,
              SwingKinematics, RoundedRectangle, TipPose, DigField, McvActuator, McvPump,
              McvMachine, ExcavatorSetup>;
template <>
inline constexpr auto kLayout<DozerSetup> =
    kLayoutOf<bool, int, double, SpeedPolicy, Eigen::Vector2d, DutyTable, DozerBody, BladeGeometry,
              TiltProfile, ImplementProfile, HstProfile, TravelProfile, GradePoint, GradeHeights,
              GradeDesign, DozerControl, DozerSafety, DozerProfile, SpoolProfile, SpoolMetering,
              Limit, DriveControl, DriveFeedback, DriveWatch, SpoolAnswer, SpoolAnswers, DriveRow,
              DozerBank, BladeKinematics, TiltKinematics, GradeProfile, DozerSetup>;

template <std::size_t count>
constexpr bool same(const std::array<std::size_t, count>& one,
                    const std::array<std::size_t, count>& other) {
  for (std::size_t i = 0; i < count; ++i) {
    if (one[i] != other[i]) {
      return false;
    }
  }
  return true;
}

struct ReplayFrame {
  std::uint16_t cycle;  ///< From 0.
  bool sent;            ///< By the controller; else heard by it before it was its turn.
  std::uint8_t length;
  std::uint32_t id;
  std::array<std::uint8_t, 8> data;
};

struct Replay {
  const ReplayFrame* frame;
  std::size_t count;
  int cycles;
};

[[nodiscard]] Replay replay();

}  // namespace graben::memory
