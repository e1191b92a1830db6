// Volatile: a compiler that saw the size would have the other sanitizer speak first.
int main() {
  int* volatile values = new int[4]{};
  const int beyond = values[4];
  delete[] values;
  return beyond == 1 ? 2 : 0;
}
