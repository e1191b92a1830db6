// SPDX-License-Identifier: Apache-2.0
#include "app/identify/verdict/meaning.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <vector>

namespace graben::identify {
namespace {

using Words = std::vector<std::string>;

/// "BoomUpPilot1" as boom, up, pilot.
Words words_of(std::string_view name) {
  Words words;
  bool joins = false;
  char before = ' ';
  for (std::size_t at = 0; at < name.size(); ++at) {
    const auto letter = static_cast<unsigned char>(name[at]);
    const bool is_letter = std::isalpha(letter) != 0;
    const bool next_is_small =
        at + 1 < name.size() && std::islower(static_cast<unsigned char>(name[at + 1])) != 0;
    const bool begins = std::isupper(letter) != 0 &&
                        (std::islower(static_cast<unsigned char>(before)) != 0 ||
                         (std::isupper(static_cast<unsigned char>(before)) != 0 && next_is_small));
    if (!is_letter || begins) {
      joins = false;
    }
    if (is_letter) {
      if (!joins) {
        words.emplace_back();
      }
      words.back() += static_cast<char>(std::tolower(letter));
      joins = true;
    }
    before = name[at];
  }
  return words;
}

bool any_of(const Words& words, std::initializer_list<const char*> of) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(of.begin(), of.end(), word) != of.end();
  });
}

int drive_of(const Words& words) {
  const bool track = any_of(words, {"track", "tracks", "travel", "crawler"});
  if (any_of(words, {"boom"})) return 0;
  if (any_of(words, {"arm", "stick", "dipper"})) return 1;
  if (any_of(words, {"bucket", "bkt", "shovel"})) return 2;
  if (any_of(words, {"swing", "slew", "turret", "cab", "house", "yaw"})) return 3;
  if (any_of(words, {"blade"})) return 4;
  if (any_of(words, {"tilt"})) return 5;
  if (track && any_of(words, {"left", "l"})) return 6;
  if (track && any_of(words, {"right", "r"})) return 7;
  if (any_of(words, {"steering", "steer", "articulation"})) return 8;
  if (any_of(words, {"lift", "hoist"})) return 0;
  return -1;
}

int side_of(const Words& words) {
  if (any_of(words, {"up", "raise", "extend", "ext", "out", "right", "crowd", "curl", "plus",
                     "positive", "pos"})) {
    return 1;
  }
  return any_of(words, {"down", "lower", "retract", "ret", "in", "left", "dump", "uncurl", "minus",
                        "negative", "neg"})
             ? -1
             : 0;
}

Unit unit_of(const Words& words, std::string_view whole) {
  if (any_of(words, {"permille", "mille", "promille"})) return Unit::kPermille;
  if (any_of(words, {"percent", "pct", "perc"}) || whole.find('%') != std::string_view::npos) {
    return Unit::kPercent;
  }
  if (any_of(words, {"ratio", "norm", "normalized", "normalised"})) return Unit::kRatio;
  if (any_of(words, {"mrad", "mradps"})) return Unit::kMrad;
  if (any_of(words, {"rad", "rads", "radian", "radians", "radps"})) return Unit::kRad;
  if (any_of(words, {"deg", "degs", "degree", "degrees", "degps", "dps"}) ||
      whole.find("\xC2\xB0") != std::string_view::npos) {
    return Unit::kDegree;
  }
  if (any_of(words, {"mm", "mmps"})) return Unit::kMillimetre;
  if (any_of(words, {"cm"})) return Unit::kCentimetre;
  if (any_of(words, {"ms", "msec", "millis", "milliseconds"})) return Unit::kMillisecond;
  if (any_of(words, {"us", "usec", "micros", "microseconds"})) return Unit::kMicrosecond;
  if (any_of(words, {"m", "mps", "metre", "meter"})) return Unit::kMetre;
  if (any_of(words, {"min", "mins", "minute", "minutes"})) return Unit::kMinute;
  if (any_of(words, {"s", "sec", "secs", "seconds"})) return Unit::kSecond;
  if (any_of(words, {"mpa", "bar", "kpa", "pa", "psi", "ma", "v", "volt", "kn", "l", "rpm"})) {
    return Unit::kOther;
  }
  return Unit::kUnknown;
}

bool is_none(const Words& words) {
  return any_of(words,
                {"target",       "desired",     "des",         "ref",     "reference", "setpoint",
                 "wanted",       "goal",        "plan",        "planned", "predicted", "pred",
                 "error",        "err",         "expected",    "edge",    "least",     "most",
                 "flow",         "temperature", "temp",        "force",   "torque",    "acc",
                 "acceleration", "status",      "state_error", "counter", "crc",       "payload"});
}

}  // namespace

Meaning meaning_of(std::string_view name, std::string_view unit_as_it_is) {
  std::string unit(unit_as_it_is);  // "MPa" is one word.
  std::transform(unit.begin(), unit.end(), unit.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const std::string whole = std::string(name) + " " + unit;
  const Words words = words_of(whole);
  const Words said = words_of(unit);
  Meaning meaning;
  meaning.drive = drive_of(words);
  meaning.unit = said.empty() && unit.empty() ? unit_of(words, name) : unit_of(said, unit);
  meaning.second = any_of(words, {"second", "redundant", "backup"}) && meaning.drive >= 0;
  if (meaning.drive < 0) {
    if (any_of(words, {"time", "timestamp", "t", "stamp", "zeit", "elapsed", "clock", "date"})) {
      meaning.what = What::kTime;
    } else if (any_of(words, {"run", "trial", "episode", "segment", "cycle"})) {
      meaning.what = What::kRun;
    }
    return meaning;
  }
  const bool command =
      any_of(words, {"command", "cmd", "duty", "lever", "joystick", "joy", "ctrl", "control",
                     "input", "valve", "current", "pwm", "u", "action", "demand", "request"});
  const bool velocity = any_of(words, {"velocity", "vel", "speed", "rate", "omega", "dot", "gyro",
                                       "radps", "degps", "mps", "mmps", "dps", "dq", "qd"}) ||
                        whole.find("/s") != std::string::npos;
  // A speed that is asked for is a command, whatever its unit.
  const bool asked =
      any_of(words, {"command", "cmd", "demand", "request", "lever", "joystick", "joy"});
  const bool length =
      any_of(words, {"stroke", "length", "len", "cylinder", "cyl", "extension", "displacement"});
  if (is_none(words)) {
    meaning.what = What::kOther;
  } else if (command && (asked || !velocity)) {
    meaning.what = What::kCommand;
    meaning.unit = velocity ? Unit::kOther : meaning.unit;
    meaning.side = meaning.drive > 5 ? 0 : side_of(words);
  } else if (any_of(words, {"pilot", "spool"})) {
    meaning.what = What::kSpool;
    meaning.side = side_of(words);
  } else if (any_of(words, {"pressure", "press", "bar", "mpa", "kpa", "psi"})) {
    meaning.what = What::kPressure;
  } else if (velocity || meaning.drive == 6 || meaning.drive == 7) {
    meaning.what = What::kVelocity;
    meaning.length = length || meaning.unit == Unit::kMetre || meaning.unit == Unit::kMillimetre;
  } else if (length || any_of(words, {"angle", "ang", "pos", "position", "theta", "joint", "q",
                                      "rad", "deg", "mrad", "encoder", "pitch", "mm", "m"})) {
    meaning.what = What::kPosition;
    meaning.length = length || meaning.unit == Unit::kMetre || meaning.unit == Unit::kMillimetre ||
                     meaning.unit == Unit::kCentimetre;
  } else if (side_of(words) != 0) {
    meaning.what = What::kCommand;  // "boom_up"
    meaning.side = side_of(words);
  }
  return meaning;
}

const char* what_text(What what) {
  switch (what) {
    case What::kTime:
      return "time";
    case What::kRun:
      return "number of the run";
    case What::kCommand:
      return "command";
    case What::kSpool:
      return "measured spool or pilot pressure";
    case What::kPosition:
      return "position";
    case What::kVelocity:
      return "speed";
    case What::kPressure:
      return "pressure";
    case What::kOther:
      break;
  }
  return "not used";
}

const char* unit_text(Unit unit) {
  switch (unit) {
    case Unit::kRad:
      return "rad";
    case Unit::kMrad:
      return "mrad";
    case Unit::kDegree:
      return "degrees";
    case Unit::kMetre:
      return "m";
    case Unit::kCentimetre:
      return "cm";
    case Unit::kMillimetre:
      return "mm";
    case Unit::kRatio:
      return "ratio";
    case Unit::kPercent:
      return "%";
    case Unit::kPermille:
      return "per mille";
    case Unit::kSecond:
      return "s";
    case Unit::kMillisecond:
      return "ms";
    case Unit::kMicrosecond:
      return "us";
    case Unit::kMinute:
      return "min";
    case Unit::kUnknown:
    case Unit::kOther:
      break;
  }
  return "unit unknown";
}

}  // namespace graben::identify
