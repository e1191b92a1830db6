// SPDX-License-Identifier: Apache-2.0
// A log's kind of machine, where the machine itself tells no stroke.

#include "app/runs/run_log.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

/// A controller's word of its path or grade, then its status.
runs::RunLog read(const std::string& id) {
  const test::WrittenFile file("run.log", "(1.000000) can0 " + id +
                                              "#0000000000000000\n"
                                              "(1.010000) can0 18FF3182#0000000000000000\n");
  return runs::read_run_log(file.path());
}

TEST(the_controller_tells_the_kind) {
  const runs::RunLog excavator = read("18FF3382");  // EcuHydraulics
  assert_false(excavator.is_dozer);
  assert_int_equal(excavator.status_s.size(), 1);
  assert_int_equal(excavator.channel.size(), runs::channel_table(false).size());
  const runs::RunLog dozer = read("18FF5B82");  // EcuGrade
  assert_true(dozer.is_dozer);
  assert_int_equal(dozer.status_s.size(), 1);
}
