// Run with one argument less than it would take: gone through, but not every way.
int main(int count, char**) {
  if (count == 2) {
    return 1;
  }
  return 0;
}
