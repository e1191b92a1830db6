/// A log in chunks: all of it, at line ends, once for each page; and what is no log.

#include "app/scope/log_show.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/scope/temporary_file.hpp"

namespace {

using namespace graben;
using scope::ClientStream;
using scope::LogShow;
using test::TemporaryFile;

constexpr int kBitrate = 500000;
constexpr std::size_t kChunk = ClientStream::kMessageMostBytes;

std::string lines(std::size_t least_bytes) {
  std::string text;
  for (int i = 0; text.size() < least_bytes; ++i) {
    text += "(0000000001." + std::to_string(100000 + i % 900000) + ") can0 18FF2080#00112233\n";
  }
  return text;
}

LogShow show_of(const std::filesystem::path& file) {
  return LogShow(file, kBitrate, {{"machines", "theirs"}});
}

/// All that a page gets, and in how many chunks.
std::string read_all(ClientStream& stream, int& chunks) {
  std::string all;
  std::string chunk;
  for (chunks = 0; stream.next(chunk); ++chunks) {
    assert_true(chunk.size() <= kChunk);
    all += chunk;
    chunk.clear();
  }
  assert_true(chunk.empty());
  return all;
}

void all_of_it_at_line_ends(void**) {
  const std::string text = lines(3 * kChunk + kChunk / 2);
  const TemporaryFile file(text);
  const LogShow show = show_of(file.path());
  const auto stream = show.open();
  std::string chunk;
  assert_true(stream->next(chunk));
  assert_int_equal(chunk.back(), '\n');
  assert_true(chunk.size() > kChunk - 100);
  assert_false(stream->ended());
  int chunks = 0;
  const std::string all = chunk + read_all(*stream, chunks);
  assert_int_equal(chunks, 3);
  assert_true(all == text);
  assert_true(stream->ended());
  assert_int_equal(stream->lost(), 0);
}

void each_page_has_its_own_place(void**) {
  const TemporaryFile file(lines(2 * kChunk));
  const LogShow show = show_of(file.path());
  const auto first = show.open();
  const auto second = show.open();
  int chunks = 0;
  const std::string all = read_all(*first, chunks);
  assert_true(read_all(*second, chunks) == all);
}

void appends_behind_what_is_there(void**) {
  const TemporaryFile file("(0000000001.000000) can0 123#\n");
  const LogShow show = show_of(file.path());
  std::string message = "before";
  assert_true(show.open()->next(message));
  assert_string_equal(message.c_str(), "before(0000000001.000000) can0 123#\n");
}

void a_last_line_without_an_end_is_sent(void**) {
  const std::string text = lines(kChunk + 1000) + "(0000000009.00";
  const TemporaryFile file(text);
  const LogShow show = show_of(file.path());
  const auto stream = show.open();
  int chunks = 0;
  assert_true(read_all(*stream, chunks) == text);
}

void what_has_no_lines_is_sent_all_the_same(void**) {
  const std::string text(2 * kChunk + 17, '\xFF');
  const TemporaryFile file(text);
  const LogShow show = show_of(file.path());
  const auto stream = show.open();
  int chunks = 0;
  assert_true(read_all(*stream, chunks) == text);
  assert_int_equal(chunks, 3);
}

void a_log_that_becomes_shorter_ends(void**) {
  const TemporaryFile file(lines(3 * kChunk));
  const LogShow show = show_of(file.path());
  const auto stream = show.open();
  std::string chunk;
  assert_true(stream->next(chunk));
  const std::size_t first = chunk.size();
  file.write(lines(first + 500).substr(0, first + 500));
  chunk.clear();
  assert_true(stream->next(chunk));
  assert_int_equal(chunk.size(), 500);
  chunk.clear();
  assert_false(stream->next(chunk));
  assert_true(stream->ended());
}

void setup_says_what_it_is(void**) {
  const TemporaryFile file("x\n");
  const LogShow show = show_of(file.path());
  const nlohmann::json setup = nlohmann::json::parse(show.setup());
  assert_string_equal(setup["kind"].get<std::string>().c_str(), "setup");
  assert_string_equal(setup["machines"].get<std::string>().c_str(), "theirs");
  assert_string_equal(setup["source"]["mode"].get<std::string>().c_str(), "log");
  assert_int_equal(setup["source"]["bytes"].get<int>(), 2);
  assert_int_equal(setup["source"]["bitrate"].get<int>(), kBitrate);
  assert_string_equal(setup["source"]["name"].get<std::string>().c_str(),
                      file.path().filename().c_str());
}

void assert_refused(const std::filesystem::path& file, const char* why) {
  std::string error;
  try {
    static_cast<void>(show_of(file));
  } catch (const std::runtime_error& refusal) {
    error = refusal.what();
  }
  assert_string_equal(error.c_str(), (file.string() + ": " + why).c_str());
}

void what_is_no_log_is_refused(void**) {
  const TemporaryFile empty("");
  assert_refused("no_such_file.log", "No such file or directory");
  assert_refused(std::filesystem::temp_directory_path(), "is a folder, not a log");
  assert_refused(empty.path(), "is empty");
  assert_refused("/dev/null",
                 "is no regular file; what is sent through it can be written to one first");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(all_of_it_at_line_ends),
      cmocka_unit_test(each_page_has_its_own_place),
      cmocka_unit_test(appends_behind_what_is_there),
      cmocka_unit_test(a_last_line_without_an_end_is_sent),
      cmocka_unit_test(what_has_no_lines_is_sent_all_the_same),
      cmocka_unit_test(a_log_that_becomes_shorter_ends),
      cmocka_unit_test(setup_says_what_it_is),
      cmocka_unit_test(what_is_no_log_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
