/// More constants and more variables than there is room for.

namespace {
const volatile int kConstants[64'000] = {1, 2, 3};
volatile int variables[9'600];
}  // namespace

int main(int argc, char**) {
  variables[argc] = kConstants[argc];
  return variables[2 * argc];
}
