namespace {
int half(int n) { return n / 2; }
}  // namespace
int first(int n) { return half(n); }
