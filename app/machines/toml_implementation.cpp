// toml++'s own code, compiled once and linked in: what is deployed needs no library beyond the
// standard ones.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
