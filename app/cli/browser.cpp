// SPDX-License-Identifier: Apache-2.0
#include "app/cli/browser.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "app/cli/program.hpp"

namespace graben::cli {
namespace {

using nlohmann::json;

// The descriptors that --remote-debugging-pipe takes; messages end with a zero.
constexpr int kTo = 3;
constexpr int kFrom = 4;
constexpr double kPatience_s = 60.0;
constexpr int kQuality = 92;

std::vector<std::string> browser_words(const std::filesystem::path& folder) {
  std::vector<std::string> words = {
      browser_program(), "--headless=new", "--remote-debugging-pipe", "--no-first-run",
      "--hide-scrollbars", "--mute-audio", "--force-color-profile=srgb",
      // WebGL by the processor, where there is no graphics card.
      "--enable-unsafe-swiftshader", "--user-data-dir=" + folder.string()};
  if (geteuid() == 0) {
    words.emplace_back("--no-sandbox");  // Which root does not have.
  }
  words.emplace_back("about:blank");
  return words;
}

std::string from_base64(const std::string& text) {
  std::string bytes(text.size() / 4 * 3, '\0');
  const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                   reinterpret_cast<const unsigned char*>(text.data()),
                                   static_cast<int>(text.size()));
  if (size < 0) {
    throw std::runtime_error("the browser's picture is none");
  }
  const auto padding = static_cast<std::size_t>(
      std::count(text.end() - std::min<long>(2, static_cast<long>(text.size())), text.end(), '='));
  bytes.resize(static_cast<std::size_t>(size) - padding);
  return bytes;
}

}  // namespace

std::string browser_program() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (const std::string path = program_path(name); !path.empty()) {
      return path;
    }
  }
  assert_program("chromium", "chromium");
  return "";
}

Browser::Browser(const std::filesystem::path& folder, int width, int height)
    : process_(browser_words(folder),
               {{kTo, ChildProcess::Way::kChildReads}, {kFrom, ChildProcess::Way::kChildWrites}},
               (folder / "browser.txt").string()) {
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                 .at("sessionId");
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  // Nothing moves but what is told to.
  call("Emulation.setEmulatedMedia",
       {{"features", {{{"name", "prefers-reduced-motion"}, {"value", "reduce"}}}}});
}

void Browser::open(const std::string& url) { call("Page.navigate", {{"url", url}}); }

json Browser::evaluate(const std::string& expression) {
  const json answer =
      call("Runtime.evaluate",
           {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (answer.contains("exceptionDetails")) {
    throw std::runtime_error(
        fmt::format("the page: {}", answer.at("exceptionDetails").value("text", "an error")));
  }
  return answer.at("result").value("value", json());
}

std::string Browser::picture() {
  return from_base64(
      call("Page.captureScreenshot", {{"format", "jpeg"}, {"quality", kQuality}}).at("data"));
}

json Browser::call(const std::string& method, const json& parameters) {
  json order = {{"id", ++calls_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) {
    order["sessionId"] = session_;
  }
  process_.write(kTo, order.dump() + '\0');
  for (;;) {
    const json answer = json::parse(process_.read_until(kFrom, '\0', kPatience_s), nullptr, false);
    // All else are events, of which none is asked for.
    if (answer.is_object() && answer.value("id", 0) == calls_) {
      if (answer.contains("error")) {
        throw std::runtime_error(fmt::format("the browser: {}: {}", method,
                                             answer.at("error").value("message", "an error")));
      }
      return answer.at("result");
    }
  }
}

}  // namespace graben::cli
