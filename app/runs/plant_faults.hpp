// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faults of a simulated machine by name and time, for a machine that runs on a real bus.

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/plant/dozer_faults.hpp"
#include "app/plant/excavator_faults.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_port.hpp"

namespace graben::runs {

/// What can go wrong, by its name. `value` is what was told behind `=`; SI units.
template <class Faults>
using PlantFaultTable = std::map<std::string, std::function<void(Faults&, double value)>>;

/// "boom-stroke:frozen", "boom-stroke:drift" (m/s), "boom-stroke:step" (m), ...
[[nodiscard]] const PlantFaultTable<plant::ExcavatorFaults>& excavator_plant_faults();
[[nodiscard]] const PlantFaultTable<plant::DozerFaults>& dozer_plant_faults();

/// A fault as it was told: NAME@SECONDS or NAME=VALUE@SECONDS.
struct ToldFault {
  std::string name;
  double value = 0.0;
  TimeUs at_us = 0;  ///< Simulated, from the start.
};

/// Throws std::runtime_error, with the form, for a text that is none.
[[nodiscard]] ToldFault told_fault(const std::string& text);

/// Faults in the order of their times. They stay once they are there.
template <class Faults>
class PlantFaultSchedule {
 public:
  /// Throws std::runtime_error, with the names that there are, for one that `table` does not have.
  PlantFaultSchedule(const PlantFaultTable<Faults>& table, const std::vector<std::string>& told);

  /// Sets all that have come since the last call. Each is said on the bus by an 11-bit frame 7F0,
  /// whose one byte is its place among those that were told, from 1: a log then has its time.
  void apply(TimeUs now_us, Faults& faults, CanPort& port);
  /// Those that have not come yet, each as it was told.
  [[nodiscard]] std::vector<std::string> left() const;

 private:
  struct Planned {
    ToldFault fault;
    std::uint8_t place = 0;
    std::string text;  ///< As it was told.
  };
  const PlantFaultTable<Faults>& table_;
  std::vector<Planned> left_;
};

/// For a report's subtitle: " | fault boom-stroke:step=0.4@1.0"; empty where none was told.
[[nodiscard]] std::string told_faults_subtitle(const std::vector<std::string>& told);

/// After a run: a line for the terminal where faults came and the controller saw none of them,
/// empty else. Throws std::runtime_error where one was told for later than the run's end.
[[nodiscard]] std::string told_faults_text(const std::vector<std::string>& told,
                                           const std::vector<std::string>& left, double run_s,
                                           bool is_seen);

extern template class PlantFaultSchedule<plant::ExcavatorFaults>;
extern template class PlantFaultSchedule<plant::DozerFaults>;

}  // namespace graben::runs
