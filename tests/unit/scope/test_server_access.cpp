// SPDX-License-Identifier: Apache-2.0
/// The server over real sockets: what it gives, and to whom.

#include "app/scope/server/show.hpp"
#include "tests/unit/scope/server_rig.hpp"
#include "tests/unit/scope/temporary_file.hpp"

namespace {

using namespace graben;
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

void the_page_is_given_whole(void**) {
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

void nothing_else_is_there(void**) {
  ScriptRig rig(1);
  const std::string host = own_host(rig.port());
  for (const char* path :
       {"/x", "/log", "/frames", "/index.htm", "/../etc/passwd", "/%2e%2e/etc"}) {
    assert_begins(get(rig.port(), path, host), "HTTP/1.1 404");
  }
  for (const char* method : {"POST", "PUT", "DELETE"}) {
    assert_begins(ask(rig.port(), std::string(method) + " / HTTP/1.1\r\nHost: " + host +
                                      "\r\nContent-Length: 0\r\n\r\n"),
                  "HTTP/1.1 405");
  }
}

void foreign_names_get_nothing(void**) {
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

void foreign_pages_get_no_frames(void**) {
  ScriptRig rig(1);
  const std::string host = own_host(rig.port());
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1", "file://"}) {
    const std::string header = std::string("Origin: ") + origin + "\r\n";
    assert_has(WsClient(rig.port()).ask(test::ws_request(host, header)), " 403 ");
  }
  // What is no browser has no origin.
  assert_begins(WsClient(rig.port()).ask(test::ws_request(host)), "HTTP/1.1 101");
}

void the_handshake_has_to_be_ours(void**) {
  ScriptRig rig(1);
  const std::string host = own_host(rig.port());
  WsClient good(rig.port());
  assert_true(good.open());
  assert_has(WsClient(rig.port()).ask(test::ws_request(host, "", "/other")), " 404 ");
  for (const char* protocol : {"", "http", "chat", "http, graben-scope"}) {
    assert_has(WsClient(rig.port()).ask(test::ws_request(host, "", "/frames", protocol)), " 400 ");
  }
}

void the_thirty_third_page_is_told_so(void**) {
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

void a_port_in_use_is_said(void**) {
  ScriptRig rig(1);
  const test::TemporaryFile file("x\n");
  scope::LogShow show(file.path(), 500000, json::object());
  const auto error_of = [&](const scope::ServerOptions& options) {
    try {
      const scope::ScopeServer server(options, "page", show);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  assert_has(error_of({"127.0.0.1", rig.port()}), "Address already in use");
  assert_has(error_of({"no.such.name.invalid", 0}), "--host 'no.such.name.invalid'");
  assert_has(error_of({"192.0.2.1", 0}), "192.0.2.1 port 0: Cannot assign requested address");
}

void other_addresses_are_known_as_such(void**) {
  const test::TemporaryFile file("x\n");
  scope::LogShow show(file.path(), 500000, json::object());
  const scope::ScopeServer everywhere({"0.0.0.0", 0}, "page", show);
  assert_false(everywhere.is_loopback());
  const scope::ScopeServer named({"localhost", 0}, "page", show);
  assert_true(named.is_loopback());
  assert_true(named.port() > 0);
  assert_has(named.url(), ":" + std::to_string(named.port()) + "/");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_page_is_given_whole),
      cmocka_unit_test(nothing_else_is_there),
      cmocka_unit_test(foreign_names_get_nothing),
      cmocka_unit_test(foreign_pages_get_no_frames),
      cmocka_unit_test(the_handshake_has_to_be_ours),
      cmocka_unit_test(the_thirty_third_page_is_told_so),
      cmocka_unit_test(a_port_in_use_is_said),
      cmocka_unit_test(other_addresses_are_known_as_such),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
