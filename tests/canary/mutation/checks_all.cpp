int limited(int value);
int main() {
  return limited(9) == 9 && limited(10) == 10 && limited(11) == 10 && limited(12) == 10 ? 0 : 1;
}
