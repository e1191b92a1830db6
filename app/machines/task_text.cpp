// SPDX-License-Identifier: Apache-2.0
#include "app/machines/task_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/machines/fence_tables.hpp"
#include "firmware/excavator/motion/dig/step_round.hpp"

namespace graben::machines {
namespace {

const char* name(int drive) { return kDriveNames[static_cast<unsigned>(drive)]; }

/// On the way the end is met to the micrometre; how far beyond matters where a line begins there.
std::string stroke_words(const BlindSpot& blind, double most_m) {
  constexpr double kWorthTelling_m = 1e-3;
  const double beyond_m = std::max(-blind.stroke_m, blind.stroke_m - most_m);
  return fmt::format(
      "the {} cylinder would have to go beyond its {} end{}; its stroke is 0 .. {} m",
      name(blind.drive), blind.stroke_m < 0.0 ? "closed" : "open",
      beyond_m > kWorthTelling_m ? fmt::format(", to {:.3f} m", blind.stroke_m) : "", most_m);
}

std::string singular_words(int drive) {
  switch (drive) {
    case kSwing:
      return "the swing has no direction, the teeth are over its axis";
    case kArm:
      return "the arm's joint is singular, boom and arm stand in one line or the cylinder through "
             "its joint";
    default:
      return fmt::format("the {}'s joint is singular, its cylinder stands through it", name(drive));
  }
}

bool is_design(const ProgramRequest& request, int fence) {
  return fence == request.fences.count
             ? request.has_design
             : request.fences.fence[static_cast<unsigned>(fence)].is_design();
}

}  // namespace

std::string fence_name(const ProgramRequest& request, int fence) {
  return is_design(request, fence)
             ? "the design surface"
             : fmt::format("fence[{}], the {}", fence,
                           fence_text(request.fences.fence[static_cast<unsigned>(fence)]));
}

std::string blind_words(const ExcavatorGeometry& geometry, const BlindSpot& blind) {
  switch (blind.kind) {
    case BlindKind::kNone:
      return "nothing is in the way";
    case BlindKind::kOutOfReach:
      return "out of the reach of boom and arm, the arm's joint can neither stretch nor fold so "
             "far";
    case BlindKind::kStrokeEnd:
      return stroke_words(blind, geometry.cylinder[static_cast<unsigned>(blind.drive)].stroke_m);
    case BlindKind::kDeadCentre:
      return fmt::format("the {}'s joint would be past its cylinder's dead centre",
                         name(blind.drive));
    case BlindKind::kLinkageOpen:
      return "the bucket's linkage can't close";
    case BlindKind::kSingular:
      return singular_words(blind.drive);
    case BlindKind::kNotFinite:
      break;
  }
  return "a number is not finite";
}

std::string place_words(const BlindPlace& place, const char* of_what) {
  const Eigen::Vector3d& at = place.teeth.position_m;
  return fmt::format(
      "at {:.2f} % of the {}, teeth x {:.3f} m, y {:.3f} m, z {:.3f} m, attitude {:.3f} rad",
      100.0 * place.share, of_what, at.x(), at.y(), at.z(), place.teeth.attitude_rad);
}

std::string plan_limit_words(const PlanResult& result) {
  switch (result.slowed_by) {
    case PlanLimit::kNone:
      return "none";
    case PlanLimit::kTeethAcceleration:
      return "acceleration of the teeth";
    case PlanLimit::kSpeed:
      return fmt::format("speed of the {}", name(result.drive));
    case PlanLimit::kAcceleration:
      return fmt::format("acceleration of the {}", name(result.drive));
  }
  return "unknown";
}

namespace {

const char* point_name(const ExcavatorBody& body, MachinePoint point) {
  switch (point) {
    case MachinePoint::kTeeth:
      return "the teeth";
    case MachinePoint::kBucketPin:
      return "the bucket's pin";
    case MachinePoint::kArmPin:
      return "the arm's pin";
    case MachinePoint::kEdgeLeft:
      return body.known() ? "the edge's left corner" : "the teeth";
    case MachinePoint::kEdgeRight:
      return body.known() ? "the edge's right corner" : "the teeth";
    case MachinePoint::kHeelLeft:
      return body.known() ? "the heel's left corner" : "the teeth";
    case MachinePoint::kHeelRight:
      return body.known() ? "the heel's right corner" : "the teeth";
    case MachinePoint::kPinLeft:
      return body.known() ? "the bucket's left side" : "the bucket's pin";
    case MachinePoint::kPinRight:
      return body.known() ? "the bucket's right side" : "the bucket's pin";
    case MachinePoint::kBoomBend:
      return "the boom";
    case MachinePoint::kBoomFoot:
      return "the boom's foot";
    case MachinePoint::kTailLeft:
      return "the counterweight's left corner";
    case MachinePoint::kTailRight:
      return "the counterweight's right corner";
  }
  return "a point";
}

/// "the edge's left corner would come near fence[2], the wall, to 31 mm at 63.28 % of the step,
/// where the margin is 55 mm", or pass it by so much.
std::string fence_words(const char* of_what, const ExcavatorBody& body,
                        const ProgramRequest& request, const ProgramResult& result) {
  constexpr double kMillimetres = 1e3;
  const BarredBy& by = result.by;
  const bool passes = by.least_m < 0.0;
  const std::string margin =
      by.margin_m > 0.0 ? fmt::format(", where the margin is {:.0f} mm", kMillimetres * by.margin_m)
                        : "";
  return fmt::format("{} would {} {} {} {:.0f} mm at {:.2f} % of the {}{}",
                     point_name(body, by.point), passes ? "pass" : "come near",
                     fence_name(request, by.fence) + (is_design(request, by.fence) ? "" : ","),
                     passes ? "by" : "to", kMillimetres * std::abs(by.least_m),
                     100.0 * by.least_share, of_what, margin);
}

std::string rounds_words(const ProgramRequest& request) {
  const RoundsPlan& rounds = request.rounds;
  if (!rounds.to_design) {
    return fmt::format("{} rounds; allowed: 1 .. {}", rounds.count, kRoundsMost);
  }
  return request.has_design
             ? fmt::format(
                   "rounds until the design is met: each has to lead nearer to it, and at "
                   "most {} have to do; they lead {:.0f} mm nearer",
                   kRoundsMost, -1e3 * request.design.up.dot(rounds.offset_m))
             : "rounds until the design is met, but there is no design";
}

std::string cause_words(const char* of_what, const ExcavatorProfile& profile,
                        const ProgramRequest& request, const ProgramResult& result) {
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
      return fence_words(of_what, profile.geometry.body, request, result);
    case ProgramRefusal::kSwingEnd:
      return fmt::format("the swing would leave its range, {} .. {} rad",
                         profile.swing.right_end_rad, profile.swing.left_end_rad);
    case ProgramRefusal::kNoSwing:
      return "it would have to swing, and this machine's swing is held";
    case ProgramRefusal::kLayers:
      return "digs in layers: it has to be the first step, a line, with a design, followed by "
             "moves, "
             "repeated, of a machine whose bucket is known (bucket.width, bucket.capacity)";
    case ProgramRefusal::kRounds:
      return rounds_words(request);
    case ProgramRefusal::kOpenEnd:
      return "the task repeats, but does not end where it starts";
  }
  return "unknown";
}

/// Digs of steps that planning has raised by what is worth a word: `say(number, note)` of each.
template <class Say>
void for_each_raised(const ProgramRequest& request, const ProgramResult& result, Say&& say) {
  constexpr double kWorthTelling_m = 1e-4;
  for (std::size_t i = 0; i < static_cast<std::size_t>(request.step_count); ++i) {
    const StepRequest& step = request.step[i];
    const StepNote& note = result.note[i];
    const bool is_dig = step.kind == StepKind::kDig && step.straight && !step.in_layers;
    if (is_dig && std::max(note.raised_from_m, note.raised_to_m) > kWorthTelling_m) {
      say(i, note);
    }
  }
}

std::string raised_words(double raised_m, const TeethPose& to) {
  const Eigen::Vector3d& at = to.position_m;
  return fmt::format("{:.0f} mm to teeth x {:.3f} m, y {:.3f} m, z {:.3f} m", 1e3 * raised_m,
                     at.x(), at.y(), at.z());
}

bool has_place(ProgramRefusal refusal) {
  return refusal != ProgramRefusal::kBadRequest && refusal != ProgramRefusal::kNoWay &&
         refusal != ProgramRefusal::kRounds;
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
    case StepKind::kWait:
      return "wait";
  }
  return "unknown";
}

const char* until_name(UntilKind kind) {
  switch (kind) {
    case UntilKind::kEnd:
      return "end";
    case UntilKind::kFull:
      return "full";
    case UntilKind::kForce:
      return "force";
    case UntilKind::kPlane:
      return "plane";
  }
  return "unknown";
}

std::string refusal_words_of(const char* of_what, const ExcavatorProfile& profile,
                             const ProgramRequest& request, const ProgramResult& result) {
  std::string words = cause_words(of_what, profile, request, result);
  if (has_place(result.refusal)) {
    words += (result.refusal == ProgramRefusal::kFence ? "; beginning " : "; ") +
             place_words(result.place, of_what);
  }
  if (result.early_share >= 0.0) {
    words += fmt::format("; after a step that ended at {:.0f} % of its line",
                         100.0 * result.early_share);
  }
  if (request.rounds.is_bounded() && result.round >= 0) {
    words += fmt::format("; in round {}", result.round + 1);
  }
  return words;
}

std::string program_refusal_words(const ExcavatorProfile& profile, const ProgramRequest& request,
                                  const ProgramResult& result) {
  const auto step = static_cast<std::size_t>(result.step);
  return fmt::format("step {} ({}): {}", result.step, step_name(request.step.at(step).kind),
                     refusal_words_of("step", profile, request, result));
}

std::string raised_text(const ProgramRequest& request, const ProgramResult& result) {
  std::string text;
  for_each_raised(request, result, [&](std::size_t i, const StepNote& note) {
    const TeethLine& line = result.program.step[i].line.line;
    text +=
        fmt::format("the design raises step {} ({}): its beginning by {}, its end by {}\n", i,
                    step_name(request.step[i].kind), raised_words(note.raised_from_m, line.at(0.0)),
                    raised_words(note.raised_to_m, line.at(1.0)));
  });
  return text;
}

double most_raised_m(const ProgramRequest& request, const ProgramResult& result) {
  double most_m = 0.0;
  for_each_raised(request, result, [&](std::size_t, const StepNote& note) {
    most_m = std::max({most_m, note.raised_from_m, note.raised_to_m});
  });
  return most_m;
}

}  // namespace graben::machines
