// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is not asked of a new machine, by what was told: masses by its weight, areas of the valve
/// by its flow, places by its links. Every value says by what.

#include "app/machines/new/commented_toml.hpp"
#include "app/machines/new/new_profile.hpp"

namespace graben::machines {

/// The new machine over the one that it is after.
struct Ratios {
  double weight = 1.0;                   ///< Told, or by its size's cube.
  double size = 1.0;                     ///< Links; of a dozer its track contact.
  std::array<double, 3> link{1, 1, 1};   ///< Boom, arm, bucket.
  std::array<double, 3> area{1, 1, 1};   ///< Pistons of each, cap side.
  std::array<double, 3> swept{1, 1, 1};  ///< Times their strokes.
  double flow = 1.0;                     ///< All pumps, at work.
  double section = 1.0;                  ///< Of a section of the valve.
  double power = 1.0;                    ///< Flow times relief.
  double turn = 1.0;                     ///< The swing motor's displacement.
  double width = 1.0;                    ///< Bucket, or blade.
};

/// `told` has what was answered, in SI units.
[[nodiscard]] Ratios ratios_of(const ProfileDocument& like, const ProfileAnswers& answers,
                               const CommentedValues& told);

/// Adds what follows to `told`; what was told stays.
void scale_profile(const ProfileDocument& like, const Ratios& ratios, CommentedValues& told);
void scale_simulation(const ProfileDocument& simulation, const Ratios& ratios,
                      CommentedValues& told);
/// Of a rectangular path of the teeth, `at` its key.
void scale_path(const ProfileDocument& document, const std::string& at, double ratio,
                CommentedValues& told);

}  // namespace graben::machines
