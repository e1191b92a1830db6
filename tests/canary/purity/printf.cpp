#include <cstdio>

void refused(double pressure_pa) { std::printf("%g\n", pressure_pa); }
