// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the balance of forces at a cylinder lacks besides the ground: offsets of the transducers,
/// friction, masses that are off, and what the bucket carries. Learnt by a Kalman filter over these
/// few constants.

#include <Eigen/Core>
#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

// Places of the terms; of an axis or link each, in their order.

/// First offset of the pressures, as a force in N. [-; size: the terms begin with it]
inline constexpr int kOffsetTerm = 0;
/// First Coulomb friction, N. [-; derived: after an offset for each axis]
inline constexpr int kCoulombTerm = kOffsetTerm + kAxisCount;
/// First viscous friction of seals and hoses, N s/m. [-; derived: after a Coulomb friction for each
/// axis]
inline constexpr int kViscousTerm = kCoulombTerm + kAxisCount;
/// First excess of a link's mass, as a share of it. [-; derived: after a viscous friction for each
/// axis]
inline constexpr int kMassTerm = kViscousTerm + kAxisCount;
/// Payload of the bucket, kg. [-; derived: after a mass for each link]
inline constexpr int kLoadTerm = kMassTerm + kAxisCount;
/// Moment by which the payload lies farther outwards, kg m. [-; derived: after the payload]
inline constexpr int kOutwardTerm = kLoadTerm + 1;
/// Number of terms. [-; derived: kOutwardTerm is the last]
inline constexpr int kTermCount = kOutwardTerm + 1;

/// How an axis' missing force depends on the terms; on those of other axes not at all.
struct TermRow {
  /// Terms in a row. [-; derived: offset, Coulomb, viscous, a mass for each link, load, outwards]
  static constexpr int kCount = 3 + kAxisCount + 2;
  std::array<double, kCount> share{};  ///< Offset, Coulomb, viscous, three links, load, outwards.
};

/// Values, and the lower half of their covariance row by row.
struct LoadTerms {
  std::array<double, kTermCount> value{};
  std::array<double, kTermCount*(kTermCount + 1) / 2> covariance{};

  [[nodiscard]] static constexpr unsigned at(int row, int column) {
    return static_cast<unsigned>(row >= column ? row * (row + 1) / 2 + column
                                               : column * (column + 1) / 2 + row);
  }
  [[nodiscard]] double variance(int term) const { return covariance[at(term, term)]; }
};

/// What seals and hoses between transducers and chambers take at a speed, for each N s/m of the
/// viscous term: v (1 + |v| / this). Hoses lose more than in proportion.
[[nodiscard]] double hoses_mps(const CylinderGeometry& cylinder);

/// Before anything is seen: friction is what seals of the class have; deviations are those of
/// tuning.hpp.
[[nodiscard]] LoadTerms terms_unseen(const ExcavatorProfile& profile);

/// The term is this from now on, with this deviation, whatever it was.
void set_term(int term, double value, double sd, LoadTerms& terms);

/// Force that an axis is expected to have beyond what its links need, N.
[[nodiscard]] double force_of(int axis, const TermRow& row, const LoadTerms& terms);

/// One axis' force as it is seen, with the variance of its noise.
struct SeenForce {
  TermRow row;
  double force_n = 0.0;
  double variance_n2 = 0.0;
};

/// The force is within so many deviations of what the terms allow; false for NaN.
[[nodiscard]] bool is_likely(int axis, const SeenForce& seen, double deviations,
                             const LoadTerms& terms);

/// A step of the Kalman filter.
void learn(int axis, const SeenForce& seen, LoadTerms& terms);

/// Covariance of an axis' force_of() with that of each axis, N^2.
[[nodiscard]] Eigen::Vector3d force_covariance_n2(int axis,
                                                  const std::array<TermRow, kAxisCount>& row,
                                                  const LoadTerms& terms);

}  // namespace graben
