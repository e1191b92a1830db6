// SPDX-License-Identifier: Apache-2.0
/// The unit of cost: how long six compiles of this take says how fast a processor is now
/// (tests/cost/budget.py). Templates and optimisation, as most of our sources; short, so that it
/// can be made often. Whoever changes it changes every figure.

#include <Eigen/Core>
#include <map>
#include <string>

double solved(const Eigen::Matrix<double, 6, 6>& a, const Eigen::Matrix<double, 6, 1>& b) {
  return (a.transpose() * a * b + a * b).norm();
}

std::string joined(const std::map<std::string, std::string>& rows) {
  std::string text;
  for (const auto& [name, value] : rows) {
    text += name + "=" + value + "\n";
  }
  return text;
}
