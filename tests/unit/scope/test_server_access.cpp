// SPDX-License-Identifier: Apache-2.0
/// The server over real sockets: what it gives, and to whom.

#include "app/scope/server/show.hpp"
#include "tests/unit/refusal.hpp"
#include "tests/unit/scope/server_rig.hpp"
#include "tests/unit/scope/temporary_file.hpp"

using nlohmann::json;
using test::ask;
using test::assert_begins;
using test::assert_has;
using test::Milliseconds;
using test::own_host;
using test::ScriptRig;
using test::ServedShow;
using test::WsClient;

std::string get(int port, const std::string& path, const std::string& host) {
  return ask(port, "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
}

/// Longer than a socket takes at once.
std::string long_page() {
  std::string page = "<!doctype html>";
  for (int i = 0; i < 300000; ++i) {
    page += std::to_string(i) + "\n";
  }
  return page;
}

TEST(the_page_is_given_whole) {
  const test::TemporaryFile file("x\n");
  scope::LogShow show(file.path(), 500000, json::object());
  const std::string page = long_page();
  ServedShow served(show, page);
  for (const char* path : {"/", "/index.html"}) {
    const std::string answer = get(served.port(), path, own_host(served.port()));
    assert_begins(answer, "HTTP/1.1 200 OK\r\n");
    for (const char* header :
         {"content-type: text/html; charset=utf-8\r\n", "cache-control: no-store\r\n",
          "x-content-type-options: nosniff\r\n", "content-security-policy: default-src 'none'; "}) {
      assert_has(answer, header);
    }
    assert_true(answer.substr(answer.find("\r\n\r\n") + 4) == page);
  }
}

TEST(the_operators_view_is_another_page) {
  const test::TemporaryFile file("x\n");
  scope::LogShow show(file.path(), 500000, json::object());
  ServedShow served(show, "<!doctype html><title>scope</title>");
  const std::string own = own_host(served.port());
  const std::string answer = get(served.port(), "/operator", own);
  assert_begins(answer, "HTTP/1.1 200 OK\r\n");
  assert_has(answer, "content-security-policy: default-src 'none'; ");
  assert_true(answer.substr(answer.find("\r\n\r\n") + 4) == test::kOperatorsPage);
  assert_begins(get(served.port(), "/operator", "evil.example"), "HTTP/1.1 403");
  // A server that was given none has none.
  scope::ScopeServer without({"127.0.0.1", 0}, {"page"}, show);
  std::atomic<bool> stop{false};
  std::thread thread([&] { without.run([&] { return stop.load(); }); });
  const std::string none = get(without.port(), "/operator", own_host(without.port()));
  stop = true;
  thread.join();
  assert_begins(none, "HTTP/1.1 404");
}

TEST(nothing_else_is_there) {
  ScriptRig rig(1);
  const std::string host = own_host(rig.port());
  for (const char* path : {"/x", "/log", "/frames", "/index.htm", "/operator/", "/operators",
                           "/../etc/passwd", "/%2e%2e/etc"}) {
    assert_begins(get(rig.port(), path, host), "HTTP/1.1 404");
  }
  for (const char* method : {"POST", "PUT", "DELETE"}) {
    assert_begins(ask(rig.port(), std::string(method) + " / HTTP/1.1\r\nHost: " + host +
                                      "\r\nContent-Length: 0\r\n\r\n"),
                  "HTTP/1.1 405");
  }
}

TEST(foreign_names_get_nothing) {
  ScriptRig rig(1);
  const std::string port = ":" + std::to_string(rig.port());
  for (const std::string& host : {"evil.example" + port, std::string("localhost.evil.example")}) {
    assert_begins(get(rig.port(), "/", host), "HTTP/1.1 403");
    assert_has(WsClient(rig.port()).ask(test::ws_request(host, "Origin: http://" + host + "\r\n")),
               " 403 ");
  }
  assert_begins(ask(rig.port(), "GET / HTTP/1.1\r\n\r\n"), "HTTP/1.1 403");
  assert_begins(get(rig.port(), "/", "localhost" + port), "HTTP/1.1 200");
}

TEST(foreign_pages_get_no_frames) {
  ScriptRig rig(1);
  const std::string host = own_host(rig.port());
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1", "file://"}) {
    const std::string header = std::string("Origin: ") + origin + "\r\n";
    assert_has(WsClient(rig.port()).ask(test::ws_request(host, header)), " 403 ");
  }
  // What is no browser has no origin.
  assert_begins(WsClient(rig.port()).ask(test::ws_request(host)), "HTTP/1.1 101");
}

TEST(the_handshake_has_to_be_ours) {
  ScriptRig rig(1);
  const std::string host = own_host(rig.port());
  WsClient good(rig.port());
  assert_true(good.open());
  assert_has(WsClient(rig.port()).ask(test::ws_request(host, "", "/other")), " 404 ");
  for (const char* protocol : {"", "http", "chat", "http, graben-scope"}) {
    assert_has(WsClient(rig.port()).ask(test::ws_request(host, "", "/frames", protocol)), " 400 ");
  }
}

TEST(the_thirty_third_page_is_told_so) {
  ScriptRig rig(1);
  std::vector<std::unique_ptr<WsClient>> clients;
  for (std::size_t i = 0; i < scope::kClientsMost; ++i) {
    clients.push_back(std::make_unique<WsClient>(rig.port()));
    assert_true(clients.back()->open());
  }
  const std::string request = test::ws_request(own_host(rig.port()));
  assert_has(WsClient(rig.port()).ask(request), " 503 ");
  clients.pop_back();
  bool open = false;
  for (int i = 0; i < 100 && !open; ++i) {
    std::this_thread::sleep_for(Milliseconds(10));
    open = WsClient(rig.port()).ask(request).rfind("HTTP/1.1 101", 0) == 0;
  }
  assert_true(open);
}

TEST(a_port_in_use_is_said) {
  ScriptRig rig(1);
  const test::TemporaryFile file("x\n");
  scope::LogShow show(file.path(), 500000, json::object());
  const auto error_of = [&](const scope::ServerOptions& options) {
    return test::refusal_of([&] { return scope::ScopeServer(options, {"page"}, show); });
  };
  assert_has(error_of({"127.0.0.1", rig.port()}), "Address already in use");
  assert_has(error_of({"no.such.name.invalid", 0}), "--host 'no.such.name.invalid'");
  assert_has(error_of({"192.0.2.1", 0}), "192.0.2.1 port 0: Cannot assign requested address");
}

TEST(other_addresses_are_known_as_such) {
  const test::TemporaryFile file("x\n");
  scope::LogShow show(file.path(), 500000, json::object());
  const scope::ScopeServer everywhere({"0.0.0.0", 0}, {"page"}, show);
  assert_false(everywhere.is_loopback());
  const scope::ScopeServer named({"localhost", 0}, {"page"}, show);
  assert_true(named.is_loopback());
  assert_true(named.port() > 0);
  assert_has(named.url(), ":" + std::to_string(named.port()) + "/");
}

/// Connections that never finish their request are held beside a page that comes after them.
TEST(many_slow_connections_keep_no_page_out) {
  ScriptRig rig(1);
  std::vector<std::unique_ptr<test::TcpPeer>> slow;
  for (int i = 0; i < 300; ++i) {
    slow.push_back(std::make_unique<test::TcpPeer>(rig.port()));
    assert_true(slow.back()->is_connected() && slow.back()->send("GET / HT"));
  }
  const auto begin = std::chrono::steady_clock::now();
  assert_begins(get(rig.port(), "/", own_host(rig.port())), "HTTP/1.1 200");
  assert_true(std::chrono::steady_clock::now() - begin < std::chrono::seconds(2));
}
