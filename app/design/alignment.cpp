// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "app/design/landxml_file.hpp"
#include "app/design/plan_track.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::design {
namespace {

/// What files round their numbers to.
constexpr double kApart_m = 0.02;
constexpr double kBend_rad = 5e-3;
constexpr double kShortest_m = 1e-3;

double within_half_turn(double angle_rad) { return std::remainder(angle_rad, kTwoPi); }

class Alignment {
 public:
  Alignment(const std::filesystem::path& file, const AlignmentSource& source)
      : xml_(file), source_(source) {}

  PlanTrack track() {
    const pugi::xml_node alignment =
        xml_.chosen("Alignments", "Alignment", source_.name, "--alignment");
    const pugi::xml_node geometry = alignment.child("CoordGeom");
    if (!geometry) {
      xml_.refuse(alignment, "has no <CoordGeom>");
    }
    for (const pugi::xml_node& node : geometry.children()) {
      if (node.type() == pugi::node_element) {
        take(node);
      }
    }
    xml_.throw_errors();
    if (track_.piece.empty()) {
      xml_.refuse(geometry, "has no element; allowed: <Line>, <Curve>");
    }
    return cut(alignment);
  }

 private:
  void take(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    if (name == "Feature" || name == "Property") {
      return;
    }
    if (name != "Line" && name != "Curve") {
      xml_.refuse(node, "allowed in an alignment: <Line>, <Curve>");
    }
    const auto from_m = point(node, "Start");
    const auto to_m = point(node, "End");
    if (!from_m || !to_m) {
      return;
    }
    const auto piece = name == "Line" ? line(*from_m, *to_m) : arc(node, *from_m, *to_m);
    if (piece && piece->length_m > kShortest_m) {
      demand_going_on(node, *piece);
      track_.piece.push_back(*piece);
    }
  }

  std::optional<Eigen::Vector2d> point(const pugi::xml_node& node, const char* name) {
    const pugi::xml_node child = node.child(name);
    if (!child) {
      xml_.note(node, fmt::format("has no <{}>; allowed: its north and east", name));
      return std::nullopt;
    }
    const auto at_m = xml_.north_east_up_m(child, 2);
    return at_m ? std::optional(Eigen::Vector2d(at_m->y(), at_m->x())) : std::nullopt;
  }

  static std::optional<TrackPiece> line(const Eigen::Vector2d& from_m,
                                        const Eigen::Vector2d& to_m) {
    const Eigen::Vector2d way = to_m - from_m;
    return TrackPiece{from_m, std::atan2(way.y(), way.x()), 0.0, way.norm()};
  }

  std::optional<TrackPiece> arc(const pugi::xml_node& node, const Eigen::Vector2d& from_m,
                                const Eigen::Vector2d& to_m) {
    const std::string_view turn = node.attribute("rot").value();
    const auto centre_m = point(node, "Center");
    if (turn != "cw" && turn != "ccw") {
      xml_.note(node, fmt::format("rot=\"{}\"; allowed: cw, ccw", turn));
      return std::nullopt;
    }
    if (!centre_m) {
      return std::nullopt;
    }
    const Eigen::Vector2d first = from_m - *centre_m;
    const Eigen::Vector2d second = to_m - *centre_m;
    if (std::abs(first.norm() - second.norm()) > kApart_m || first.norm() < kApart_m) {
      xml_.note(node, fmt::format("begins {:.3f} m and ends {:.3f} m from its centre; allowed: one "
                                  "radius",
                                  first.norm(), second.norm()));
      return std::nullopt;
    }
    const double side = turn == "ccw" ? 1.0 : -1.0;
    double swept_rad =
        side * (std::atan2(second.y(), second.x()) - std::atan2(first.y(), first.x()));
    swept_rad -= kTwoPi * std::floor(swept_rad / kTwoPi);
    const Eigen::Vector2d tangent = side * Eigen::Vector2d(-first.y(), first.x());
    return TrackPiece{from_m, std::atan2(tangent.y(), tangent.x()), side / first.norm(),
                      swept_rad * first.norm()};
  }

  void demand_going_on(const pugi::xml_node& node, const TrackPiece& piece) {
    if (track_.piece.empty()) {
      return;
    }
    const TrackPiece& last = track_.piece.back();
    const double apart_m = (piece.from_m - last.at_m(last.length_m)).norm();
    const double bend_rad =
        within_half_turn(piece.direction_rad - last.direction_at_rad(last.length_m));
    if (apart_m > kApart_m) {
      xml_.note(node,
                fmt::format("begins {:.3f} m from the end of the one before; allowed: at most "
                            "{} m",
                            apart_m, kApart_m));
    } else if (std::abs(bend_rad) > kBend_rad) {
      xml_.note(node, fmt::format("bends by {:.4f} rad from the one before at station {:.3f} m; "
                                  "allowed: {} .. {} rad",
                                  bend_rad, track_.length_m(), -kBend_rad, kBend_rad));
    }
  }

  /// From station to station.
  PlanTrack cut(const pugi::xml_node& alignment) const {
    if (source_.stations_m.empty()) {
      return track_;
    }
    const double start_m =
        number_of<double>(alignment.attribute("staStart").value()).value_or(0.0) * xml_.metres();
    const double from_m = source_.stations_m[0] - start_m;
    const double to_m = source_.stations_m[1] - start_m;
    const double length_m = track_.length_m();
    if (!(from_m >= -kShortest_m && to_m > from_m && to_m <= length_m + kShortest_m)) {
      xml_.refuse(alignment, fmt::format("stations {} .. {} m; allowed: rising, {:.3f} .. {:.3f} m",
                                         source_.stations_m[0], source_.stations_m[1], start_m,
                                         start_m + length_m));
    }
    PlanTrack part;
    double begin_m = 0.0;
    for (const TrackPiece& piece : track_.piece) {
      const double first_m = std::max(0.0, from_m - begin_m);
      const double last_m = std::min(piece.length_m, to_m - begin_m);
      begin_m += piece.length_m;
      if (last_m - first_m > kShortest_m) {
        part.piece.push_back({piece.at_m(first_m), piece.direction_at_rad(first_m),
                              piece.curvature_pm, last_m - first_m});
      }
    }
    return part;
  }

  LandXmlFile xml_;
  AlignmentSource source_;
  PlanTrack track_;
};

}  // namespace

PlanTrack read_alignment(const std::filesystem::path& file, const AlignmentSource& source) {
  return Alignment(file, source).track();
}

}  // namespace graben::design
