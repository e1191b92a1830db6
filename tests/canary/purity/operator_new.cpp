int* refused(unsigned size) { return new int[size]; }
