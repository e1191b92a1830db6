// SPDX-License-Identifier: Apache-2.0
/// As many rounds as a sensor says.

namespace {
volatile int pulses = 0;
volatile int sum = 0;
}  // namespace

int main(int, char**) {
  const int count = pulses;
  for (int n = 0; n < count; ++n) {
    sum = sum + n;
  }
  return sum;
}
