#include "app/machines/simulated/machine.hpp"
