// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A new machine's profile from one that is there: what a person with a tape measure, a data sheet
/// and a spanner knows is asked for in units of the workshop; the rest stays, and says so.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/profile_document.hpp"

namespace graben::machines {

/// A unit of the workshop: so many SI units are one of it.
struct WorkshopUnit {
  const char* name;
  double si;
};

/// What is to be asked: a key of the profile, which has one number or several.
struct ProfileQuestion {
  std::string key;             ///< Path as in TOML.
  std::string text;            ///< Meaning, from the reference of all keys.
  WorkshopUnit unit;           ///< Of the answer.
  std::vector<double> before;  ///< What the profile has, in that unit.
  double least = 0.0;          ///< Of each number, in that unit.
  double most = 0.0;
};

/// Numbers by key, in the unit of the question.
using ProfileAnswers = std::map<std::string, std::vector<double>>;

/// What a profile of this kind is asked about, in the order of asking: lengths and pins in mm,
/// angles in degrees, pressures in bar, speeds of rotation in rpm, flows in L/min. `like` must be
/// sound.
[[nodiscard]] std::vector<ProfileQuestion> profile_questions(const ProfileDocument& like);

/// Throws std::runtime_error, in the question's unit, where an answer is no length in mm but one in
/// metres, no pressure in bar but one in MPa, or a cylinder's rod is not thinner than its bore, as
/// `answers` or else `like` have it.
void assert_fits(const ProfileDocument& like, const ProfileQuestion& question,
                 const std::vector<double>& numbers, const ProfileAnswers& answers);

/// A profile's text: `like` with the answers, a comment with each key's meaning, unit and range,
/// and where each value is from. What is not asked is scaled by what was (scaled_values.hpp). An
/// excavator's joint ranges are those that its pins give, and its path is brought into its reach.
/// Values are not checked: load what was written.
[[nodiscard]] std::string new_profile_text(const ProfileDocument& like, const std::string& name,
                                           const ProfileAnswers& answers);

/// The same of its simulation, for the profile of that text.
[[nodiscard]] std::string new_simulation_text(const ProfileDocument& simulation,
                                              const ProfileDocument& like, const std::string& name,
                                              const ProfileAnswers& answers,
                                              const std::string& profile_text);

}  // namespace graben::machines
