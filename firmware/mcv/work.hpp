// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a solve may do at most: all of its searches take their steps from one count, so that their
/// caps do not multiply. `tests/bound` counts with it.

namespace graben {

/// Steps that are left to a solve: of Newton, of a bisection, of a search over r, from one limit to
/// the next; and those that are kept for halving where a search over r has used up its own.
struct Work {
  int left = 0;
  int kept = 0;

  [[nodiscard]] bool is_spent() const { return left <= 0 && kept <= 0; }
};

/// What is kept may be taken from now on.
inline void allow_kept(Work* work) {
  if (work != nullptr) {
    work->left += work->kept;
    work->kept = 0;
  }
}

/// Takes one. A function of its own: a bound on a cycle knows it by its calls.
void spend(Work& work);

/// Takes a step, where there is one left. Where there is none, or no count was given, the caller
/// ends its search and says that it did not come to an end.
[[nodiscard]] inline bool may_step(Work* work) {
  if (work == nullptr || work->left <= 0) {
    return false;
  }
  spend(*work);
  return true;
}

}  // namespace graben
