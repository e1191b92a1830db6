// SPDX-License-Identifier: Apache-2.0
#include "app/identify/dozer/lag_fit.hpp"

#include <algorithm>
#include <cmath>

#include "app/identify/machine/machine_log.hpp"

namespace graben::identify {
namespace {

constexpr double kMostDead_s = 0.35;
constexpr double kMostLag_s = 0.5;
constexpr double kLeastLag_s = 0.004;
/// Steps of the search, each around the best of the one before.
constexpr int kLevels = 5;
constexpr int kPlacesEach = 12;
/// Of a grid point: so finely lags are followed.
constexpr int kParts = 5;

/// Of a pilot and a spool whose lags are not alike, equal ones make another dead time.
constexpr double kUnlike_s = 0.006;

struct Tried {
  double dead_s = 0.0;
  double lag_s = 0.0;
  double squares = 0.0;
};

class LagProblem {
 public:
  LagProblem(const std::vector<SentAndSeen>& pieces, int lags, double start)
      : pieces_(pieces), lags_(lags), start_(start) {}

  [[nodiscard]] Tried at(double dead_s, double lag_s) const {
    Tried tried{dead_s, lag_s, 0.0};
    for (const SentAndSeen& piece : pieces_) {
      tried.squares += squares_of(piece, dead_s, lag_s);
    }
    return tried;
  }
  [[nodiscard]] std::size_t count() const {
    std::size_t count = 0;
    for (const SentAndSeen& piece : pieces_) {
      count +=
          piece.judged.empty()
              ? piece.seen.size()
              : static_cast<std::size_t>(std::count(piece.judged.begin(), piece.judged.end(), 1));
    }
    return count;
  }

 private:
  [[nodiscard]] double squares_of(const SentAndSeen& piece, double dead_s, double lag_s) const;

  const std::vector<SentAndSeen>& pieces_;
  int lags_;
  double start_;
};

double LagProblem::squares_of(const SentAndSeen& piece, double dead_s, double lag_s) const {
  const double part_s = kGrid_s / kParts;
  const double share = -std::expm1(-part_s * lags_ / std::max(lag_s, kLeastLag_s));
  const auto late = static_cast<int>(std::lround(std::max(0.0, dead_s) / part_s));
  double first = start_;
  double second = start_;
  double squares = 0.0;
  for (std::size_t n = 0; n < piece.sent.size(); ++n) {
    for (int part = 0; n > 0 && part < kParts; ++part) {
      // What was sent at a grid point holds until the next one.
      const int place = (static_cast<int>(n) - 1) * kParts + part - late;
      const double sent = place < 0 ? start_ : piece.sent[static_cast<std::size_t>(place / kParts)];
      first += share * (sent - first);
      second += share * (first - second);
    }
    if (piece.judged.empty() || piece.judged[n] != 0) {
      const double off = (lags_ == 1 ? first : second) - piece.seen[n];
      squares += off * off;
    }
  }
  return squares;
}

/// By how much a value may change until the squares grow by what noise gives them.
double deviation_of(double squares, double less, double more, double step, double each) {
  const double curvature = (less - 2.0 * squares + more) / (step * step);
  const double by_noise = curvature > 0.0 ? std::sqrt(2.0 * each / curvature) : step;
  return std::hypot(kUnlike_s, by_noise);
}

}  // namespace

LagFit fit_lag(const std::vector<SentAndSeen>& pieces, int lags, double start) {
  const LagProblem problem(pieces, lags, start);
  LagFit fit;
  if (problem.count() == 0) {
    return fit;
  }
  Tried best = problem.at(0.0, kLeastLag_s);
  double dead_step = kMostDead_s / kPlacesEach;
  double lag_step = kMostLag_s / kPlacesEach;
  double dead_from = 0.0;
  double lag_from = kLeastLag_s;
  for (int level = 0; level < kLevels; ++level) {
    for (int i = 0; i <= kPlacesEach; ++i) {
      for (int j = 0; j <= kPlacesEach; ++j) {
        const Tried tried =
            problem.at(std::clamp(dead_from + i * dead_step, 0.0, kMostDead_s),
                       std::clamp(lag_from + j * lag_step, kLeastLag_s, kMostLag_s));
        best = tried.squares < best.squares ? tried : best;
      }
    }
    dead_step *= 3.0 / kPlacesEach;
    lag_step *= 3.0 / kPlacesEach;
    dead_from = best.dead_s - 0.5 * kPlacesEach * dead_step;
    lag_from = best.lag_s - 0.5 * kPlacesEach * lag_step;
  }
  const auto count = static_cast<double>(problem.count());
  const double each = best.squares / std::max(1.0, count - 2.0);
  constexpr double kStep_s = 0.004;
  fit.dead_time_s = {
      best.dead_s,
      deviation_of(best.squares, problem.at(best.dead_s - kStep_s, best.lag_s).squares,
                   problem.at(best.dead_s + kStep_s, best.lag_s).squares, kStep_s, each),
      true};
  fit.lag_s = {best.lag_s,
               deviation_of(best.squares, problem.at(best.dead_s, best.lag_s - kStep_s).squares,
                            problem.at(best.dead_s, best.lag_s + kStep_s).squares, kStep_s, each),
               true};
  fit.rms = std::sqrt(best.squares / count);
  return fit;
}

}  // namespace graben::identify
