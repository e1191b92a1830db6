// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tip force and payload as the controller tells them, beside the true ones.

#include "app/runs/autodig_run.hpp"

namespace graben::runs {

/// Of samples in their order.
class LoadFigures {
 public:
  /// `capacity_kg`: see AutodigResult.
  explicit LoadFigures(double capacity_kg) : capacity_kg_(capacity_kg) {}

  void add(const AutodigSample& sample);
  /// What was compared; the rest stays not a number.
  void tell(AutodigSummary& summary) const;

 private:
  struct Compared {
    double error_n = 0.0;
    double deviation_n = 0.0;
  };

  void weigh(const AutodigSample& sample);
  void count_round(const AutodigSample& sample);

  double capacity_kg_;
  double largest_n_ = 0.0;
  std::vector<Compared> dug_;
  double carried_error_kg_ = 0.0;  ///< As it was told last; with the next one.
  double carried_deviation_kg_ = 0.0;
  double carried_kg_ = -1.0;  ///< Truly, before this dump; below 0: nothing was.
  int rounds_ = 0;            ///< Dumps, weighed or not.
  int full_ = 0;              ///< Of them, of a bucket that was.
  int dumps_ = 0;
  int exact_ = 0;
  int weighed_ = 0;
  double worst_kg_ = 0.0;
  double spread_squares_ = 0.0;
};

}  // namespace graben::runs
