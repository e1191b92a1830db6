// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the balance of forces at a cylinder lacks besides the ground: offsets of the transducers,
/// friction, masses that are off, and what the bucket carries. Learnt by a Kalman filter over these
/// few constants.

#include <Eigen/Core>
#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// Places of the terms; of an axis or link each, in their order.
inline constexpr int kOffsetTerm = 0;    ///< Of the pressures, as a force, N.
inline constexpr int kCoulombTerm = 3;   ///< Friction, N.
inline constexpr int kViscousTerm = 6;   ///< Of seals and hoses, N s/m.
inline constexpr int kMassTerm = 9;      ///< What a link weighs more, of its mass.
inline constexpr int kLoadTerm = 12;     ///< What the bucket carries, kg.
inline constexpr int kOutwardTerm = 13;  ///< How much farther outwards it lies, kg m.
inline constexpr int kTermCount = 14;

/// How an axis' missing force depends on the terms; on those of other axes not at all.
struct TermRow {
  static constexpr int kCount = 8;
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

/// Before anything is seen. Transducers are off by 2 % of their range, as deviation; friction is
/// what seals of the class have, masses are right within a tenth.
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
