// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A spool that answers otherwise to each side: another dead band, another shape, other times.

#include "firmware/machine/spool_answer.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace graben::test {

/// Extending it opens at 0.4 and softly, a quarter of the opening within a tenth of the travel;
/// retracting at 0.25 and straight. Powers of two, as far as may be.
inline SpoolAnswers two_sides() {
  SpoolAnswers answer;
  const double opens[] = {0.0, 0.25, 1.0};
  const double extend[] = {0.4, 0.5, 1.0};
  assert_int_equal(answer.extend.spool_to_duty.fill(opens, extend, 3), TableFill::kOk);
  const double ends[] = {0.0, 1.0};
  const double retract[] = {0.25, 1.0};
  assert_int_equal(answer.retract.spool_to_duty.fill(ends, retract, 2), TableFill::kOk);
  answer.extend.dead_time_s = 0.2;
  answer.extend.lag_s = 0.1;
  answer.retract.dead_time_s = 0.05;
  answer.retract.lag_s = 0.04;
  return answer;
}

}  // namespace graben::test
