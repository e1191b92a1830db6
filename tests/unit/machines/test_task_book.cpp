// SPDX-License-Identifier: Apache-2.0
/// Several tasks for one machine: their numbers, and all that is wrong with them in one go.

#include "app/machines/task_file.hpp"

#include "app/machines/excavator_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

const ExcavatorProfile& profile() {
  static const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile("excavator_12t"));
  return machine.profile;
}

const std::filesystem::path& shipped() {
  static const std::filesystem::path folder = machines::find_task("flatten").parent_path();
  return folder;
}

TaskBook book(const std::vector<std::string>& names) {
  return machines::load_tasks(names, {"no_such_folder", shipped()}, profile()).book;
}

std::string errors_of(const std::vector<std::string>& names) {
  return test::refusal_of([&] { return book(names); });
}

void assert_says(const std::string& errors, const std::string& what) {
  if (errors.find(what) == std::string::npos) {
    print_error("'%s' not in:\n%s", what.c_str(), errors.c_str());
    _fail(__FILE__, __LINE__);
  }
}

TEST(none_is_a_book_too) { assert_int_equal(book({}).count, 0); }

TEST(numbered_as_they_are_told) {
  const TaskBook both = book({"truck_by_steps", "flatten.toml"});
  assert_int_equal(both.count, 2);
  assert_int_equal(both.program[0].step_count, 5);
  assert_int_equal(both.program[1].step_count, 1);
  assert_int_equal(both.program[2].step_count, 0);
  assert_true(both.program[0].repeats);
  assert_near(both.program[1].step[0].duration_s(), 18.4, 1e-9);
}

TEST(a_file_is_found_without_a_folder) {
  assert_int_equal(book({(shipped() / "flatten.toml").string()}).count, 1);
}

TEST(every_error_is_told) {
  // A profile is TOML, but no task.
  const std::string profile_file = machines::find_profile("excavator_12t").string();
  const std::string errors = errors_of({"missing", "flatten", profile_file, "gone"});
  assert_says(errors, "'missing': there is no such file");
  assert_says(errors, "no_such_folder");
  assert_says(errors, "excavator_12t.toml");
  assert_says(errors, "is a machine's profile; wanted: a task");
  assert_says(errors, "'gone': there is no such file");
}

TEST(five_are_too_many) {
  assert_int_equal(book({"flatten", "flatten", "flatten", "flatten"}).count, 4);
  assert_says(errors_of({"flatten", "flatten", "flatten", "flatten", "flatten"}), "at most 4");
}
