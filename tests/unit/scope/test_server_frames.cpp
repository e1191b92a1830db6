// SPDX-License-Identifier: Apache-2.0
/// The server over real sockets: what two pages get, what becomes of what they say, and that one
/// that does not read costs the others nothing.

#include <unistd.h>

#include "app/scope/server/show.hpp"
#include "tests/unit/scope/server_rig.hpp"
#include "tests/unit/scope/temporary_file.hpp"

using nlohmann::json;
using test::Milliseconds;
using test::Opcode;
using test::ScriptRig;
using test::ServedShow;
using test::WsClient;
using test::WsMessage;

/// The page's first message, and every later one that is of this kind.
json read_kind(WsClient& client, const std::string& kind) {
  for (int i = 0; i < 20000; ++i) {
    const std::optional<WsMessage> message = client.read();
    assert_true(message.has_value());
    if (message->opcode == Opcode::kText) {
      const json content = json::parse(message->content);
      if (content["kind"] == kind) {
        return content;
      }
    }
  }
  print_error("no message '%s'\n", kind.c_str());
  _fail(__FILE__, __LINE__);
  return {};
}

/// Lines as they come; those that were lost are told in `dropped`.
struct Lines {
  std::string text;
  std::uint64_t dropped = 0;
};

/// So long, and until so many bytes are there, which a busy machine takes longer for.
void read_lines(WsClient& client, Milliseconds during, Lines& lines, std::size_t least_bytes = 0) {
  const auto begin = std::chrono::steady_clock::now();
  const auto is_going = [&] {
    const auto passed = std::chrono::steady_clock::now() - begin;
    return passed < during || (lines.text.size() < least_bytes && passed < 30 * during);
  };
  while (is_going()) {
    const std::optional<WsMessage> message = client.read(Milliseconds(200));
    if (message && message->opcode == Opcode::kBinary) {
      lines.text += message->content;
    } else if (message && message->opcode == Opcode::kText) {
      const json content = json::parse(message->content);
      lines.dropped =
          content["kind"] == "dropped" ? content["frames"].get<std::uint64_t>() : lines.dropped;
    }
  }
}

std::uint32_t number_of(const std::string& line) {
  return static_cast<std::uint32_t>(std::stoul(line.substr(line.find('#') + 1), nullptr, 16));
}

/// Frames that the numbers have left out between the first line and the last.
std::uint64_t left_out(const std::string& text) {
  std::stringstream stream(text);
  std::uint64_t left = 0;
  std::optional<std::uint32_t> before;
  for (std::string line; std::getline(stream, line);) {
    const std::uint32_t number = number_of(line);
    assert_true(!before || number > *before);
    left += before ? number - *before - 1 : 0;
    before = number;
  }
  return left;
}

std::size_t bytes_before_gap(const std::string& text) {
  std::size_t at = text.find('\n') + 1;
  for (std::uint32_t before = number_of(text); at < text.size(); ++before) {
    const std::size_t end = text.find('\n', at);
    if (number_of(text.substr(at, end - at)) != before + 1) {
      return at;
    }
    at = end + 1;
  }
  return at;
}

TEST(setup_and_state_come_first) {
  ScriptRig rig(1);
  WsClient client(rig.port());
  assert_true(client.open());
  const std::optional<WsMessage> first = client.read();
  assert_true(first && first->opcode == Opcode::kText);
  const json setup = json::parse(first->content);
  assert_true(setup["kind"] == "setup");
  assert_true(setup["source"]["name"] == "script");
  const std::optional<WsMessage> second = client.read();
  assert_true(second && json::parse(second->content)["kind"] == "sim");
}

TEST(two_pages_get_the_same_bytes) {
  ScriptRig rig(20);
  WsClient first(rig.port());
  WsClient second(rig.port());
  assert_true(first.open());
  assert_true(second.open());
  Lines one;
  Lines two;
  std::thread other([&] { read_lines(second, Milliseconds(1000), two, 120000); });
  read_lines(first, Milliseconds(1000), one, 120000);
  other.join();
  assert_true(left_out(one.text) == 0 && left_out(two.text) == 0);
  // They began and ended at different moments; between them every byte is the same.
  const std::size_t shift = two.text.find(one.text.substr(0, one.text.find('\n')));
  const std::string& later = shift == std::string::npos ? two.text : one.text;
  const std::string& earlier = shift == std::string::npos ? one.text : two.text;
  const std::size_t from = earlier.find(later.substr(0, later.find('\n')));
  assert_true(from != std::string::npos);
  const std::size_t common = std::min(earlier.size() - from, later.size());
  assert_true(common > 50000);
  assert_true(earlier.compare(from, common, later, 0, common) == 0);
}

long resident_bytes() {
  long pages = 0;
  std::ifstream statm("/proc/self/statm");
  statm >> pages >> pages;
  return pages * sysconf(_SC_PAGESIZE);
}

/// What the sanitizer keeps of what was freed is not what the server keeps.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsCounted = false;
#elif defined(__has_feature)
constexpr bool kMemoryIsCounted = !__has_feature(address_sanitizer);
#else
constexpr bool kMemoryIsCounted = true;
#endif

/// 800 frames in 4 ms are 8 MB/s, eighty times a full bus: the one that does not read has its
/// buffers full at once.
TEST(one_that_does_not_read_loses_frames_and_is_told) {
  constexpr long kServerMost_bytes = 8 * 1024 * 1024;
  ScriptRig rig(800);
  WsClient stuck(rig.port(), 4096);
  WsClient good(rig.port());
  assert_true(stuck.open());
  assert_true(good.open());
  static_cast<void>(read_kind(stuck, "setup"));
  Lines read;
  read_lines(good, Milliseconds(1500), read);
  const long before_bytes = resident_bytes();
  read.text.reserve(128 * 1024 * 1024);
  read_lines(good, Milliseconds(3000), read);
  assert_int_equal(left_out(read.text), 0);
  assert_int_equal(read.dropped, 0);
  // What this test has read itself is in it, and the same once more for pages that come later; what
  // would have waited would be, too.
  const long grown_bytes =
      resident_bytes() - before_bytes - 2 * static_cast<long>(read.text.size());
  assert_true(!kMemoryIsCounted || grown_bytes < kServerMost_bytes);
  rig.source().set_frames_per_block(1);
  Lines late;
  read_lines(stuck, Milliseconds(2500), late);
  assert_true(late.dropped > 10000);
  assert_int_equal(left_out(late.text), late.dropped);
  // Nor did so much wait for it that it would be shown what was long ago.
  assert_true(bytes_before_gap(late.text) < 1000000);
}

TEST(wishes_are_done_or_refused) {
  ScriptRig rig(1);
  WsClient asks(rig.port());
  WsClient watches(rig.port());
  assert_true(asks.open());
  assert_true(watches.open());
  assert_int_equal(read_kind(watches, "sim")["revision"].get<int>(), 1);
  assert_true(asks.send(Opcode::kText, R"({"do":"stop"})"));
  // Everybody sees the state that one has changed.
  assert_int_equal(read_kind(watches, "sim")["revision"].get<int>(), 2);
  for (const auto& [wish, why] :
       {std::pair<const char*, const char*>{R"({"do":"fly"})", "only stop is known"},
        {"{", "this is not JSON"},
        {R"({"do":[1]})", "only stop is known"},
        {"{}", "a value is missing"}}) {
    assert_true(asks.send(Opcode::kText, wish));
    assert_string_equal(read_kind(asks, "refused")["why"].get<std::string>().c_str(), why);
  }
}

/// What it grows by is not shown; what it has lost can't be: that connection ends, others go on.
TEST(a_log_that_changes_while_it_is_shown) {
  const std::string text(4U << 20U, 'x');
  const test::TemporaryFile file(text);
  scope::LogShow show(file.path(), 500000, json::object());
  ServedShow served(show);
  const std::string ask =
      "GET /log HTTP/1.1\r\nHost: " + test::own_host(served.port()) + "\r\n\r\n";
  file.write(text + "more");
  test::TcpPeer peer(served.port());
  assert_true(peer.send(ask));
  std::string whole;
  std::size_t all = text.size();
  for (std::string more = "-"; !more.empty() && whole.size() < all;) {
    more = peer.receive(test::Milliseconds(5000));
    whole += more;
    all = whole.find("\r\n\r\n") + 4 + text.size();
  }
  assert_true(whole.substr(whole.find("\r\n\r\n") + 4) == text);
  assert_true(peer.receive(test::Milliseconds(200)).empty());
  file.write("short");
  const std::string cut = test::ask(served.port(), ask);
  assert_true(cut.size() < 1000);
  test::assert_begins(test::ask(served.port(), "GET /x HTTP/1.1\r\nHost: " +
                                                   test::own_host(served.port()) + "\r\n\r\n"),
                      "HTTP/1.1 404");
}

TEST(a_log_is_a_file_and_takes_no_wishes) {
  std::string text;
  for (int i = 0; i < 100000; ++i) {
    text += "(0000000001.000000) can0 18FF2080#" + std::to_string(10000000 + i) + "\n";
  }
  const test::TemporaryFile file(text);
  scope::LogShow show(file.path(), 500000, json::object());
  ServedShow served(show);
  const auto get = [&](const std::string& host) {
    return test::ask(served.port(), "GET /log HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  };
  const std::string answer = get(test::own_host(served.port()));
  test::assert_begins(answer, "HTTP/1.1 200 OK\r\n");
  test::assert_has(answer.substr(0, 1000), "x-content-type-options: nosniff\r\n");
  assert_true(answer.substr(answer.find("\r\n\r\n") + 4) == text);
  test::assert_begins(get("evil.example"), "HTTP/1.1 403");
  const std::string own = test::own_host(served.port());
  test::assert_begins(get(own + "\r\nOrigin: http://evil.example"), "HTTP/1.1 403");
  WsClient client(served.port());
  assert_true(client.open());
  assert_true(client.send(Opcode::kText, R"({"do":"stop"})"));
  assert_string_equal(read_kind(client, "refused")["why"].get<std::string>().c_str(),
                      "this is a log: it can only be looked at");
}

/// Status of a close that the server sends, within two seconds; 0: none.
int closed_with(WsClient& client) {
  for (int i = 0; i < 10000; ++i) {
    const std::optional<WsMessage> message = client.read();
    if (!message) {
      return 0;
    }
    if (message->opcode == Opcode::kClose && message->content.size() >= 2) {
      return static_cast<unsigned char>(message->content[0]) * 256 +
             static_cast<unsigned char>(message->content[1]);
    }
  }
  return 0;
}

/// Nothing follows a close, however much there would be to send.
void assert_nothing_more(WsClient& client) {
  while (const std::optional<WsMessage> message = client.read(Milliseconds(100))) {
    assert_int_not_equal(message->opcode, Opcode::kText);
    assert_int_not_equal(message->opcode, Opcode::kBinary);
  }
}

TEST(what_is_no_message_closes_the_connection) {
  ScriptRig rig(1);
  const auto assert_closed = [&](int status, Opcode opcode, const std::string& content) {
    WsClient client(rig.port());
    assert_true(client.open());
    assert_true(client.send(opcode, content));
    assert_int_equal(closed_with(client), status);
    // What is no text the library refuses by itself, and tells nobody.
    if (status != 1007) {
      assert_nothing_more(client);
    }
  };
  assert_closed(1003, Opcode::kBinary, "x");
  assert_closed(1009, Opcode::kText, std::string(4097, ' '));
  assert_closed(1009, Opcode::kText, std::string(1000000, ' '));
  assert_closed(1007, Opcode::kText, "\xC3\x28");
  assert_closed(1000, Opcode::kClose, "\x03\xE8");
}

/// The operator's view gets all that others get, and whatever it says reaches nobody.
TEST(who_only_looks_is_not_heard) {
  ScriptRig rig(20);
  const std::string host = test::own_host(rig.port());
  const std::string request = test::ws_request(host, "", "/frames", "graben-look");
  WsClient quiet(rig.port());
  assert_true(quiet.ask(request).rfind("HTTP/1.1 101", 0) == 0);
  assert_true(read_kind(quiet, "setup")["source"]["name"] == "script");
  Lines lines;
  read_lines(quiet, Milliseconds(300), lines);
  assert_true(lines.text.size() > 5000);
  const auto assert_refused = [&](Opcode opcode, const std::string& content) {
    WsClient client(rig.port());
    assert_true(client.ask(request).rfind("HTTP/1.1 101", 0) == 0);
    assert_true(client.send(opcode, content));
    assert_int_equal(closed_with(client), 1008);
    assert_nothing_more(client);
  };
  assert_refused(Opcode::kText, R"({"do":"stop"})");
  assert_refused(Opcode::kText, "x");
  assert_refused(Opcode::kBinary, "x");
  assert_refused(Opcode::kText, std::string(100000, ' '));
  assert_int_equal(rig.source().wishes(), 0);
  // The same word of a page that may speak does get there.
  WsClient speaker(rig.port());
  assert_true(speaker.open());
  assert_true(speaker.send(Opcode::kText, R"({"do":"stop"})"));
  for (int i = 0; i < 200 && rig.source().wishes() == 0; ++i) {
    std::this_thread::sleep_for(Milliseconds(10));
  }
  assert_int_equal(rig.source().wishes(), 1);
}

TEST(a_flood_is_read_slowly_and_costs_the_others_nothing) {
  ScriptRig rig(20);
  WsClient flood(rig.port());
  WsClient good(rig.port());
  assert_true(flood.open());
  assert_true(good.open());
  std::string many;
  for (int i = 0; i < 1000; ++i) {
    many += test::ws_frame(Opcode::kText, R"({"do":"stop"})");
  }
  std::atomic<bool> done{false};
  const auto begin = std::chrono::steady_clock::now();
  std::thread flooding([&] {
    while (!done && flood.peer().send(many)) {
    }
  });
  Lines read;
  read_lines(good, Milliseconds(1000), read, 60000);
  assert_int_equal(left_out(read.text), 0);
  assert_true(read.text.size() > 50000);
  // A hundred a second, and a hundred at once in the beginning.
  std::uint64_t seen = 0;
  const int wishes = (*rig.source().state(seen))["revision"].get<int>() - 1;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  assert_in_range(wishes, 100, 150 + static_cast<int>(100.0 * passed.count()));
  done = true;
  flooding.join();
}

/// The fastest of many: the others may have waited for the processor.
TEST(it_stops_at_once_with_pages_open) {
  auto least = std::chrono::steady_clock::duration::max();
  for (int i = 0; i < 20 && least >= std::chrono::seconds(1); ++i) {
    auto rig = std::make_unique<ScriptRig>(20);
    WsClient client(rig->port());
    assert_true(client.open());
    const auto begin = std::chrono::steady_clock::now();
    rig.reset();
    least = std::min(least, std::chrono::steady_clock::now() - begin);
  }
  assert_true(least < std::chrono::seconds(1));
}
