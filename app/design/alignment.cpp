// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "app/design/landxml_file.hpp"
#include "app/design/plan_track.hpp"
#include "app/design/station_count.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::design {
namespace {

/// What files round their numbers to.
constexpr double kApart_m = 0.02;
constexpr double kBend_rad = 5e-3;
/// Of a length that is said beside points, and its share.
constexpr double kSaid_m = 0.05;
constexpr double kSaidShare = 2e-3;
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
    const pugi::xml_node second = geometry.next_sibling("CoordGeom");
    if (second && second.first_child()) {
      xml_.refuse(second, "is the alignment's second one; allowed: one");
    }
    std::vector<Element> elements = elements_of(geometry);
    if (elements.empty()) {
      xml_.refuse(geometry, "has no element; allowed: <Line>, <Curve>");
    }
    const Range range = range_of(alignment, elements);
    for (const Element& each : elements) {
      const bool is_before_end = each.begin_m < range.to_m - kShortest_m;
      const bool is_used =
          !each.length_m || each.begin_m + *each.length_m > range.from_m + kShortest_m;
      if (is_before_end && is_used) {
        begin_m_ = track_.piece.empty() ? each.begin_m : begin_m_;
        take(each.node);
      }
    }
    xml_.throw_errors();
    if (track_.piece.empty()) {
      xml_.refuse(geometry, "has no length; allowed: <Line>, <Curve>");
    }
    return cut(range);
  }

 private:
  /// As it lies on the alignment; without a length nothing after it has a station.
  struct Element {
    pugi::xml_node node;
    double begin_m = 0.0;
    std::optional<double> length_m;
  };
  struct Range {
    double from_m = 0.0;
    double to_m = 0.0;
  };

  [[nodiscard]] std::vector<Element> elements_of(const pugi::xml_node& geometry) {
    std::vector<Element> elements;
    double begin_m = 0.0;
    for (const pugi::xml_node& node : geometry.children()) {
      const std::string_view name = node.name();
      if (node.type() != pugi::node_element || name == "Feature" || name == "Property") {
        continue;
      }
      elements.push_back({node, begin_m, length_of(node)});
      if (!elements.back().length_m) {
        break;
      }
      begin_m += *elements.back().length_m;
    }
    return elements;
  }

  /// Of a line or an arc by its points, of any other element as the file says. None: not said, or
  /// two ways.
  [[nodiscard]] std::optional<double> length_of(const pugi::xml_node& node) {
    const auto said_m = said(node, "length");
    if (!is_known(node)) {
      return said_m;
    }
    const auto piece = piece_of(node);
    const bool is_right = xml_.forget_notes() == 0;
    return piece && is_right ? std::optional(piece->length_m) : std::nullopt;
  }

  static bool is_known(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    return name == "Line" || name == "Curve";
  }

  [[nodiscard]] std::optional<double> said(const pugi::xml_node& node, const char* name) const {
    const auto value = number_of<double>(node.attribute(name).value());
    return value ? std::optional(*value * xml_.metres()) : std::nullopt;
  }

  [[noreturn]] void refuse_kind(const pugi::xml_node& node) const {
    xml_.refuse(node, "allowed in an alignment: <Line>, <Curve>, where it is used");
  }

  void take(const pugi::xml_node& node) {
    if (!is_known(node)) {
      refuse_kind(node);
    }
    const auto piece = piece_of(node);
    if (piece && piece->length_m > kShortest_m) {
      demand_going_on(node, *piece);
      track_.piece.push_back(*piece);
    }
  }

  std::optional<TrackPiece> piece_of(const pugi::xml_node& node) {
    const auto from_m = point(node, "Start");
    const auto to_m = point(node, "End");
    if (!from_m || !to_m) {
      return std::nullopt;
    }
    const bool is_line = std::string_view(node.name()) == "Line";
    const auto piece = is_line ? line(*from_m, *to_m) : arc(node, *from_m, *to_m);
    if (piece) {
      demand_as_said(node, *piece);
    }
    return piece;
  }

  /// Its points, and which way it turns, against the numbers beside them: files that mirror their
  /// axes or count the turn the other way round are told by that.
  void demand_as_said(const pugi::xml_node& node, const TrackPiece& piece) {
    const auto compare = [&](const char* name, double by_points_m) {
      const auto said_m = said(node, name);
      if (said_m && std::abs(*said_m - by_points_m) > kSaid_m + kSaidShare * by_points_m) {
        xml_.note(node, fmt::format("{}=\"{}\", by its points{} {:.3f} m; allowed: the same", name,
                                    node.attribute(name).value(),
                                    node.attribute("rot") ? " and rot" : "", by_points_m));
      }
    };
    compare("length", piece.length_m);
    if (piece.curvature_pm != 0.0) {
      compare("radius", 1.0 / std::abs(piece.curvature_pm));
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
                                  bend_rad, begin_m_ + track_.length_m(), -kBend_rad, kBend_rad));
    }
  }

  [[nodiscard]] Range range_of(const pugi::xml_node& alignment,
                               const std::vector<Element>& elements) const {
    if (source_.stations_m.empty()) {
      return {0.0, std::numeric_limits<double>::infinity()};
    }
    const Element& last = elements.back();
    const double length_m =
        last.begin_m + last.length_m.value_or(std::numeric_limits<double>::infinity());
    const StationCount count(xml_, alignment, length_m);
    const double from_m = count.distance_m(source_.stations_m[0]);
    const double to_m = count.distance_m(source_.stations_m[1]);
    if (!(to_m > from_m)) {
      xml_.refuse(alignment,
                  fmt::format("stations {} .. {} m; allowed: along its way, {}",
                              source_.stations_m[0], source_.stations_m[1], count.stretches()));
    }
    return {from_m, to_m};
  }

  [[nodiscard]] PlanTrack cut(const Range& range) const {
    PlanTrack part;
    double begin_m = begin_m_;
    for (const TrackPiece& piece : track_.piece) {
      const double first_m = std::max(0.0, range.from_m - begin_m);
      const double last_m = std::min(piece.length_m, range.to_m - begin_m);
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
  double begin_m_ = 0.0;  ///< Of its first piece on the alignment.
};

}  // namespace

PlanTrack read_alignment(const std::filesystem::path& file, const AlignmentSource& source) {
  return Alignment(file, source).track();
}

}  // namespace graben::design
