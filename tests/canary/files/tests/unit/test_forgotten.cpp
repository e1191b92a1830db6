// SPDX-License-Identifier: Apache-2.0
// A test that nobody has registered.
int main() { return 1; }
