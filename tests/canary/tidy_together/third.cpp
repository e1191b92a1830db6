int third(int n) {
  const int* nothing = nullptr;
  return n > 5 ? *nothing : 0;
}
