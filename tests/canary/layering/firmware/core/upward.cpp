#include "hal/frame.hpp"
