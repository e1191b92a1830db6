// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a duty is to take a spool that is led through its lag, told from the duties alone.

namespace graben::test {

/// A spool of the second order, critically damped, at commands 10 ms apart.
class LedSpool {
 public:
  /// Spool ratio 20 ms from now, under this duty; then 10 ms on.
  [[nodiscard]] double aim(double duty_ratio, double time_constant_s);
  /// Neutral and at rest.
  void rest() { *this = {}; }
  /// A command was not seen: where the spool is, is not known for a while.
  void miss() { unsure_commands_ = kUnsureCommands; }
  [[nodiscard]] bool is_known() const { return unsure_commands_ == 0; }

 private:
  /// Ten time constants of a spool of 20 ms.
  static constexpr int kUnsureCommands = 20;

  void go_on(double duty_ratio, double time_constant_s, double time_s);

  double travel_ratio_ = 0.0;
  double speed_ps_ = 0.0;
  int unsure_commands_ = 0;
};

}  // namespace graben::test
