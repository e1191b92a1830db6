// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The optimisation of Kim et al. (37) as a general solver wants it: scaled variables, scaled
/// margins that exist and are smooth also where they are violated, derivatives.
///
///   maximise lambda, 0 <= lambda <= highest_lambda(), over lambda and u_j = sqrt(P_j / P_j,0)
///   balance(j) = 0   for each pump that feeds a moving actuator (27), (28), Remark 2
///   margins(i) >= 0  for each moving actuator (36) with F_offset, (13)
///
/// What the core has worked out on paper is given to the peers: pump flow (29), (30) is linear in
/// lambda at zero pressure, hence a bound; spool travel (13) is asked for as the force that full
/// opening needs, which is finite everywhere; a margin is what drives less what resists, each as a
/// length, sqrt(force), which is nearly straight where the force itself has slope 0 at P = 0 (a
/// tenth fewer evaluations for each of them than with forces); pressures are highest at standstill,
/// hence u lies in [0, 1]. Pumps and actuators at rest take no part.

#include "firmware/mcv/evaluation.hpp"

namespace graben::timing {

/// A value with its gradient.
struct Slope {
  double value = 0.0;
  double by_lambda = 0.0;
  double by_u = 0.0;
};

/// Second derivatives that go with a Slope.
struct Curvature {
  double by_lambda_lambda = 0.0;
  double by_lambda_u = 0.0;
  double by_u_u = 0.0;
};

struct AxisMargins {
  Slope force;   ///< (36): over F_offset. As a share of what drives and what loads at standstill.
  Slope travel;  ///< (13): over what full opening needs, scaled alike.
};

/// How smallest_margin measures. The sign is the same, and so is the root.
enum class MarginForm { kLength, kForce };

class LambdaProblem {
 public:
  LambdaProblem(const McvMachine& machine, const McvInput& input);

  [[nodiscard]] unsigned line_count() const { return line_count_; }
  [[nodiscard]] unsigned axis_count() const { return axis_count_; }
  /// Column of the pressure that drives an axis, counted from 0.
  [[nodiscard]] unsigned line_of(unsigned axis) const { return axis_line_[axis]; }
  /// 1, or less where a pump cannot feed its line any faster.
  [[nodiscard]] double highest_lambda() const { return highest_lambda_; }

  /// u_j where the balance is met; 0 where the pump is not fed. By the core's own Newton.
  [[nodiscard]] double solved_u(unsigned line, double lambda) const;
  /// What the pump of a line has left over, as a share of its flow; with a relief valve the smaller
  /// of that and what is left up to its pressure: the complementarity of Remark 2 as one equation.
  [[nodiscard]] Slope balance(unsigned line, double lambda, double u) const;
  [[nodiscard]] Curvature balance_curvature(unsigned line, double lambda, double u) const;
  [[nodiscard]] AxisMargins margins(unsigned axis, double lambda, double u) const;
  /// Second derivatives of w_force * force + w_travel * travel.
  [[nodiscard]] Curvature margins_curvature(unsigned axis, double lambda, double u, double w_force,
                                            double w_travel) const;

  /// The pressures of the last call; they save Newton steps in the next.
  struct Near {
    double lambda = 0.0;
    PerPump<double> sqrt_pressure{};
  };
  /// The smallest margin of all with the pressures solved for: lambda is then the only unknown.
  [[nodiscard]] double smallest_margin(double lambda, Near& near,
                                       MarginForm form = MarginForm::kLength) const;
  /// (43): motion can begin. Asked before any search: a solver that is handed a problem without a
  /// solution spends most of its time on finding that out.
  [[nodiscard]] bool can_start() const;

 private:
  [[nodiscard]] const FlowBalance& balance_of(unsigned line) const {
    return circuit_.line[line_[line]];
  }
  [[nodiscard]] const CircuitAxis& axis_of(unsigned axis) const {
    return circuit_.axis[axis_[axis]];
  }
  [[nodiscard]] double smallest_margin_at(double lambda, const PerPump<double>& s,
                                          MarginForm form) const;

  McvCircuit circuit_;
  double highest_lambda_ = 1.0;
  unsigned line_count_ = 0;
  unsigned axis_count_ = 0;
  PerPump<unsigned> line_{};            ///< Of the circuit, those that feed something.
  PerPump<double> s_standstill_{};      ///< sqrt(P_j,0), by line.
  PerPump<double> flow_scale_{};        ///< 1 / m^3/s, by line.
  PerActuator<unsigned> axis_{};        ///< Of the circuit, those that move.
  PerActuator<unsigned> axis_line_{};   ///< Their line.
  PerActuator<double> length_scale_{};  ///< 1 / sqrt(N), by axis.
};

}  // namespace graben::timing
