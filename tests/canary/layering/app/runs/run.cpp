#include "app/cli/tool.hpp"
