// SPDX-License-Identifier: Apache-2.0
// Start of a program on QEMU's board mps2-an500 (Cortex-M7). QEMU has put the whole ELF file into
// memory and answers newlib's start code by semihosting: nothing to copy or to clear here.

#include <cstdint>

extern "C" void _start();

namespace {

void semihosting(std::uint32_t operation, std::uint32_t argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register std::uint32_t r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void reset() {
  // CPACR: coprocessors 10 and 11, which are the FPU, for everyone.
  volatile std::uint32_t& access = *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88);
  access = access | 0xF00000;
  asm volatile("dsb\n isb" ::: "memory");
  _start();
}

/// No interrupt is enabled: what comes here is a fault. Ends the run with status 1.
void fault() {
  static const char kText[] = "mps2-an500: fault\n";
  semihosting(0x04, reinterpret_cast<std::uint32_t>(kText));  // SYS_WRITE0
  semihosting(0x18, 0x20023);                                 // SYS_EXIT, run-time error
  for (;;) {
  }
}

struct Vectors {
  std::uint32_t stack;
  void (*handlers[15])();
};

}  // namespace

// At address 0, and kept though nothing calls it, by options of the linker. newlib asks QEMU for
// its own stack; this one, the end of the board's second memory, is that of the first instructions.
extern "C" const Vectors graben_vectors;
[[gnu::section(".vectors")]] const Vectors graben_vectors = {
    0x20400000,
    {reset, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault,
     fault, fault}};
