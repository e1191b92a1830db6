// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/load/load_terms.hpp"

#include <cmath>

#include "firmware/excavator/estimation/load/tuning.hpp"

namespace graben {
namespace {

/// Loss of pressure in a hose of the class per flow. [Pa s/m3; derived: 4 m of an inch, oil of 46
/// mm2/s and 870 kg/m3, Blasius: with kHose_pas2pm6 0.06 MPa at 100 L/min, 0.20 at 200]
constexpr double kHose_paspm3 = 1.2e7;
/// Loss of pressure in a hose of the class per square of flow. [Pa s2/m6; derived: the same hose
/// with six bends, loss coefficient 0.8 each, Darcy]
constexpr double kHose_pas2pm6 = 1.45e10;

int term_of(int axis, int place) {
  switch (place) {
    case 0:
      return kOffsetTerm + axis;
    case 1:
      return kCoulombTerm + axis;
    case 2:
      return kViscousTerm + axis;
    default:
      return kMassTerm + place - 3;
  }
}

double sum_of_powers(const CylinderGeometry& cylinder, int power) {
  double cap = 1.0;
  double rod = 1.0;
  for (int n = 0; n < power; ++n) {
    cap *= cylinder.cap_area_m2();
    rod *= cylinder.rod_area_m2();
  }
  return cap + rod;
}

double viscous_nspm(const CylinderGeometry& cylinder) {
  return kSealViscous_paspm * cylinder.cap_area_m2() + kHose_paspm3 * sum_of_powers(cylinder, 2);
}

using Column = std::array<double, kTermCount>;

/// Covariance of every term with the row's force.
Column column_of(int axis, const TermRow& row, const LoadTerms& terms) {
  Column column{};
  for (int place = 0; place < TermRow::kCount; ++place) {
    const double share = row.share[static_cast<unsigned>(place)];
    const int term = term_of(axis, place);
    const double* of_term = terms.covariance.data() + LoadTerms::at(term, 0);
    for (int i = 0; i <= term; ++i) {
      column[static_cast<unsigned>(i)] += share * of_term[i];
    }
    unsigned below = LoadTerms::at(term, term);
    for (int i = term + 1; i < kTermCount; ++i) {
      below += static_cast<unsigned>(i);  // from the row before to the same place of this one
      column[static_cast<unsigned>(i)] += share * terms.covariance[below];
    }
  }
  return column;
}

double along(int axis, const TermRow& row, const Column& column) {
  double sum = 0.0;
  for (int place = 0; place < TermRow::kCount; ++place) {
    sum += row.share[static_cast<unsigned>(place)] *
           column[static_cast<unsigned>(term_of(axis, place))];
  }
  return sum;
}

}  // namespace

double hoses_mps(const CylinderGeometry& cylinder) {
  return viscous_nspm(cylinder) / (kHose_pas2pm6 * sum_of_powers(cylinder, 3));
}

LoadTerms terms_unseen(const ExcavatorProfile& profile) {
  LoadTerms terms;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[static_cast<unsigned>(axis)];
    const double cap_m2 = cylinder.cap_area_m2();
    const double offset_n = kTransducerOffset * profile.safety.pressure_rail_pa *
                            std::hypot(cap_m2, cylinder.rod_area_m2());
    const double coulomb_n = kSealCoulomb_pa * cap_m2;
    const double slows_nspm = viscous_nspm(cylinder);
    set_term(kOffsetTerm + axis, 0.0, offset_n, terms);
    set_term(kCoulombTerm + axis, coulomb_n, kSealCoulombOff * coulomb_n, terms);
    set_term(kViscousTerm + axis, slows_nspm, kViscousOff * slows_nspm, terms);
    set_term(kMassTerm + axis, 0.0, kLinkMassOff, terms);
  }
  return terms;
}

void set_term(int term, double value, double sd, LoadTerms& terms) {
  terms.value[static_cast<unsigned>(term)] = value;
  for (int i = 0; i < kTermCount; ++i) {
    terms.covariance[LoadTerms::at(i, term)] = 0.0;
  }
  terms.covariance[LoadTerms::at(term, term)] = sd * sd;
}

double force_of(int axis, const TermRow& row, const LoadTerms& terms) {
  return along(axis, row, terms.value);
}

bool is_likely(int axis, const SeenForce& seen, double deviations, const LoadTerms& terms) {
  const double whole_n2 =
      along(axis, seen.row, column_of(axis, seen.row, terms)) + seen.variance_n2;
  const double missed_n = seen.force_n - force_of(axis, seen.row, terms);
  return missed_n * missed_n <= deviations * deviations * whole_n2;
}

void learn(int axis, const SeenForce& seen, LoadTerms& terms) {
  const Column column = column_of(axis, seen.row, terms);
  const double whole_n2 = along(axis, seen.row, column) + seen.variance_n2;
  const double missed_n = seen.force_n - force_of(axis, seen.row, terms);
  for (int i = 0; i < kTermCount; ++i) {
    const double gain = column[static_cast<unsigned>(i)] / whole_n2;
    terms.value[static_cast<unsigned>(i)] += gain * missed_n;
    for (int j = 0; j <= i; ++j) {
      terms.covariance[LoadTerms::at(i, j)] -= gain * column[static_cast<unsigned>(j)];
    }
  }
}

Eigen::Vector3d force_covariance_n2(int axis, const std::array<TermRow, kAxisCount>& row,
                                    const LoadTerms& terms) {
  const Column column = column_of(axis, row[static_cast<unsigned>(axis)], terms);
  Eigen::Vector3d covariance;
  for (int other = 0; other < kAxisCount; ++other) {
    covariance[other] = along(other, row[static_cast<unsigned>(other)], column);
  }
  return covariance;
}

}  // namespace graben
