#include <cstdlib>

void* refused(unsigned size) { return std::malloc(size); }
