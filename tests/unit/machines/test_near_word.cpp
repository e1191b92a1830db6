// SPDX-License-Identifier: Apache-2.0
// The word that somebody may have meant.

#include "app/machines/near_word.hpp"

#include "tests/unit/cmocka_cpp.hpp"

using graben::machines::near_word;
using graben::machines::near_word_hint;

const std::vector<std::string> kWords = {"dig",    "grade",   "autodig",
                                         "--seed", "--speed", "identify"};

TEST(test_slips) {
  assert_string_equal(near_word("dgi", kWords).c_str(), "dig");
  assert_string_equal(near_word("garde", kWords).c_str(), "grade");
  assert_string_equal(near_word("autodi", kWords).c_str(), "autodig");
  assert_string_equal(near_word("indentify", kWords).c_str(), "identify");
  // Equally near, both: the one that begins alike.
  assert_string_equal(near_word("--sped", kWords).c_str(), "--speed");
  assert_string_equal(near_word_hint("grad", kWords).c_str(), "; did you mean 'grade'?");
}

TEST(test_nothing_is_near) {
  for (const char* word : {"", "x", "xy", "solve", "completely"}) {
    assert_string_equal(near_word(word, kWords).c_str(), "");
    assert_string_equal(near_word_hint(word, kWords).c_str(), "");
  }
  assert_string_equal(near_word("dig", {}).c_str(), "");
}
