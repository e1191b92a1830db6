/// Two that call each other for as long as they like.

namespace {

[[gnu::noinline]] int up(int n);

[[gnu::noinline]] int down(int n) { return n == 0 ? 0 : 1 + up(n - 1); }

[[gnu::noinline]] int up(int n) { return n == 0 ? 1 : 2 * down(n - 1); }

}  // namespace

int main(int argc, char**) { return down(argc); }
