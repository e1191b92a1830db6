// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a warning is found: a figure against what machines have.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/reports/check/machine_check.hpp"

namespace graben::reports {

class Warnings {
 public:
  /// Unless `value` is within `least` .. `most`; `what` says what it is, with the profile's value.
  void expect(const std::string& key, double value, double least, double most,
              const std::string& what, const char* unit = "") {
    // Written so that NaN warns.
    if (!(value >= least && value <= most)) {
      const std::string of_unit = unit[0] == '\0' ? "" : fmt::format(" {}", unit);
      found_.push_back({key, fmt::format("{}: {:.4g}{}; usual: {:.4g} .. {:.4g}{}", what, value,
                                         of_unit, least, most, of_unit)});
    }
  }
  void add_if(bool is_odd, const std::string& key, const std::string& text) {
    if (is_odd) {
      found_.push_back({key, text});
    }
  }
  [[nodiscard]] std::vector<Warning> take() { return std::move(found_); }

 private:
  std::vector<Warning> found_;
};

/// Half a spool's worth of flow through a metering edge; Pa. No part of the controller's model.
[[nodiscard]] double edge_drop_pa(double flow_m3ps, double area_m2, double discharge,
                                  double density_kgpm3);

/// What both kinds of machine have: rods, spools, oil, times.
void expect_rod(Warnings& warnings, const std::string& key, double bore_m, double rod_m);
void expect_times(Warnings& warnings, double settle_s, double sensor_timeout_s, double response_s);
void expect_spool(Warnings& warnings, const std::string& valve, double time_constant_s,
                  double damping, double settle_s, double response_s);
/// `key` is the table's.
void expect_deadband(Warnings& warnings, const std::string& key, double deadband_ratio,
                     const DutyTable& spool_to_duty);
void expect_oil(Warnings& warnings, const std::string& valve, double bulk_modulus_pa);

}  // namespace graben::reports
