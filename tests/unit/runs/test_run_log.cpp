// SPDX-License-Identifier: Apache-2.0
// A log's kind of machine, where the machine itself tells no stroke.

#include "app/runs/run_log.hpp"

#include <fmt/format.h>

#include "can_dbc/generated/common_dbc.hpp"
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

/// Ten words of being Active, 20 ms apart, and between two of them a log's gap or its clock set
/// back.
TEST(the_time_active_is_that_of_the_pieces) {
  for (const double break_s : {0.0, 600.0, -3600.0}) {
    dbc::common::EcuStatus status;
    status.mode.value = dbc::common::EcuStatus::Mode::kActive;
    const dbc::Payload data = status.encode();
    std::string log = "(5000.000000) can0 18FF3382#0000000000000000\n";
    for (int i = 0; i < 10; ++i) {
      log += fmt::format("({:.6f}) can0 18FF3182#", 5000.01 + 0.02 * i + (i < 5 ? 0.0 : break_s));
      for (const auto byte : data) {
        log += fmt::format("{:02X}", byte);
      }
      log += "\n";
    }
    const test::WrittenFile file("run.log", log);
    assert_near(runs::read_run_log(file.path()).active_s, 0.18, 1e-6);
  }
}
