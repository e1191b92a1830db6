#include "app/scope/server.hpp"
