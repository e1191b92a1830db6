#include "firmware/drives/servo.hpp"
#include "firmware/excavator/excavator_profile.hpp"
