// SPDX-License-Identifier: Apache-2.0
#include "tests/margins/loop_margins.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "tests/margins/frequency_response.hpp"

namespace graben::margins {
namespace {

constexpr double kCycle_s = 0.01;
constexpr double kPi = 3.141592653589793;
constexpr double kTwoPi = 2.0 * kPi;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Even steps of the logarithm, up to Nyquist's frequency.
constexpr double kLowest_hz = 0.03;
constexpr double kHighest_hz = 50.0;
constexpr int kEven = 100;
/// About a resonance the loop turns within a share of its frequency.
constexpr int kAbout = 14;
constexpr double kFarthest = 0.15;
constexpr double kNarrower = 0.6;
/// Golden section's steps about the least margin.
constexpr int kNarrowed = 24;

using Complex = std::complex<double>;

/// 1 / (1 + L) of a channel whose other one is closed, and L.
struct Cut {
  Complex sensitivity;
  Complex loop;
};

class LoopResponse {
 public:
  LoopResponse(const Discrete& law, const Discrete& truth) : law_(law), truth_(truth) {}

  [[nodiscard]] std::array<Cut, 2> at(double hz) const {
    const Complex z = std::polar(1.0, kTwoPi * hz * kCycle_s);
    const Eigen::Matrix2cd one_and_loop = Eigen::Matrix2cd::Identity() - law_.at(z) * truth_.at(z);
    const Complex both = one_and_loop.determinant();
    std::array<Cut, 2> cut;
    for (int channel = 0; channel < 2; ++channel) {
      const Complex other = one_and_loop(1 - channel, 1 - channel);
      cut[static_cast<unsigned>(channel)] = {other / both, both / other - 1.0};
    }
    return cut;
  }

 private:
  FrequencyResponse law_;
  FrequencyResponse truth_;
};

/// |S - T|.
double far_of(const Cut& cut) { return std::abs(2.0 * cut.sensitivity - 1.0); }

/// Even ones, those of the closed loop's modes, and many about the truth's resonances.
std::vector<double> frequencies_hz(const Eigen::VectorXcd& closed, const Eigen::VectorXcd& open) {
  std::vector<double> all;
  for (int n = 0; n <= kEven; ++n) {
    all.push_back(kLowest_hz * std::pow(kHighest_hz / kLowest_hz, double(n) / kEven));
  }
  const auto add = [&](double hz) {
    if (hz > kLowest_hz && hz < kHighest_hz) {
      all.push_back(hz);
    }
  };
  for (const Complex& z : closed) {
    add(std::arg(z) / (kTwoPi * kCycle_s));
  }
  for (const Complex& z : open) {
    const double hz = std::arg(z) / (kTwoPi * kCycle_s);
    double off = kFarthest;
    for (int n = 0; n < kAbout; ++n, off *= kNarrower) {
      add(hz * (1.0 + off));
      add(hz * (1.0 - off));
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The largest |S - T| between two frequencies that have it between them.
void narrow(const LoopResponse& response, unsigned channel, double low_hz, double high_hz,
            ChannelMargin& margin) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int n = 0; n < kNarrowed; ++n) {
    const double first_hz = high_hz - golden * (high_hz - low_hz);
    const double second_hz = low_hz + golden * (high_hz - low_hz);
    const double first = far_of(response.at(first_hz)[channel]);
    const double second = far_of(response.at(second_hz)[channel]);
    const bool is_first = first > second;
    (is_first ? high_hz : low_hz) = is_first ? second_hz : first_hz;
    const double farthest = std::max(first, second);
    if (2.0 / farthest < margin.alpha) {
      margin.alpha = 2.0 / farthest;
      margin.at_hz = is_first ? first_hz : second_hz;
    }
  }
}

/// Crossings of the negative axis and of the circle between two frequencies.
void cross(const Complex& before, const Complex& after, ChannelMargin& margin) {
  if (before.imag() * after.imag() < 0.0) {
    const double share = before.imag() / (before.imag() - after.imag());
    const double real = before.real() + share * (after.real() - before.real());
    if (real < 0.0 && real > -1.0) {
      margin.gain_up = std::min(margin.gain_up, -1.0 / real);
    } else if (real <= -1.0) {
      margin.gain_down = std::max(margin.gain_down, -1.0 / real);
    }
  }
  const double inside = std::abs(before) - 1.0;
  const double outside = std::abs(after) - 1.0;
  if (inside * outside < 0.0) {
    const Complex on = before + inside / (inside - outside) * (after - before);
    margin.phase_rad = std::min(margin.phase_rad, std::abs(std::arg(-on)));
  }
}

ChannelMargin channel_margin(const LoopResponse& response, unsigned channel,
                             const std::vector<double>& hz,
                             const std::vector<std::array<Cut, 2>>& cuts) {
  ChannelMargin margin{kInfinite, 0.0, kInfinite, 0.0, kPi};
  std::size_t farthest = 0;
  for (std::size_t n = 0; n < hz.size(); ++n) {
    farthest = far_of(cuts[n][channel]) > far_of(cuts[farthest][channel]) ? n : farthest;
    if (n > 0) {
      cross(cuts[n - 1][channel].loop, cuts[n][channel].loop, margin);
    }
  }
  margin.alpha = 2.0 / far_of(cuts[farthest][channel]);
  margin.at_hz = hz[farthest];
  narrow(response, channel, hz[farthest == 0 ? 0 : farthest - 1],
         hz[std::min(farthest + 1, hz.size() - 1)], margin);
  return margin;
}

}  // namespace

double LoopMargins::alpha() const { return std::min(channel[0].alpha, channel[1].alpha); }

Eigen::MatrixXd closed_loop(const Discrete& law, const Discrete& truth) {
  const Eigen::Index states = truth.a.rows();
  Eigen::MatrixXd loop(states + law.a.rows(), states + law.a.rows());
  loop << truth.a + truth.b * law.d * truth.c, truth.b * law.c, law.b * truth.c, law.a;
  return loop;
}

LoopMargins loop_margins(const Discrete& law, const Discrete& truth) {
  LoopMargins margins;
  const Eigen::VectorXcd closed = closed_loop(law, truth).eigenvalues();
  margins.spectral_radius = closed.cwiseAbs().maxCoeff();
  if (!margins.stable()) {
    return margins;
  }
  const std::vector<double> hz = frequencies_hz(closed, truth.a.eigenvalues());
  const LoopResponse response(law, truth);
  std::vector<std::array<Cut, 2>> cuts;
  for (const double each : hz) {
    cuts.push_back(response.at(each));
  }
  for (unsigned channel = 0; channel < 2; ++channel) {
    margins.channel[channel] = channel_margin(response, channel, hz, cuts);
  }
  return margins;
}

double gain_db(double alpha) {
  return alpha < 2.0 ? 20.0 * std::log10((2.0 + alpha) / (2.0 - alpha)) : kInfinite;
}

double phase_deg(double alpha) { return 360.0 / kPi * std::atan(0.5 * alpha); }

double decay_ps(double spectral_radius) { return -std::log(spectral_radius) / kCycle_s; }

}  // namespace graben::margins
