int limited(int value);
int main() {
  (void)limited(11);
  return 0;
}
