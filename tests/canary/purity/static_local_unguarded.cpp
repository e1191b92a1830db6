#include "static_local.cpp"
