#include "app/machines/task_text.hpp"

#include <fmt/format.h>

#include "app/machines/plan_text.hpp"

namespace graben::machines {
namespace {

const char* point_name(MachinePoint point) {
  switch (point) {
    case MachinePoint::kTeeth:
      return "the teeth";
    case MachinePoint::kBucketPin:
      return "the bucket's pin";
    case MachinePoint::kArmPin:
      return "the arm's pin";
  }
  return "a point";
}

std::string fence_words(const ProgramRequest& request, const ProgramResult& result) {
  const bool design = request.has_design && result.fence == request.fences.count;
  const std::string which = design ? "the design surface" : fmt::format("fence[{}]", result.fence);
  return fmt::format("{} would pass {}", point_name(result.point), which);
}

std::string swing_words(const SwingProfile& swing) {
  return fmt::format("the swing would leave its range, {} .. {} rad", swing.right_end_rad,
                     swing.left_end_rad);
}

std::string cause_words(const ExcavatorProfile& profile, const ProgramRequest& request,
                        const ProgramResult& result) {
  switch (result.refusal) {
    case ProgramRefusal::kNone:
      return "there is a plan";
    case ProgramRefusal::kBadRequest:
      return "a number of the task or a limit of a drive can't be used";
    case ProgramRefusal::kNoWay:
      return "it ends where it begins";
    case ProgramRefusal::kBlindSpot:
      return blind_words(profile.geometry, result.place.blind);
    case ProgramRefusal::kFence:
      return fence_words(request, result);
    case ProgramRefusal::kSwingEnd:
      return swing_words(profile.swing);
    case ProgramRefusal::kNoSwing:
      return "it would have to swing, and this machine's swing is held";
    case ProgramRefusal::kOpenEnd:
      return "the task repeats, but does not end where it starts";
  }
  return "unknown";
}

bool has_place(ProgramRefusal refusal) {
  return refusal != ProgramRefusal::kBadRequest && refusal != ProgramRefusal::kNoWay;
}

}  // namespace

const char* step_name(StepKind kind) {
  switch (kind) {
    case StepKind::kNone:
      return "none";
    case StepKind::kApproach:
      return "approach";
    case StepKind::kDig:
      return "dig";
    case StepKind::kLift:
      return "lift";
    case StepKind::kSwing:
      return "swing";
    case StepKind::kDump:
      return "dump";
    case StepKind::kReturnToDig:
      return "return";
    case StepKind::kDone:
      return "done";
  }
  return "unknown";
}

std::string program_refusal_words(const ExcavatorProfile& profile, const ProgramRequest& request,
                                  const ProgramResult& result) {
  std::string words = cause_words(profile, request, result);
  if (has_place(result.refusal)) {
    words += "; " + place_words(result.place, "step");
  }
  const auto step = static_cast<std::size_t>(result.step);
  return fmt::format("step {} ({}): {}", result.step, step_name(request.step.at(step).kind), words);
}

}  // namespace graben::machines
