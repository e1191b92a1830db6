#include "../../platform/bus.hpp"
