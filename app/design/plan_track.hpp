// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer's track in plan: straight lines and arcs.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace graben::design {

/// From where it begins; left is positive.
struct TrackPiece {
  Eigen::Vector2d from_m = Eigen::Vector2d::Zero();
  double direction_rad = 0.0;
  double curvature_pm = 0.0;
  double length_m = 0.0;

  [[nodiscard]] Eigen::Vector2d at_m(double along_m) const;
  [[nodiscard]] double direction_at_rad(double along_m) const {
    return direction_rad + curvature_pm * along_m;
  }
};

/// Each piece begins where the one before ends, in its direction.
struct PlanTrack {
  std::vector<TrackPiece> piece;

  [[nodiscard]] double length_m() const;
  [[nodiscard]] bool curves() const;
};

/// Along a piece of it.
struct PlanStation {
  const TrackPiece* piece = nullptr;
  double along_m = 0.0;
};
[[nodiscard]] PlanStation station_of(const PlanTrack& track, double station_m);

/// Of corners in plan, x and y by turns, each between two others rounded by an arc of this radius.
/// Throws std::runtime_error with the corner where an arc has no room.
[[nodiscard]] PlanTrack rounded_track(const std::vector<double>& corners_m, double radius_m);

/// Which of a file's alignments, and from where to where on it.
struct AlignmentSource {
  std::string name;                ///< As LandXmlFile::chosen; the only one it has unless told.
  std::vector<double> stations_m;  ///< From and to, as the file counts them; all of it unless told.
};

/// An alignment of a LandXML file: <Line> and <Curve>. It is cut to the stations, then judged.
/// Throws as read_landxml: for any other element of its geometry there, for one that does not go on
/// where and as the one before ended or whose length or radius is another than its points make, for
/// stations that it does not have, or has twice by its station equations (StationCount).
[[nodiscard]] PlanTrack read_alignment(const std::filesystem::path& file,
                                       const AlignmentSource& source);

}  // namespace graben::design
