#pragma once
#include "app/helper.hpp"
