/// graben-ecu: what is deployed.

#include <cstdio>

#include "app/ecu/ecu_process.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"

int main(int argc, char** argv) {
  const graben::TimeUs began_us = graben::monotonic_now_us();
  if (const graben::ErrorText error = graben::tune_heap(); !error.empty()) {
    std::fprintf(stderr, "graben-ecu: %s\n", error.c_str());
    return 1;
  }
  int status = 0;
  const auto options = graben::ecu::read_options(argc, argv, status);
  return options ? graben::ecu::run(*options, began_us) : status;
}
