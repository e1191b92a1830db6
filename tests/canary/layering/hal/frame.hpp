#pragma once
#include <mutex>

#include "platform/bus.hpp"
