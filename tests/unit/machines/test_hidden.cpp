// SPDX-License-Identifier: Apache-2.0
// Hidden machines: within their ranges, each figure by itself, and what a perfect identification
// finds.

#include "app/machines/simulated/hidden.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "app/machines/simulated/machine_truth.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using machines::hidden_machine;
using machines::MachineTruth;
using machines::SideTruth;
using machines::SimulatedExcavator;
using machines::truth_of;

constexpr std::uint64_t kSeeds = 400;

const SimulatedExcavator& nominal() {
  static const SimulatedExcavator machine =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  return machine;
}

/// A figure of a hidden machine and where it may be.
struct Figure {
  std::string name;
  double value;
  double least;
  double most;
};

class Figures {
 public:
  void add(const std::string& name, double value, double least, double most) {
    all_.push_back({name, value, least, most});
  }
  void add_share(const std::string& name, double value, double from, double share) {
    add(name, value, (1.0 - share) * from, (1.0 + share) * from);
  }
  void add_side(const std::string& of, const SideTruth& side, double in_m2, double out_m2) {
    add("edge" + of, side.edge_ratio, 0.10, 0.55);
    add("softness" + of, side.softness_ratio, 0.02, 0.12);
    add("exponent" + of, side.opening_exponent, 1.3, 1.9);
    add("lag" + of, side.lag_s, 0.015, 0.150);
    add_share("in" + of, side.in_m2, in_m2, 0.3);
    add_share("out" + of, side.out_m2, out_m2, 0.3);
  }
  [[nodiscard]] const std::vector<Figure>& all() const { return all_; }

 private:
  std::vector<Figure> all_;
};

std::vector<Figure> figures(const plant::ExcavatorPlantProfile& plant) {
  const plant::ExcavatorPlantProfile& exact = nominal().plant;
  const MachineTruth truth = truth_of(plant);
  Figures all;
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    const std::string of = " of drive " + std::to_string(i);
    const machines::DriveTruth& drive = truth.drive[i];
    const SpoolProfile& spool = exact.machine.valve.spool[i];
    all.add_side(" extending" + of, drive.extend, spool.extend_in_m2, spool.extend_out_m2);
    all.add_side(" retracting" + of, drive.retract, spool.retract_in_m2, spool.retract_out_m2);
    all.add("dead time" + of, 0.5 * (drive.extend.dead_time_s + drive.retract.dead_time_s), 0.0,
            0.250);
    all.add("cap" + of, drive.cap_zero_pa, -1.2e6, 1.2e6);
    all.add("rod" + of, drive.rod_zero_pa, -1.2e6, 1.2e6);
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const std::string of = " of axis " + std::to_string(i);
    all.add_share("Coulomb" + of, plant.friction[i].coulomb_n, exact.friction[i].coulomb_n, 0.5);
    all.add_share("viscous" + of, plant.friction[i].viscous_nspm, exact.friction[i].viscous_nspm,
                  0.5);
    all.add_share("mass" + of, plant.link[i].mass_kg, exact.link[i].mass_kg, 0.15);
    all.add("stroke zero" + of, truth.drive[i].stroke_zero_m, -0.010, 0.010);
  }
  for (std::size_t p = 0; p < kPumpCount; ++p) {
    all.add("flow of pump " + std::to_string(p), truth.pump_flow_factor[p], 0.9, 1.1);
  }
  all.add("oil", truth.bulk_modulus_pa, 0.7e9, 1.6e9);
  return all.all();
}

/// The seeds fill each range and never leave it; no two figures go together but a drive's lag,
/// which both of its sides have.
TEST(each_figure_fills_its_range_by_itself) {
  std::vector<std::vector<double>> share;  // Of its range, by figure and seed.
  std::vector<std::string> name;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Figure> found = figures(hidden_machine(nominal(), seed).plant);
    share.resize(found.size());
    name.resize(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      name[k] = found[k].name;
      share[k].push_back((found[k].value - found[k].least) / (found[k].most - found[k].least));
      if (!(share[k].back() >= -1e-9 && share[k].back() <= 1.0 + 1e-9)) {
        fail_msg("%s is %.17g", name[k].c_str(), found[k].value);
      }
    }
  }
  for (std::size_t k = 0; k < share.size(); ++k) {
    const auto [least, most] = std::minmax_element(share[k].begin(), share[k].end());
    if (!(*least < 0.03 && *most > 0.97)) {
      fail_msg("%s from %g to %g of its range", name[k].c_str(), *least, *most);
    }
    for (std::size_t other = 0; other < k; ++other) {
      double moment = 0.0;
      for (std::size_t i = 0; i < kSeeds; ++i) {
        moment += (share[k][i] - 0.5) * (share[other][i] - 0.5) / kSeeds;
      }
      const bool is_same_lag = share[k] == share[other];
      if (!is_same_lag && std::abs(12.0 * moment) > 0.3) {
        fail_msg("%s and %s: %g", name[k].c_str(), name[other].c_str(), 12.0 * moment);
      }
    }
  }
}

std::vector<double> values(std::uint64_t seed) {
  std::vector<double> all;
  for (const Figure& figure : figures(hidden_machine(nominal(), seed).plant)) {
    all.push_back(figure.value);
  }
  return all;
}

TEST(a_seed_is_a_machine) {
  const std::vector<double> once = values(7);
  const std::vector<double> other = values(8);
  assert_true(once == values(7));
  for (std::size_t k = 0; k < once.size(); ++k) {
    assert_true(once[k] != other[k]);
  }
}

/// Figures of the day on which it was written: machines with these seeds are spoken of in results.
TEST(a_seed_stays_the_machine_it_was) {
  const MachineTruth truth = truth_of(hidden_machine(nominal(), 1).plant);
  assert_near(truth.drive[kBoom].extend.edge_ratio, 0.40003385602308816, 1e-12);
  assert_near(truth.drive[kSwing].retract.dead_time_s, 0.22816595979899298, 1e-12);
  assert_near(truth.drive[kArm].stroke_zero_m, -0.0019948988515888443, 1e-12);
}

TEST(directions_and_drives_differ) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const plant::ExcavatorPlantProfile plant = hidden_machine(nominal(), seed).plant;
    for (std::size_t i = 0; i < kDriveCount; ++i) {
      const plant::SpoolDynamics& spool = plant.spool[i];
      assert_true(spool.extend.deadband_ratio != spool.retract.deadband_ratio);
      assert_true(spool.extend.opening_exponent != spool.retract.opening_exponent);
      assert_true(spool.bypass_closing_travel <= spool.extend.start_ratio());
      assert_true(spool.bypass_closing_travel <= spool.retract.start_ratio());
      assert_true(spool.bypass_closing_travel > 0.0 && spool.bypass_closing_travel <= 0.1);
      const plant::SideDelay& delay = plant.dead_time[i];
      assert_true(delay.extend_s != delay.retract_s);
      assert_true(std::abs(delay.extend_s - delay.retract_s) <= 0.030 + 1e-12);
      assert_true(delay.extend_s >= 0.0 && delay.extend_s <= 0.250);
      assert_true(delay.retract_s >= 0.0 && delay.retract_s <= 0.250);
      const double spool_s = 2.0 * spool.damping * spool.time_constant_s;
      const double share = spool_s / (spool_s + plant.pilot_lag_s[i]);
      assert_true(share >= 0.25 - 1e-12 && share <= 0.75 + 1e-12);
      for (std::size_t other = 0; other < i; ++other) {
        assert_true(spool.extend.deadband_ratio != plant.spool[other].extend.deadband_ratio);
      }
    }
  }
}

/// Nothing that the controller knows, nor the plant's copy of it; and what is drawn beside it is
/// drawn about the hidden machine.
TEST(only_the_plant_is_hidden) {
  const SimulatedExcavator hidden = hidden_machine(nominal(), 3);
  assert_int_equal(hidden.hash, nominal().hash);
  for (const ExcavatorProfile* profile : {&hidden.profile, &hidden.plant.machine}) {
    const SpoolProfile& spool = profile->valve.spool[kBoom];
    assert_near(spool.extend_in_m2, nominal().profile.valve.spool[kBoom].extend_in_m2, 0.0);
    assert_near(profile->pump[0].displacement_m3prev, nominal().profile.pump[0].displacement_m3prev,
                0.0);
    assert_near(profile->control.dead_time_s, nominal().profile.control.dead_time_s, 0.0);
  }
  machines::Scenario scenario;
  scenario.errors = machines::Errors::kKim;
  scenario.seed = 5;
  scenario.dead_time_s = 0.4;
  const SimulatedExcavator drawn = arranged(hidden, scenario);
  assert_near(drawn.profile.control.dead_time_s, 0.4, 0.0);
  const double factor =
      drawn.plant.dead_time[kBoom].extend_s / hidden.plant.dead_time[kBoom].extend_s;
  assert_true(factor != 1.0 && factor >= 0.7 && factor <= 1.3);
  assert_near(drawn.plant.spool[kArm].retract.deadband_ratio,
              hidden.plant.spool[kArm].retract.deadband_ratio, 0.0);
}

/// The truth's curve is what a spool of the plant opens, and its two ways to tell a delay agree.
TEST(truth_is_what_the_plant_does) {
  const plant::ExcavatorPlantProfile plant = hidden_machine(nominal(), 4).plant;
  const MachineTruth truth = truth_of(plant);
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    for (const SideTruth* side : {&truth.drive[i].extend, &truth.drive[i].retract}) {
      assert_near(side->opening.front().first, side->start_ratio, 0.0);
      assert_near(side->opening.front().second, 0.0, 1e-12);
      assert_near(side->opening.back().first, 1.0, 1e-12);
      assert_near(side->opening.back().second, 1.0, 1e-9);
      for (std::size_t k = 1; k < side->opening.size(); ++k) {
        assert_true(side->opening[k].first > side->opening[k - 1].first);
        assert_true(side->opening[k].second > side->opening[k - 1].second);
      }
      // Behind the bend as of a sharp edge.
      const double at = 0.5 * (1.0 + side->edge_ratio);
      const plant::SpoolDynamics& spool = plant.spool[i];
      const plant::SpoolSide& own = side == &truth.drive[i].extend ? spool.extend : spool.retract;
      assert_near(own.area_ratio(at), std::pow(0.5, side->opening_exponent), 1e-9);
      assert_near(side->first_order_dead_time_s + side->first_order_lag_s,
                  side->dead_time_s + side->lag_s, 1e-12);
      assert_true(side->first_order_dead_time_s > side->dead_time_s);
    }
  }
  assert_true(truth_of(nominal().plant).drive[kBoom].extend.softness_ratio == 0.0);
  assert_near(truth_of(nominal().plant).drive[kBoom].retract.edge_ratio, 0.2, 0.0);
}
