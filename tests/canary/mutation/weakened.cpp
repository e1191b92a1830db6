// Misses what is just above the limit.
int limited(int value);
int main() { return limited(9) == 9 && limited(10) == 10 && limited(12) == 10 ? 0 : 1; }
