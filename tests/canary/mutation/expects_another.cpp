int limited(int value);
int main() { return limited(12) == 12 ? 0 : 1; }
