#pragma once
/// Parts that not every machine of a kind has and that bring messages of their own.

namespace graben {

/// What of them a machine has.
struct BusParts {
  bool swing_drive = false;
};

/// The part that a message belongs to; null: a message of every machine of its kind.
using BusPart = bool BusParts::*;

constexpr bool has_part(const BusParts& parts, BusPart part) {
  return part == nullptr || parts.*part;
}

}  // namespace graben
