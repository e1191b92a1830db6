int cycles = 0;

int refused() { return ++cycles; }
