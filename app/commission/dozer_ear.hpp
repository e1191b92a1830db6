// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is heard of a dozer on its bus while it is commissioned.

#include <array>
#include <cstddef>
#include <optional>

#include "app/commission/dozer_sequence.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"

namespace graben::commission {

class DozerEar {
 public:
  void hear(const CanFrame& frame, TimeUs now_us);

  /// As it came last, whenever that was; 0 what never came. `active` as the controller says it.
  [[nodiscard]] const DozerSeen& seen() const { return seen_; }
  /// All that the sequence goes by came of late and is valid: the blade's stroke, the body's
  /// position and speed, the tilt's stroke where there is one.
  [[nodiscard]] bool hears_machine(bool has_tilt, TimeUs now_us) const;
  /// Stroke of lift or tilt, m, and the body's position, m; empty where none came of late.
  [[nodiscard]] std::optional<double> stroke_m(std::size_t drive, TimeUs now_us) const;
  [[nodiscard]] std::optional<double> position_m(TimeUs now_us) const;

 private:
  static constexpr TimeUs kNever_us = -kSecondUs;

  static void take(const dbc::Physical& value, TimeUs now_us, double& to, TimeUs& at_us);

  DozerSeen seen_;
  std::array<TimeUs, 2> stroke_us_{kNever_us, kNever_us};
  TimeUs position_us_ = kNever_us;
  TimeUs velocity_us_ = kNever_us;
};

}  // namespace graben::commission
