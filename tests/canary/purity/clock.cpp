// Declared here: a target without a clock has no header for it.
struct timespec;
extern "C" int clock_gettime(int clock, timespec* now);

int refused(timespec* now) { return clock_gettime(1, now); }
