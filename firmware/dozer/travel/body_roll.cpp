// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/body_roll.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tuning.hpp"

namespace graben {

CrossSample cross_below_tracks(const DozerBody& body, const GradeProfile& design, double x_m) {
  // Gauss's two points of the contact.
  const double off_m = 0.5 * body.track_contact_m * 0.57735026918962576;
  const CrossSample behind = design.cross_at(x_m - off_m);
  const CrossSample ahead = design.cross_at(x_m + off_m);
  return {0.5 * (behind.slope + ahead.slope), 0.5 * (behind.change_pm + ahead.change_pm)};
}

BodyRoll roll_after(const DozerBody& body, const GradeProfile& design, const BodyRoll& measured,
                    double from_m, double to_m, double speed_mps, double lead_s) {
  const CrossSample from = cross_below_tracks(body, design, from_m);
  const CrossSample to = cross_below_tracks(body, design, to_m);
  const double rocking_radps = measured.rate_radps - from.change_pm * speed_mps;
  const double kept = std::exp(-std::max(0.0, lead_s) / kRollRocking_s);
  return {measured.roll_rad + to.slope - from.slope + rocking_radps * kRollRocking_s * (1.0 - kept),
          to.change_pm * speed_mps + rocking_radps * kept};
}

}  // namespace graben
