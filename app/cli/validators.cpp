#include "app/cli/validators.hpp"

#include <fmt/format.h>

#include <string>

namespace graben::cli {

CLI::Validator number_between(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0.0;
        const bool inside =
            CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return inside ? std::string()
                      : fmt::format("{} is not a number from {} to {}", text, least, most);
      },
      fmt::format("{} .. {}", least, most));
}

CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& text) {
        const bool digits = !text.empty() && text.size() <= 18 &&
                            text.find_first_not_of("0123456789") == std::string::npos;
        return digits ? std::string() : fmt::format("{} is not a whole number from 0", text);
      },
      "0 ..");
}

}  // namespace graben::cli
