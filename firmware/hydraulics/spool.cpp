#include "firmware/hydraulics/spool.hpp"

#include <array>
#include <cmath>

namespace graben {

double full_opening_velocity_coefficient(const SpoolMetering& metering, double spool_in_m2,
                                         double spool_out_m2, double inlet_area_m2,
                                         double outlet_area_m2) {
  const auto cube_over_square = [](double piston, double opening) {
    return piston * piston * piston / (opening * opening);
  };
  const double resistance =
      cube_over_square(inlet_area_m2, spool_in_m2) + cube_over_square(outlet_area_m2, spool_out_m2);
  return std::sqrt(2.0 / metering.density_kgpm3) * metering.discharge / std::sqrt(resistance);
}

MonotoneTable velocity_coefficient_table(const SpoolMetering& metering, double coefficient_full) {
  constexpr int kPoints = MonotoneTable::kCapacity;
  std::array<double, kPoints> travel{};
  std::array<double, kPoints> coefficient{};
  for (int i = 0; i < kPoints; ++i) {
    const auto k = static_cast<unsigned>(i);
    const double share = static_cast<double>(i) / (kPoints - 1);
    const double opening = share * share;
    travel[k] = metering.spool_travel_m * opening;
    coefficient[k] = coefficient_full * std::pow(opening, metering.opening_exponent);
  }
  MonotoneTable table;
  // A profile that passed its check fills it; another leaves it empty, which the machine's check
  // finds.
  static_cast<void>(table.fill(travel.data(), coefficient.data(), kPoints));
  return table;
}

}  // namespace graben
