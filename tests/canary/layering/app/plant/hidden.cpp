#include "app/plant/model.inc"
#define MODEL "firmware/drives/servo.hpp"
#include MODEL
#include "firmware/numeric/triangle.hpp"
