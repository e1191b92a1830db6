#include <climits>

// Volatile: a comparison that the compiler folds overflows no more.
int main() {
  volatile int most = INT_MAX;
  volatile int beyond = most + 1;
  return beyond == 1 ? 2 : 0;
}
