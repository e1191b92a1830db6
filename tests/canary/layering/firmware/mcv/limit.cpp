#include "firmware/excavator/arm.hpp"
