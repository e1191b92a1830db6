// SPDX-License-Identifier: Apache-2.0
/// What a page is told of a log, and what is no log.

#include "app/scope/server/show.hpp"

#include <unistd.h>
#include <zlib.h>

#include <array>
#include <string>

#include "app/machines/missing_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"
#include "tests/unit/scope/temporary_file.hpp"

using scope::LogShow;
using test::TemporaryFile;

constexpr int kBitrate = 500000;
LogShow show_of(const std::filesystem::path& file) {
  return LogShow(file, kBitrate, {{"machines", "theirs"}});
}

TEST(the_file_is_what_pages_get) {
  const TemporaryFile file("(0000000001.000000) can0 123#\n");
  const LogShow show = show_of(file.path());
  assert_int_equal(show.log()->bytes, 30);
  std::string chunk;
  assert_false(show.open()->next(chunk));
  assert_true(chunk.empty());
}

TEST(setup_says_what_it_is) {
  const TemporaryFile file("x\n");
  const LogShow show = show_of(file.path());
  const nlohmann::json setup = nlohmann::json::parse(show.setup());
  assert_string_equal(setup["kind"].get<std::string>().c_str(), "setup");
  assert_string_equal(setup["machines"].get<std::string>().c_str(), "theirs");
  assert_string_equal(setup["source"]["mode"].get<std::string>().c_str(), "log");
  assert_int_equal(setup["source"]["bytes"].get<int>(), 2);
  assert_string_equal(setup["source"]["get"].get<std::string>().c_str(), "/log");
  assert_int_equal(setup["source"]["bitrate"].get<int>(), kBitrate);
  assert_string_equal(setup["source"]["name"].get<std::string>().c_str(),
                      file.path().filename().c_str());
}

void assert_refused(const std::filesystem::path& file, const char* why) {
  const std::string said = test::refusal_of([&] { return show_of(file); });
  assert_string_equal(said.c_str(), (file.string() + ": " + why).c_str());
}

TEST(a_packed_log_is_unpacked) {
  const std::string text(100000, '\n');
  const TemporaryFile file("");
  gzFile packed = gzopen(file.path().c_str(), "wb");
  assert_int_equal(gzwrite(packed, text.data(), static_cast<unsigned>(text.size())), 100000);
  assert_int_equal(gzclose(packed), Z_OK);
  {
    const LogShow show = show_of(file.path());
    assert_int_equal(show.log()->bytes, 100000);
    std::array<char, 3> end{};
    assert_int_equal(pread(show.log()->file, end.data(), end.size(), 99998), 2);
    assert_true(end[0] == '\n' && end[1] == '\n');
  }
  std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) - 9);
  assert_refused(file.path(), "is cut off or damaged (gzip)");
}

TEST(what_is_no_log_is_refused) {
  const TemporaryFile empty("");
  assert_refused("no_such_file.log",
                 (std::string("there is no such file; wanted: ") + machines::kWantedLog).c_str());
  assert_refused(std::filesystem::temp_directory_path(),
                 (std::string("is a folder; wanted: ") + machines::kWantedLog).c_str());
  assert_refused(empty.path(), "is empty");
  const std::string toml =
      std::string("reads like TOML, as a profile or a task; wanted: ") + machines::kWantedLog;
  for (const char* text :
       {"# A machine\nkind = \"excavator\"\n", "[[step]]\ndo = \"dig\"\n", "[boom]\n"}) {
    const TemporaryFile profile(text);
    assert_refused(profile.path(), toml.c_str());
  }
  assert_refused("/dev/null",
                 "is no regular file; what is sent through it can be written to one first");
}
