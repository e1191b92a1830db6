#pragma once
/// A pure delay of a signal that is given once a step.

#include <cstddef>
#include <vector>

namespace graben::plant {

class DeadTime {
 public:
  /// Rounded to whole steps.
  DeadTime(double dead_time_s, double step_s);

  /// Takes this step's value, gives that of `dead_time_s` ago; 0 before.
  double step(double value);

 private:
  std::vector<double> past_;
  std::size_t next_ = 0;
};

}  // namespace graben::plant
