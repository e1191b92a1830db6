#pragma once
#include "hal/frame.hpp"
