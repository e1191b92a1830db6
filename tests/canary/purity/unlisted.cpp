extern "C" int getpid();

int refused() { return getpid(); }
