// SPDX-License-Identifier: Apache-2.0
/// What is said of a machine that was identified from recordings, and what is not.

#include <string>

#include "app/identify/motion_result.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::identify;

constexpr std::size_t kBoom = 0;

TEST(what_is_at_its_bound_or_was_not_driven_has_no_band) {
  MotionResult result;
  result.model[kBoom].value[kDeadTime] = 0.0;
  result.trained[kBoom].moved = true;
  result.judged[kBoom] = {0.9, 0.01, 0.01, true};
  result.usual_radps.fill(0.3);
  result.driven[kBoom] = {0.0, 1.0};
  result.unasked[kBoom] = 0.78;
  const std::string json = motion_json(result);
  assert_true(json.find("\"dead_time_deviation_s\": null") != std::string::npos);
  assert_true(json.find("\"negative\": null") != std::string::npos);
  assert_true(json.find("\"delay_negative\": null") != std::string::npos);
  const std::string text = motion_text(result);
  assert_true(text.find("0 ms, at bound") != std::string::npos);
  assert_true(text.find(", -\n") != std::string::npos);
  assert_true(text.find("boom: 78 % of its way it went with no command") != std::string::npos);
}

TEST(the_best_of_three_models_is_chosen_and_said) {
  MotionResult result;
  result.trained[kBoom].moved = true;
  result.judged[kBoom] = {0.8, 0.01, 0.01, true};
  result.driven[kBoom] = {-1.0, 1.0};
  result.usual_radps.fill(0.3);
  result.rivals[kBoom].curve.known = true;
  result.rivals[kBoom].curve.judged_r2 = 0.79;
  assert_true(std::string(result.chosen(kBoom)) == "physical" && !result.useless());
  result.rivals[kBoom].ridge.known = true;
  result.rivals[kBoom].ridge.judged_r2 = 0.9;
  assert_true(std::string(result.chosen(kBoom)) == "ridge");
  assert_near(result.chosen_r2(kBoom), 0.9, 0.0);
  assert_true(motion_text(result).find("boom: the ridge regression explains more") !=
              std::string::npos);
  result.judged[kBoom].velocity_r2 = result.rivals[kBoom].curve.judged_r2 =
      result.rivals[kBoom].ridge.judged_r2 = 0.1;
  assert_true(result.useless());
}
