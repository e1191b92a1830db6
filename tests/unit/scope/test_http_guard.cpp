// SPDX-License-Identifier: Apache-2.0
/// Which names this server goes by, and which pages may talk to it.

#include "app/scope/server/access.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using graben::scope::is_own_host;
using graben::scope::is_own_origin;

TEST(addresses_and_localhost_are_own) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "localhost:8080", "LocalHost",
                           "10.1.2.3:1", "[::1]", "[::1]:8080", "[fe80::1]:65535"}) {
    assert_true(is_own_host(host, "127.0.0.1"));
  }
}

TEST(the_name_that_was_told_is_own) {
  assert_true(is_own_host("Excavator.local:8080", "excavator.local"));
  assert_false(is_own_host("excavator.local:8080", "127.0.0.1"));
}

TEST(foreign_names_are_not) {
  for (const char* host : {"evil.example",
                           "evil.example:8080",
                           "localhost.evil.example",
                           "127.0.0.1.evil.example",
                           "",
                           ":8080",
                           "localhost:",
                           "localhost:http",
                           "localhost:123456",
                           "127.0.0.1:80:80",
                           "[::1",
                           "[::1]x",
                           "[127.0.0.1]",
                           "[]",
                           "::1",
                           "127.0.0.1 ",
                           " localhost",
                           "localhost.",
                           "evil@127.0.0.1",
                           "127.1",
                           "0x7f000001"}) {
    if (is_own_host(host, "127.0.0.1")) {
      print_error("'%s' is taken for this server\n", host);
      _fail(__FILE__, __LINE__);
    }
  }
  assert_false(is_own_host(std::string_view("127.0.0.1\0.evil", 15), "127.0.0.1"));
}

TEST(own_pages_have_the_same_host_and_port) {
  assert_true(is_own_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  assert_true(is_own_origin("http://LOCALHOST:8080", "localhost:8080"));
  for (const char* origin :
       {"http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1:8081",
        "http://127.0.0.1", "null", "", "file://", "http://127.0.0.1:8080/",
        "http://127.0.0.1:8080.evil.example", "http://evil.example@127.0.0.1:8080"}) {
    assert_false(is_own_origin(origin, "127.0.0.1:8080"));
  }
  assert_false(is_own_origin("http://", ""));
}
