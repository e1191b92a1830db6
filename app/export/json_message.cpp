// SPDX-License-Identifier: Apache-2.0
#include "app/export/json_message.hpp"

#include <cctype>
#include <map>
#include <nlohmann/json.hpp>

namespace graben::app_export {

std::string signal_name(std::string_view name, std::string_view unit) {
  static const std::map<std::string_view, const char*> units = {
      {"rad/s", "radps"}, {"m/s", "mps"}, {"m/s^2", "mps2"}, {"m^3/s", "m3ps"}};
  if (unit.empty()) {
    return std::string(name);
  }
  const auto known = units.find(unit);
  return fmt::format("{}_{}", name, known == units.end() ? unit : known->second);
}

std::string json_text(std::string_view text) { return nlohmann::json(text).dump(); }

std::string number_schema(std::string_view name, std::string_view unit) {
  return fmt::format(R"({}:{{"type":"number","description":"{}"}})",
                     json_text(signal_name(name, unit)), unit.empty() ? "no unit" : unit);
}

std::string object_schema(std::string_view title, const std::string& properties) {
  return fmt::format(R"({{"type":"object","title":{},"properties":{{{}}}}})", json_text(title),
                     properties);
}

std::string topic_of(std::string_view sender, std::string_view message) {
  std::string folder(sender);
  folder[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(folder[0])));
  return fmt::format("/{}/{}", folder, message);
}

}  // namespace graben::app_export
