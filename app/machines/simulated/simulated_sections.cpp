// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/simulated_sections.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/machines/missing_file.hpp"

namespace graben::machines {

ProfileDocument read_simulation(const std::filesystem::path& file) {
  const std::filesystem::path simulation = simulation_file(file);
  if (!std::filesystem::is_regular_file(simulation)) {
    throw std::runtime_error(unread_text(
        simulation, fmt::format("masses, oil, friction, soil and experiments of the machine of {}, "
                                "for whatever simulates it; --simulated NAME takes another "
                                "machine's",
                                file.string())));
  }
  return read_document(simulation);
}

ValveOfPlant read_valve_of_plant(TomlReader& reader, const std::string& valve) {
  return {reader.number(valve + ".time_constant", {0.001, 1.0, "s"},
                        "spool: 1 / natural frequency of its second-order lag"),
          reader.number(valve + ".damping", {0.1, 10.0, ""}, "damping ratio of that lag"),
          reader.number(valve + ".deadband", {0.0, 0.9, ""},
                        "spool's deadband, of its travel, each side"),
          reader.number(valve + ".bulk_modulus", {1e8, 1e11, "Pa"}, "oil with its hoses")};
}

Interval read_interval(TomlReader& reader, const std::string& key, const Range& range,
                       const char* help) {
  const std::vector<double> ends = reader.numbers(key, range, 2, help);
  if (reader.is_sound() && ends[0] > ends[1]) {
    reader.fail(
        key, fmt::format("{} comes before {}; allowed: the smaller one first", ends[0], ends[1]));
  }
  return {ends[0], ends[1]};
}

}  // namespace graben::machines
