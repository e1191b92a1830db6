// SPDX-License-Identifier: Apache-2.0
/// What a page is sent, in which order, and what becomes of what it says.

#include "app/scope/server/client.hpp"

#include <vector>

#include "tests/unit/cmocka_cpp.hpp"

using nlohmann::json;
using scope::Client;
using scope::Content;
using scope::Received;

/// What the one page of a test is to get.
struct Script {
  std::vector<std::string> blocks;  ///< Taken from the front.
  std::uint64_t lost = 0;
  std::uint64_t revision = 0;  ///< Of the state; 0: there is none.
  std::vector<json> wishes;
};

class ScriptedStream : public scope::ClientStream {
 public:
  explicit ScriptedStream(Script& script) : script_(script) {}
  bool next(std::string& message) override {
    if (script_.blocks.empty()) {
      return false;
    }
    message += script_.blocks.front();
    script_.blocks.erase(script_.blocks.begin());
    return true;
  }
  [[nodiscard]] std::uint64_t lost() const override { return script_.lost; }

 private:
  Script& script_;
};

class ScriptedShow : public scope::Show {
 public:
  explicit ScriptedShow(Script& script) : script_(script) {}
  [[nodiscard]] const std::string& setup() const override { return setup_; }
  [[nodiscard]] std::string words() const override { return "script"; }
  [[nodiscard]] std::unique_ptr<scope::ClientStream> open() const override {
    return std::make_unique<ScriptedStream>(script_);
  }
  [[nodiscard]] std::optional<std::string> control(const json& wish) override {
    script_.wishes.push_back(wish);
    if (wish.at("do").get<std::string>() == "run") {
      return std::nullopt;
    }
    return "not \xFF that";
  }
  [[nodiscard]] std::optional<json> state(std::uint64_t& seen) const override {
    if (seen == script_.revision) {
      return std::nullopt;
    }
    seen = script_.revision;
    return json{{"kind", "bus"}, {"revision", seen}};
  }

 private:
  Script& script_;
  std::string setup_ = R"({"kind":"setup"})";
};

struct Rig {
  Script script;
  ScriptedShow show{script};
  Client client{show};

  /// The next message, "-" if there is none, with '=' before lines.
  std::string next() {
    std::string buffer = "room";
    const std::optional<Content> content = client.next(buffer);
    assert_int_equal(buffer.compare(0, 4, "room"), 0);
    return !content ? "-" : (*content == Content::kLines ? "=" : "") + buffer.substr(4);
  }
  void past_setup() { assert_string_equal(next().c_str(), R"({"kind":"setup"})"); }
  Received say(const std::string& text) { return client.receive({text, false, true}); }
};

void assert_next(Rig& rig, const char* expected) {
  assert_string_equal(rig.next().c_str(), expected);
}

TEST(setup_is_first_and_once) {
  Rig rig;
  rig.script.blocks = {"a\n"};
  rig.past_setup();
  assert_next(rig, "=a\n");
  assert_next(rig, "-");
}

TEST(state_comes_before_frames_and_when_it_changes) {
  Rig rig;
  rig.script.revision = 1;
  rig.script.blocks = {"a\n"};
  rig.past_setup();
  assert_next(rig, R"({"kind":"bus","revision":1})");
  assert_next(rig, "=a\n");
  assert_next(rig, "-");
  rig.script.revision = 2;
  assert_next(rig, R"({"kind":"bus","revision":2})");
  assert_next(rig, "-");
}

TEST(lost_frames_are_told_when_their_count_changes) {
  Rig rig;
  rig.past_setup();
  rig.script.lost = 12;
  rig.script.blocks = {"a\n"};
  assert_next(rig, R"({"kind":"dropped","frames":12})");
  assert_next(rig, "=a\n");
  assert_next(rig, "-");
}

void assert_refused(Rig& rig, const char* why) {
  const json answer = json::parse(rig.next());
  assert_string_equal(answer["kind"].get<std::string>().c_str(), "refused");
  const auto words = answer["why"].get<std::string>();
  if (words.find(why) == std::string::npos) {
    print_error("'%s' not in '%s'\n", why, words.c_str());
    _fail(__FILE__, __LINE__);
  }
}

TEST(a_wish_is_handed_on_and_not_answered) {
  Rig rig;
  rig.past_setup();
  assert_int_equal(rig.say(R"({"do":"run"})"), Received::kTaken);
  assert_int_equal(rig.script.wishes.size(), 1);
  assert_next(rig, "-");
}

TEST(what_is_refused_is_answered) {
  Rig rig;
  rig.past_setup();
  for (const char* text :
       {R"({"do":"fly"})", R"({"do":7})", "{}", "[]", "7", "null", "{", "", "x"}) {
    assert_int_equal(rig.say(text), Received::kTaken);
  }
  // Bytes that are no UTF-8 must not get into JSON.
  assert_refused(rig, "not \xEF\xBF\xBD that");
  assert_refused(rig, "a value is of another kind");
  assert_refused(rig, "a value is missing");
  repeat(3, [&] { assert_refused(rig, "this is no object"); });
  repeat(3, [&] { assert_refused(rig, "this is not JSON"); });
  assert_next(rig, "-");
  assert_int_equal(rig.script.wishes.size(), 3);
}

TEST(pieces_become_one_message) {
  Rig rig;
  assert_int_equal(rig.client.receive({R"({"do":)", false, false}), Received::kTaken);
  assert_int_equal(rig.script.wishes.size(), 0);
  assert_int_equal(rig.client.receive({R"("run"})", false, true}), Received::kTaken);
  assert_int_equal(rig.script.wishes.size(), 1);
  assert_int_equal(rig.say(R"({"do":"run"})"), Received::kTaken);
  assert_int_equal(rig.script.wishes.size(), 2);
}

TEST(a_message_may_have_4096_bytes) {
  Rig rig;
  const std::string wish = R"({"do":"run"})";
  const std::string longest = wish + std::string(Client::kMessageMostBytes - wish.size(), ' ');
  assert_int_equal(rig.say(longest), Received::kTaken);
  assert_int_equal(rig.script.wishes.size(), 1);
  assert_int_equal(rig.say(longest + " "), Received::kTooLong);
  assert_int_equal(rig.client.receive({longest, false, false}), Received::kTaken);
  assert_int_equal(rig.client.receive({" ", false, true}), Received::kTooLong);
}

TEST(binary_is_not_taken) {
  Rig rig;
  assert_int_equal(rig.client.receive({"x", true, true}), Received::kBinary);
}

TEST(who_says_too_much_has_to_wait) {
  Rig rig;
  for (int i = 0; i < Client::kBudgetMost; ++i) {
    assert_true(rig.client.may_speak());
    rig.say(R"({"do":"run"})");
  }
  assert_false(rig.client.may_speak());
  rig.client.tick();
  for (int i = 0; i < Client::kBudgetPerTick; ++i) {
    assert_true(rig.client.may_speak());
    rig.say(R"({"do":"run"})");
  }
  assert_false(rig.client.may_speak());
  repeat(2 * Client::kBudgetMost, [&] { rig.client.tick(); });
  for (int i = 0; i < Client::kBudgetMost; ++i) {
    rig.say(R"({"do":"run"})");
  }
  assert_false(rig.client.may_speak());
}

TEST(answers_that_wait_are_few) {
  Rig rig;
  rig.past_setup();
  for (std::size_t i = 0; i < Client::kAnswersMost; ++i) {
    assert_true(rig.client.may_speak());
    rig.say("x");
  }
  assert_false(rig.client.may_speak());
  assert_refused(rig, "not JSON");
  assert_true(rig.client.may_speak());
}
