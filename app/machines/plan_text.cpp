#include "app/machines/plan_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/machines/axis_names.hpp"

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

}  // namespace

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

std::string refusal_words(const ExcavatorGeometry& geometry, const PlanResult& result) {
  switch (result.refusal) {
    case PlanRefusal::kNone:
      return "there is a plan";
    case PlanRefusal::kBadRequest:
      return "a number of the task or a limit of a drive can't be used";
    case PlanRefusal::kNoWay:
      return "both ends of the line are the same";
    case PlanRefusal::kBlindSpot:
      break;
  }
  return fmt::format("{}; {}", blind_words(geometry, result.blind.blind),
                     place_words(result.blind, "line"));
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

}  // namespace graben::machines
