// SPDX-License-Identifier: Apache-2.0
// Compiled as a machine kind's bus would be.
#include "loader_dbc.hpp"
