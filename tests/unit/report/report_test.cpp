// SPDX-License-Identifier: Apache-2.0
// The report's file: complete, self-contained, safe against its own data, and never half written.

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/reports/report_file.hpp"
#include "app/scope/page/scope_page.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace fs = std::filesystem;
using graben::reports::packed;
using graben::reports::packed_file;
using nlohmann::json;

void write_report(const fs::path& file, const json& setup) {
  graben::reports::write_report(file, graben::scope::scope_page(), setup);
}

const fs::path& folder() {
  static const fs::path path =
      fs::temp_directory_path() / ("graben_report_test." + std::to_string(getpid()));
  return path;
}

int make_folder(void**) { return fs::create_directory(folder()) ? 0 : -1; }
int remove_folder(void**) { return fs::remove_all(folder()) > 0 ? 0 : -1; }

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::size_t files_in(const fs::path& path) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

/// The data as a browser would see it: what is between the data element's tags.
json embedded(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"graben-setup\">";
  const auto from = page.find(open) + open.size();
  return json::parse(page.substr(from, page.find("</script", from) - from));
}

/// What write_report says when it refuses.
std::string refusal(const fs::path& file) {
  try {
    write_report(file, json::object());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

const json& sample() {
  static const json data = {
      {"title", "A run"},
      {"subtitle", "seed 7"},
      {"series", {{"time_s", {0.0, 0.01, 0.02}}, {"lambda", {1.0, 0.5, 0.25}}}}};
  return data;
}

TEST(holds_page_and_data) {
  const fs::path file = folder() / "whole.html";
  write_report(file, sample());
  const std::string page = content(file);
  assert_true(contains(page, ".u-legend"));  // uPlot's style
  assert_true(contains(page, "WebGLRenderer"));
  assert_true(contains(page, "BO_ 2365530240 BoomStroke"));   // the DBC of one kind
  assert_true(contains(page, "BO_ 2365542528 BladeStroke"));  // and of the other
  assert_true(embedded(page) == sample());
  assert_int_equal(page.find_last_not_of('\n'), page.rfind("</html>") + 6);
}

TEST(refers_to_nothing_outside) {
  const fs::path file = folder() / "alone.html";
  write_report(file, sample());
  const std::string page = content(file);
  // Line by line: a library is one very long line, and std::regex is recursive. The patterns have
  // no unbounded part but white space.
  const std::vector<std::string> patterns = {
      R"(<(iframe|object|embed|base)\b)",
      R"(<link[^>]{0,99}href=["']?(https?:|/))",
      R"(<script[ ]+(type="module"[ ]+)?(crossorigin[ ]+)?src)",
      R"(url\(\s*["']?\s*(https?:|//))",
      R"(@import)",
  };
  for (const std::string& pattern : patterns) {
    const std::regex expression(pattern, std::regex::icase);
    if (std::regex_search(page, expression)) fail_msg("the page matches %s", pattern.c_str());
  }
  // What the browser lets no script get around.
  assert_true(contains(page, "default-src 'none'"));
  assert_false(contains(page.substr(0, page.find("<script")), "://"));
}

TEST(title_cannot_break_out) {
  const fs::path file = folder() / "escape.html";
  write_report(file, sample());
  const std::string harmless = content(file);

  json data = sample();
  data["title"] = "</script><script>alert(1)</script>";
  data["subtitle"] = "<!-- <script> \\ \" & \u2028";
  write_report(file, data);
  const std::string page = content(file);
  for (const char* tag : {"<script", "</script", "<!--"}) {
    assert_int_equal(count(page, tag), count(harmless, tag));
  }
  assert_true(embedded(page) == data);
}

TEST(unreadable_values_become_gaps) {
  const fs::path file = folder() / "gaps.html";
  json data = sample();
  data["series"]["lambda"][1] = std::numeric_limits<double>::quiet_NaN();
  data["subtitle"] = "not UTF-8: \xff";
  write_report(file, data);
  const json read = embedded(content(file));
  assert_true(read["series"]["lambda"][1].is_null());
  assert_true(contains(read["subtitle"].get<std::string>(), "not UTF-8"));
}

TEST(replaces_an_old_report) {
  const fs::path own = folder() / "replace";
  fs::create_directory(own);
  put(own / "r.html", "old");
  fs::create_symlink("r.html", own / "latest.html");
  write_report(own / "latest.html", sample());
  assert_true(fs::is_symlink(own / "latest.html"));
  assert_true(embedded(content(own / "r.html")) == sample());
  assert_int_equal(files_in(own), 2);  // nothing temporary is left
}

TEST(unwritable_target_is_named) {
  const fs::path missing = folder() / "no_such_folder" / "r.html";
  assert_true(contains(refusal(missing), missing.string()));

  const fs::path blocked = folder() / "a_file";
  put(blocked, "old");
  assert_true(contains(refusal(blocked / "r.html"), (blocked / "r.html").string()));
  assert_string_equal(content(blocked).c_str(), "old");

  const fs::path directory = folder() / "a_folder";
  fs::create_directory(directory);
  assert_true(contains(refusal(directory), directory.string()));
  assert_true(fs::is_directory(directory));

  // Stands for every special file; one of our own, so that a mistake here costs nothing.
  const fs::path pipe = folder() / "a_pipe";
  assert_int_equal(mkfifo(pipe.c_str(), 0600), 0);
  assert_true(contains(refusal(pipe), pipe.string()));
  assert_true(fs::is_fifo(pipe));
}

/// gzip's header and what `printf 'abc' | gzip` has as its length and CRC at the end.
TEST(packs_as_gzip) {
  const std::string text = packed("abc");
  assert_int_equal(text.size() % 4, 0);
  assert_string_equal(text.substr(0, 4).c_str(), "H4sI");
  assert_string_equal(packed("").substr(0, 4).c_str(), "H4sI");
  assert_true(packed(std::string(1U << 20U, 'x')).size() < 4000);
  const fs::path file = folder() / "a.log";
  put(file, "abc");
  assert_string_equal(packed_file(file).c_str(), text.c_str());
}

TEST(missing_log_is_named) {
  const fs::path missing = folder() / "no_such.log";
  try {
    static_cast<void>(packed_file(missing));
    fail_msg("no refusal");
  } catch (const std::runtime_error& error) {
    assert_true(contains(error.what(), missing.string()));
  }
}

/// A full disk, as near as a test gets: files may not grow beyond 1 kB.
TEST(failed_write_leaves_old_report) {
  const fs::path own = folder() / "full";
  fs::create_directory(own);
  const fs::path file = own / "r.html";
  put(file, "old");

  rlimit before{};
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit tight = before;
  tight.rlim_cur = 1024;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
  const std::string message = refusal(file);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);

  assert_true(contains(message, file.string()));
  assert_string_equal(content(file).c_str(), "old");
  assert_int_equal(files_in(own), 1);
}

TESTS_WITHIN(make_folder, remove_folder)
