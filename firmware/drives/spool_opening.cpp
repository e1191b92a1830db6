// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/spool_opening.hpp"

#include <algorithm>

namespace graben {
namespace {

double rise(const DutyTable& table, int segment) {
  return (table.y(segment + 1) - table.y(segment)) / (table.x(segment + 1) - table.x(segment));
}

}  // namespace

SpoolAnswers straight_answers(double edge, double dead_time_s, double lag_s) {
  const double opening[] = {0.0, 1.0};
  const double duty[] = {edge, 1.0};
  SpoolAnswer answer{{}, dead_time_s, lag_s, 0.0};
  static_cast<void>(answer.spool_to_duty.fill(opening, duty, 2));
  return {answer, answer};
}

double opening_at(const SpoolAnswer& answer, double travel_ratio) {
  const DutyTable& table = answer.spool_to_duty;
  if (travel_ratio < answer.edge()) {
    return (travel_ratio - answer.edge()) / (1.0 - answer.edge());
  }
  // Beyond its end a table goes on: a sensor may show a little more than there is.
  const int low = table.segment_of_y(travel_ratio);
  const double share = (travel_ratio - table.y(low)) / (table.y(low + 1) - table.y(low));
  return table.x(low) + share * (table.x(low + 1) - table.x(low));
}

double duty_at(const SpoolAnswer& answer, double opening) {
  return opening >= 0.0 ? answer.spool_to_duty.at(opening)
                        : answer.edge() + opening * (1.0 - answer.edge());
}

double least_travel_per_opening(const SpoolAnswer& answer, double least_ratio, double most_ratio) {
  const DutyTable& table = answer.spool_to_duty;
  const int last = table.segment_of_y(most_ratio);
  double least = rise(table, last);
  for (int n = table.segment_of_y(least_ratio); n < last; ++n) {
    least = std::min(least, rise(table, n));
  }
  return least;
}

}  // namespace graben
