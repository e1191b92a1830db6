// SPDX-License-Identifier: Apache-2.0
#include "app/runs/calm.hpp"

#include <algorithm>

#include "app/runs/figures.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

/// How many periods of the cutoff a signal goes on beyond its ends: by then the filter has
/// forgotten how it began.
constexpr std::ptrdiff_t kBeyondPeriods = 3;

/// By the bilinear transform, which puts the cutoff where it belongs. Begins as if the first value
/// had always been there.
class LowPass {
 public:
  LowPass(double cutoff_hz, double first) {
    const double k = std::tan(0.5 * kTwoPi * cutoff_hz * kSampled_s);
    const double root2 = std::sqrt(2.0);
    const double whole = 1.0 + root2 * k + k * k;
    in_ = k * k / whole;
    back1_ = 2.0 * (k * k - 1.0) / whole;
    back2_ = (1.0 - root2 * k + k * k) / whole;
    state1_ = first * (1.0 - in_);
    state2_ = first * (in_ - back2_);
  }

  double step(double value) {
    const double out = in_ * value + state1_;
    state1_ = 2.0 * in_ * value - back1_ * out + state2_;
    state2_ = in_ * value - back2_ * out;
    return out;
  }

 private:
  double in_;
  double back1_;
  double back2_;
  double state1_;
  double state2_;
};

template <class Iterator>
void filter(Iterator from, Iterator until, double cutoff_hz) {
  LowPass low_pass(cutoff_hz, *from);
  std::transform(from, until, from, [&](double value) { return low_pass.step(value); });
}

/// Of the least-squares line through these values, a cycle.
template <class Iterator>
double slope_of(Iterator from, Iterator until) {
  const auto last = static_cast<double>(until - from - 1);
  double moment = 0.0;
  double spread = 0.0;
  for (Iterator at = from; at != until; ++at) {
    const double arm = static_cast<double>(at - from) - 0.5 * last;
    moment += arm * *at;
    spread += arm * arm;
  }
  return spread > 0.0 ? moment / spread : 0.0;
}

/// What comes before `from`, the nearest first: mirrored, and turned by twice the slope that the
/// `near` first values have.
template <class Iterator>
std::vector<double> before(Iterator from, std::ptrdiff_t beyond, std::ptrdiff_t near) {
  const double slope = slope_of(from, from + near);
  std::vector<double> values;
  for (std::ptrdiff_t n = 1; n <= beyond; ++n) {
    values.push_back(from[n] - 2.0 * slope * static_cast<double>(n));
  }
  return values;
}

}  // namespace

std::vector<double> slow_part(const std::vector<double>& signal, double cutoff_hz) {
  if (signal.empty()) {
    return {};
  }
  const auto count = static_cast<std::ptrdiff_t>(signal.size());
  const auto period = static_cast<std::ptrdiff_t>(std::lround(1.0 / (cutoff_hz * kSampled_s)));
  const std::ptrdiff_t near = std::min(count, period);
  const std::ptrdiff_t beyond = std::min(count - 1, kBeyondPeriods * period);
  const std::vector<double> earlier = before(signal.begin(), beyond, near);
  const std::vector<double> later = before(signal.rbegin(), beyond, near);
  std::vector<double> longer(earlier.rbegin(), earlier.rend());
  longer.insert(longer.end(), signal.begin(), signal.end());
  longer.insert(longer.end(), later.begin(), later.end());
  filter(longer.begin(), longer.end(), cutoff_hz);
  filter(longer.rbegin(), longer.rend(), cutoff_hz);
  return {longer.begin() + beyond, longer.begin() + beyond + count};
}

double ringing_rms(const std::vector<double>& signal, double cutoff_hz) {
  const std::vector<double> slow = slow_part(signal, cutoff_hz);
  Spread left;
  for (std::size_t n = 0; n < signal.size(); ++n) {
    left.add(signal[n] - slow[n]);
  }
  return left.rms();
}

void Jerk::add(const Eigen::Vector3d& at_m) {
  if (known_ == last_m_.size()) {
    const Eigen::Vector3d third_m = at_m - 3.0 * last_m_[0] + 3.0 * last_m_[1] - last_m_[2];
    for (unsigned i = 0; i < jerk_mps3_.size(); ++i) {
      jerk_mps3_[i].push_back(third_m[i] / (kSampled_s * kSampled_s * kSampled_s));
    }
  } else {
    ++known_;
  }
  last_m_ = {at_m, last_m_[0], last_m_[1]};
}

void Jerk::pause() {
  count_ += jerk_mps3_.front().size();
  for (std::vector<double>& one : jerk_mps3_) {
    for (const double slow_mps3 : slow_part(one, kJerkBelow_hz)) {
      squares_m2ps6_ += slow_mps3 * slow_mps3;
    }
    one.clear();
  }
  known_ = 0;
}

double Jerk::rms_mps3() {
  pause();
  return count_ > 0 ? std::sqrt(squares_m2ps6_ / static_cast<double>(count_)) : 0.0;
}

}  // namespace graben::runs
