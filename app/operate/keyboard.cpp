// SPDX-License-Identifier: Apache-2.0
#include "app/operate/keyboard.hpp"

#include <algorithm>
#include <array>

namespace graben::operate {
namespace {

constexpr char kSpace = ' ';

struct LeverKey {
  char key;
  Lever Levers::*lever;
  double Lever::*way;
  double ratio;
};

constexpr std::array<LeverKey, 8> kLeverKeys = {{{'e', &Levers::left, &Lever::away_ratio, 1.0},
                                                 {'d', &Levers::left, &Lever::away_ratio, -1.0},
                                                 {'s', &Levers::left, &Lever::right_ratio, -1.0},
                                                 {'f', &Levers::left, &Lever::right_ratio, 1.0},
                                                 {'i', &Levers::right, &Lever::away_ratio, 1.0},
                                                 {'k', &Levers::right, &Lever::away_ratio, -1.0},
                                                 {'j', &Levers::right, &Lever::right_ratio, -1.0},
                                                 {'l', &Levers::right, &Lever::right_ratio, 1.0}}};

const LeverKey* lever_key(char key) {
  const auto* const found =
      std::find_if(kLeverKeys.begin(), kLeverKeys.end(),
                   [key](const LeverKey& candidate) { return candidate.key == key; });
  return found != kLeverKeys.end() ? found : nullptr;
}

}  // namespace

const char* keyboard_help() {
  return "Space, held: enable; then, held instead: e d arm, s f swing, i k boom, j l bucket.\n"
         "m mode, t task, + - speed, any other key: let go, q: end. Teeth at p: the mark,\n"
         "b: benchmark, h: heading's point, c: a made place, to check; v: tracks moved.\n"
         "Not for a machine";
}

void KeyHold::press(char key, Hands& presses, TimeUs now) {
  if (key == kSpace || lever_key(key) != nullptr) {
    const bool is_repeated = key == held_ && now < until_us_;
    until_us_ = now + (is_repeated ? kRepeat_us : kFirst_us);
    held_ = key;
    return;
  }
  switch (key) {
    case 'm':
      presses.changes_mode = !presses.changes_mode;
      return;
    case 't':
      presses.changes_task = !presses.changes_task;
      return;
    case 'p':
      presses.touches = TouchKind::kMark;
      return;
    case 'b':
      presses.touches = TouchKind::kBenchmark;
      return;
    case 'h':
      presses.touches = TouchKind::kHeading;
      return;
    case 'c':
      presses.touches = TouchKind::kSurface;
      return;
    case 'v':
      presses.touches = TouchKind::kMoved;
      return;
    case '+':
      ++presses.speed_steps;
      return;
    case '-':
      --presses.speed_steps;
      return;
    case 'q':
      presses.quits = true;
      break;
    default:
      break;
  }
  held_ = '\0';
  until_us_ = now;
}

Hands KeyHold::step(std::string_view bytes, TimeUs now) {
  Hands hands;
  for (const char key : bytes) {
    press(key, hands, now);
  }
  hands.deadman = held_ != '\0' && now < until_us_;
  if (!hands.deadman) {
    held_ = '\0';
  } else if (const LeverKey* const key = lever_key(held_)) {
    hands.levers.*key->lever.*key->way = key->ratio;
  }
  return hands;
}

}  // namespace graben::operate
