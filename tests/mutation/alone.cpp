// SPDX-License-Identifier: Apache-2.0
// Runs the tests of the one source that it is linked with.

#include "tests/unit/cmocka_cpp.hpp"

int main() { return graben::test::run_source(""); }
