#include "app/machines/simulated/simulated_sections.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace graben::machines {

ProfileDocument read_simulation(const std::filesystem::path& file) {
  const std::filesystem::path simulation = simulation_file(file);
  if (!std::filesystem::is_regular_file(simulation)) {
    throw std::runtime_error(
        fmt::format("{}: not found; whatever simulates the machine of {} needs its masses, oil, "
                    "friction, soil and experiments from there",
                    simulation.string(), file.string()));
  }
  return read_document(simulation);
}

}  // namespace graben::machines
