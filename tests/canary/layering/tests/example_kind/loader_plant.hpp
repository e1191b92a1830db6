#pragma once
#include "firmware/mcv/model.hpp"
