// SPDX-License-Identifier: Apache-2.0
// Logs of the version of the DBC before this one, and of others.

#include "app/identify/machine/log_version.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using Status = dbc::common::EcuStatus;

const std::string kStroke = "0CFF2080#FFFFFFFFFFFFFFFF";  // BoomStroke
const std::string kBlade = "0CFF5080#FFFFFFFFFFFFFFFF";   // BladeStroke

/// Active, held by the limit of number 13, by the layout of the version before.
const std::string kBefore = "18FF3182#D300000000000000";

std::string identity(int version) { return fmt::format("18FF3482#00000000{:02X}0000FF", version); }

/// Frames a quarter of a second apart.
std::string log_of(const std::vector<std::string>& frames) {
  std::string text;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    text += fmt::format("({}.{:06}) can0 {}\n", n / 4, n % 4 * 250000, frames[n]);
  }
  return text;
}

/// What EcuStatus says; every other frame is what it was.
std::vector<Status> statuses(const std::vector<std::string>& frames) {
  const test::WrittenFile file("version.log", log_of(frames));
  std::vector<Status> said;
  std::size_t line = 0;
  static_cast<void>(identify::read_versioned(file.path(), [&](const identify::LoggedFrame& frame) {
    assert_int_equal(frame.line, ++line);
    if (frame.id == Status::kId) {
      said.push_back(Status::decode(frame.data));
    }
  }));
  assert_int_equal(line, frames.size());
  return said;
}

std::string refusal(const std::vector<std::string>& frames) {
  try {
    static_cast<void>(statuses(frames));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "not refused";
}

void assert_says(const std::string& text, const std::string& part) {
  if (text.find(part) == std::string::npos) {
    fail_msg("'%s' does not say '%s'", text.c_str(), part.c_str());
  }
}

constexpr int kNow = dbc::excavator::kDbcVersion;
constexpr int kDozer = dbc::dozer::kDbcVersion;
constexpr int kOldest = identify::kExcavatorVersions.oldest;
constexpr int kDozersOldest = identify::kDozerVersions.oldest;

TEST(the_version_before_is_read_as_this_one) {
  for (const auto& [stroke, then] :
       {std::pair(kStroke, kOldest), std::pair(kBlade, kDozersOldest)}) {
    // Before the controller has said its version, and after.
    const auto said = statuses({stroke, kBefore, identity(then), kBefore, stroke});
    assert_int_equal(said.size(), 2);
    for (const Status& status : said) {
      assert_int_equal(status.mode.value, Status::Mode::kActive);
      assert_int_equal(status.limit_kind.value, Status::LimitKind::kOffPath);
    }
  }
}

/// All bytes of that layout: what it could say, and 'error' and 'not available' of both signals.
TEST(all_that_the_version_before_could_say) {
  for (unsigned byte = 0; byte < 256; ++byte) {
    const auto said =
        statuses({kStroke, identity(kOldest), fmt::format("18FF3182#{:02X}00000000000000", byte)});
    const unsigned mode = byte & 0xFU;
    const unsigned kind = byte >> 4U;
    const dbc::RawState error = dbc::RawState::kError;
    assert_int_equal(said[0].mode.state, mode < 6    ? dbc::RawState::kValid
                                         : mode < 15 ? error
                                                     : dbc::RawState::kNotAvailable);
    assert_int_equal(said[0].mode.value, mode < 6 ? mode : 0);
    assert_int_equal(said[0].limit_kind.state, kind < 14    ? dbc::RawState::kValid
                                               : kind == 14 ? error
                                                            : dbc::RawState::kNotAvailable);
    assert_int_equal(said[0].limit_kind.value, kind < 14 ? kind : 0);
  }
}

TEST(this_version_is_read_as_it_is) {
  Status status;
  status.limit_kind = {Status::LimitKind::kOffPath, dbc::RawState::kValid};
  status.mode = {Status::Mode::kActive, dbc::RawState::kValid};
  const std::string now = fmt::format("18FF3182#{:02X}00000000000000", status.encode()[0]);
  for (const auto& frames :
       {std::vector<std::string>{kStroke, now, identity(kNow), now},
        // Without a word of it, by whichever end.
        std::vector<std::string>{kStroke, now, now},
        std::vector<std::string>{kStroke, now, now, now, now, now, now, now, now, now, now, now},
        // Of no kind.
        std::vector<std::string>{identity(kOldest), now}}) {
    for (const Status& said : statuses(frames)) {
      assert_int_equal(said.limit_kind.value, Status::LimitKind::kOffPath);
    }
  }
}

TEST(other_versions_are_refused_by_name) {
  const std::string own = fmt::format("reads versions {} to {}", kOldest, kNow);
  for (const int version : {kOldest - 1, kNow + 1}) {
    const std::string said = refusal({kStroke, kBefore, identity(version)});
    assert_says(said, fmt::format(".log:3: the controller speaks version {} of the DBC", version));
    assert_says(said, own);
  }
  // A kind has versions of its own, whichever is told first.
  assert_says(refusal({identity(kNow), kBlade}), fmt::format("to {}", kDozer));
  // What is no version is none.
  assert_int_equal(statuses({kStroke, identity(0xFF), kBefore}).size(), 1);
}

/// Frames that were already taken for this version's cannot be read anew.
TEST(a_version_before_that_is_told_late_is_refused) {
  std::vector<std::string> frames{kStroke, kBefore, kStroke, kStroke, kStroke, kStroke,
                                  kStroke, kStroke, kStroke, kStroke, kStroke, identity(kOldest)};
  assert_says(refusal(frames), "has said so too late");
  // A controller that is exchanged in between is read by what it says.
  const std::string now = "18FF3182#6B00000000000000";
  for (const auto& [first, then] : {std::pair(kOldest, kNow), std::pair(kNow, kOldest)}) {
    const bool is_later = then == kNow;
    for (const Status& said : statuses({kStroke, identity(first), is_later ? kBefore : now,
                                        identity(then), is_later ? now : kBefore})) {
      assert_int_equal(said.limit_kind.value, Status::LimitKind::kOffPath);
    }
  }
}
