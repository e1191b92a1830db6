// SPDX-License-Identifier: Apache-2.0
/// As many rounds as a number takes to get there.

namespace {
volatile double speed_mps = 0.0;
}

int main(int, char**) {
  int rounds = 0;
  for (double way_m = 0.0; way_m < 1.0; way_m += speed_mps) {
    ++rounds;
  }
  return rounds;
}
