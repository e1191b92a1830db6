#pragma once
#include "app/plant/plant.hpp"
