/// 12 kB of stack, no function of it more than 6.

namespace {

constexpr int kWords = 1500;

[[gnu::noinline]] int inner(int n) {
  volatile int words[kWords] = {};
  words[n % kWords] = n;
  return words[n / 2 % kWords];
}

[[gnu::noinline]] int outer(int n) {
  volatile int words[kWords] = {};
  words[n % kWords] = inner(n);
  return words[n / 2 % kWords];
}

}  // namespace

int main(int argc, char**) { return outer(argc); }
