// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a LandXML alignment counts its stations: from `staStart` on, and anew at each <StaEquation>.

#include <vector>

#include "app/design/landxml_file.hpp"

namespace graben::design {

/// Station equations as LandXML 1.2 has them: at `staInternal`, counted from `staStart` without any
/// equation, the station behind is `staBack` and the one ahead `staAhead`; `staIncrement` says
/// whether stations ahead rise or fall. A station that is there twice is not guessed.
class StationCount {
 public:
  /// `length_m` may be infinite, where it is not known. Throws ProfileError with the equation that
  /// is not whole, lies outside, or whose `staBack` is not what the one before comes to.
  StationCount(const LandXmlFile& xml, const pugi::xml_node& alignment, double length_m);

  /// Metres from the alignment's begin. Throws ProfileError where none or several places have it.
  [[nodiscard]] double distance_m(double station_m) const;
  /// "100.000 .. 105.000, 500.000 .. 505.000 m", in the alignment's order.
  [[nodiscard]] std::string stretches() const;

 private:
  /// From one equation to the next.
  struct Stretch {
    double begin_m = 0.0;  ///< From the alignment's begin.
    double end_m = 0.0;
    double station_m = 0.0;  ///< At its begin.
    double side = 1.0;       ///< -1 where stations fall.

    [[nodiscard]] double at_m(double distance_m) const {
      return station_m + side * (distance_m - begin_m);
    }
  };

  [[nodiscard]] std::optional<double> said_m(const pugi::xml_node& node, const char* name) const;
  void add(const pugi::xml_node& equation, double start_m);

  const LandXmlFile& xml_;
  pugi::xml_node alignment_;
  std::vector<Stretch> stretch_;
};

}  // namespace graben::design
