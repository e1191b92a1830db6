// SPDX-License-Identifier: Apache-2.0
/// Tables of a task file that are none, and an area's keys.

#include "tests/unit/machines/written_task.hpp"

using namespace graben::test;

/// One error, and no followers of what it has left unread.
TEST(what_is_no_table_is_said_once) {
  const auto says_only = [](const std::string& text, const char* what) {
    assert_string_equal(errors_of(text).c_str(), what);
  };
  says_only("area = 3\n", "area (line 1): must be a table of keys\n");
  const std::string flatten = shipped("flatten");
  says_only(edited("flatten", "{ position = [0.0, 6.866, 0.0], attitude = 2.268928 }", "7"),
            "start (line 4): must be a table of keys\n");
  says_only("fence = []\n" + flatten, "fence (line 1): must be 1 to 8 tables; there are 0\n");
  says_only("fence = [1, 2]\n" + flatten, "fence (line 1): must be 1 to 8 tables; there are 0\n");
}

TEST(an_area_s_errors_name_its_table) {
  const auto with = [](const char* keys) {
    return errors_of(std::string("area = { kind = \"level\", near = 4.4, ") + keys + " }\n");
  };
  assert_true(with("far = 6.6, depth = 0.2, strips = 2").empty());
  assert_string_equal(with("far = 6.6, depth = 0.2, strips = 2.5").c_str(),
                      "area.strips (line 1): 2.5 is not a whole number; allowed: 1 .. 5\n");
  assert_string_equal(with("far = -1, depth = 0.2").c_str(),
                      "area.far (line 1): -1 is out of range; allowed: 0.5 .. 20 m\n");
  assert_says(with("far = 4.0, depth = 0.2"), "area.near (line 1): 4.4 m; allowed: less than far");
  assert_says(with("far = 6.6, depth = 5.0"), "area (line 1): step 0 (dig): out of the reach");
}

TEST(a_pit_has_a_width_and_any_ground_a_slope) {
  const auto area = [](const std::string& keys) {
    return "area = { far = 6.6, near = 4.6, depth = 0.3, " + keys + " }\n";
  };
  const auto request = [&](const std::string& keys) {
    const Written file(area(keys));
    return machines::load_task(file.path(), profile("excavator_12t")).request;
  };
  // A bucket of 1 m, strips that overlap by 0.15 of it.
  assert_int_equal(request("kind = \"pit\", width = 1.0").step[0].strips, 1);
  assert_int_equal(request("kind = \"pit\", width = 2.6").step[0].strips, 3);
  assert_says(
      errors_of(area("kind = \"pit\", width = 6.0")),
      "area.width (line 1): 6 m are 7 strips of a bucket of 1 m; allowed: 5 strips, 4.40 m");
  assert_says(errors_of(area("kind = \"pit\"")), "area.width: missing");
  assert_near(request("kind = \"level\"").design.up.x(), 0.0, 1e-12);
  const auto fall = request("kind = \"level\", depth_near = 0.4").design.up;
  assert_near(fall.x() / fall.z(), -0.1 / 2.0, 1e-9);
}
