// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Chromium without a window, told by the pipe of its DevTools protocol what to show.

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/child_process.hpp"

namespace graben::cli {

/// Name of the browser that is here; throws std::runtime_error where there is none.
[[nodiscard]] std::string browser_program();

class Browser {
 public:
  /// A page of so many pixels. `folder` takes what the browser writes for itself.
  Browser(const std::filesystem::path& folder, int width, int height);

  void open(const std::string& url);

  /// What an expression of the page's JavaScript is, once it is no promise. Throws
  /// std::runtime_error where it throws, or after a minute without an answer.
  nlohmann::json evaluate(const std::string& expression);

  /// The page as JPEG.
  std::string picture();

 private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters);

  ChildProcess process_;
  std::string session_;
  int calls_ = 0;
};

}  // namespace graben::cli
