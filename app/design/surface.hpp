// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A design as surveyors have it: a surface of triangles over a plan.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace graben::design {

/// x east, y north, z up, m. No triangle stands upright.
struct Surface {
  std::vector<Eigen::Vector3d> point_m;
  std::vector<std::array<std::uint32_t, 3>> face;  ///< By the points' indices, from 0.
};

inline constexpr std::size_t kMostPoints = 2'000'000;
inline constexpr std::size_t kMostFaces = 4'000'000;
/// Of a coordinate, m: farther out no grid of a country reaches.
inline constexpr double kMostPlan_m = 2e7;
inline constexpr double kMostHeight_m = 1e4;

/// A TIN surface of a LandXML file (1.0 to 1.2), in its units' metres: `name`, or the only one that
/// it has. Faces marked as invisible (i="1") are no ground. Throws std::runtime_error if the file
/// can't be read, ProfileError with what is wrong, its line and what is allowed.
[[nodiscard]] Surface read_landxml(const std::filesystem::path& file, const std::string& name);

/// How a file of points has them.
struct PointFormat {
  /// What each column is, a letter each: P a point's name, N or Y its northing, E or X its easting,
  /// Z its height, D a description, which may have any number of words. None: as the file's first
  /// line names them, else x, y and z.
  std::string columns;
  double metres = 1.0;  ///< Of its unit of length.
};

/// Metres of a unit's name: m, ft, us-ft; empty: m. Throws std::runtime_error for any other.
[[nodiscard]] double metres_of_unit(const std::string& unit);

/// A line a point; between them Delaunay's triangles, out to the hull of all points. Throws as
/// read_landxml.
[[nodiscard]] Surface read_points(const std::filesystem::path& file,
                                  const PointFormat& format = {});

/// The 3DFACEs of a DXF of text that lie on `layer`, or on the only one that has any; in `unit`
/// (see metres_of_unit), which counts more than the file's $INSUNITS, or by that. Of four corners
/// the triangles meet between the first and the third. Faces that stand upright are left out: seen
/// from above they are a line. Throws as read_landxml: also for a drawing with ground in another
/// form on that layer (polyface mesh, MESH, 3DSOLID, faces in an inserted block), for four corners
/// that lie in no plane, and for a file that ends without EOF.
[[nodiscard]] Surface read_dxf(const std::filesystem::path& file, const std::string& layer,
                               const std::string& unit);

}  // namespace graben::design
