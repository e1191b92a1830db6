#pragma once
/// Figures as a JSON file.

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace graben::reports {

/// Throws std::runtime_error that names the file.
inline void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& figures) {
  std::ofstream stream(file);
  stream << figures.dump(2) << '\n';
  stream.close();
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: can't be written", file.string()));
  }
}

}  // namespace graben::reports
