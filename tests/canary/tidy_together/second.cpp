namespace {
int half(int n) { return n > 3 ? 0 : 1; }
}  // namespace
int second(int n) { return n > 5 ? 10 / half(n) : 0; }
