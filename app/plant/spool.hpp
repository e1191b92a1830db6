#pragma once
/// A spool's travel and what it opens.

namespace graben::plant {

struct SpoolDynamics {
  double time_constant_s = 0.0;  ///< 1 / natural frequency.
  double damping = 1.0;
  double deadband_ratio = 0.0;  ///< Of the full travel, each side.
  double opening_exponent = 1.0;
  double bypass_closing_travel = 1.0;  ///< See ExcavatorPlantProfile.
};

/// Second-order lag from duty to travel with mechanical limits at full travel (Kim 5). Travel is in
/// units of the full travel x_m, -1 .. 1, positive extends the cylinder. Integrated by the
/// trapezoidal rule, stable at any step.
class Spool {
 public:
  explicit Spool(const SpoolDynamics& dynamics);

  void set_command(double travel_ratio);
  /// Returns whether the spool moved.
  bool step(double step_s);

  [[nodiscard]] double travel_ratio() const { return travel_; }
  /// Share of the full metering areas that is open, 0 within the deadband.
  [[nodiscard]] double area_ratio() const { return area_ratio_; }
  /// How far the bypass has closed: 0 at neutral, 1 from the deadband's edge on.
  [[nodiscard]] double bypass_closed_ratio() const { return bypass_closed_; }

 private:
  void update_openings();

  double natural_frequency_radps_;
  double damping_;
  double deadband_;
  double exponent_;
  double bypass_closing_;
  double command_ = 0.0;
  double travel_ = 0.0;
  double speed_ps_ = 0.0;
  double area_ratio_ = 0.0;
  double bypass_closed_ = 0.0;
};

}  // namespace graben::plant
