// SPDX-License-Identifier: Apache-2.0
// QEMU plugin: within each call of a root how many instructions each call of a function executes at
// most, with all that it calls, and how often functions are called in one call of another
// (held_bounds.py). Thumb code, one processor, no interrupts.
//
//   QEMU_PLUGIN=libfunction_plugin.so,in=FILE,out=FILE
//
// `in`: lines `root ADDRESS`, `function ADDRESS`, `within N ADDRESS`, `calls N ADDRESS`, addresses
// in hex. `out`: lines `function ADDRESS MOST CALLS`, `fact N TIMES CALLS`.
//
// A call begins where a block with a call at its end is followed by a function's first one, and
// ends where the block behind the call runs again; a function that goes on in another (a tail
// call) ends with it. QEMU 7.2 has no header for its plugins: see tests/timing/counts.

#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info_t;
enum { QEMU_PLUGIN_CB_NO_REGS = 0 };
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t,
                                           void (*)(qemu_plugin_id_t, struct qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb*, void (*)(unsigned, void*), int,
                                          void*);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void*), void*);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t index);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn*);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn*);
const void* qemu_plugin_insn_data(const struct qemu_plugin_insn*);
void qemu_plugin_outs(const char*);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;
__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t,
                                                               const struct qemu_info_t*, int,
                                                               char**);

enum { kMostFunctions = 4096, kMostFacts = 64, kMostDepth = 256, kMostWords = 200 };

struct Function {
  uint64_t address, most, calls;
  uint64_t step, of_step, most_of_step;
  uint64_t within, counted;  // a bit of each fact
  bool root;
};
struct Fact {
  uint64_t now, most, calls;
  unsigned depth;  // counts begin anew with the outermost
};
struct Block {
  uint64_t begin, end, count;
  struct Function* function;  // that begins here
  bool calls;
};
struct Frame {
  struct Function* function;
  uint64_t back, from;
};

static struct Function functions[kMostFunctions];
static struct Fact facts[kMostFacts];
static unsigned function_count, fact_count, depth;
static struct Frame frames[kMostDepth];
static const struct Block* last;
static uint64_t executed, steps;
static FILE* out;

static struct Function* function_at(uint64_t address) {
  unsigned low = 0, high = function_count;
  while (low < high) {
    const unsigned middle = (low + high) / 2;
    if (functions[middle].address < address) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low < function_count && functions[low].address == address ? &functions[low] : NULL;
}

static void push(struct Function* function, uint64_t back) {
  if (depth == kMostDepth) {
    qemu_plugin_outs("function_plugin: calls go too deep\n");
    abort();
  }
  steps += depth == 0;
  frames[depth++] = (struct Frame){function, back, executed};
  ++function->calls;
  for (unsigned n = 0; n < fact_count; ++n) {
    struct Fact* const fact = &facts[n];
    if (function->within >> n & 1U && fact->depth++ == 0) {
      fact->now = 0;
      ++fact->calls;
    }
    if (function->counted >> n & 1U && fact->depth > 0 && ++fact->now > fact->most) {
      fact->most = fact->now;
    }
  }
}

static void pop(void) {
  const struct Frame* const frame = &frames[--depth];
  struct Function* const function = frame->function;
  const uint64_t taken = executed - frame->from;
  function->of_step = (function->step == steps ? function->of_step : 0) + taken;
  function->step = steps;
  if (taken > function->most) {
    function->most = taken;
  }
  if (function->of_step > function->most_of_step) {
    function->most_of_step = function->of_step;
  }
  for (unsigned n = 0; n < fact_count; ++n) {
    facts[n].depth -= function->within >> n & 1U;
  }
}

static void run(unsigned cpu, void* data) {
  (void)cpu;
  const struct Block* const block = data;
  while (depth > 0 && frames[depth - 1].back == block->begin) {
    pop();
  }
  if (block->function != NULL && last != NULL && (depth > 0 || block->function->root)) {
    if (last->calls) {
      push(block->function, last->end);
    } else if (depth > 0 && frames[depth - 1].function != block->function) {
      push(block->function, frames[depth - 1].back);
    }
  }
  executed += block->count;
  last = block;
}

// BL and BLX, of a place or of a register.
static bool is_call(const struct qemu_plugin_insn* instruction) {
  uint16_t half[2] = {0, 0};
  const size_t size = qemu_plugin_insn_size(instruction);
  memcpy(half, qemu_plugin_insn_data(instruction), size < sizeof half ? size : sizeof half);
  return size == 2 ? (half[0] & 0xFF87U) == 0x4780U
                   : (half[0] & 0xF800U) == 0xF000U && (half[1] & 0xD000U) == 0xD000U;
}

static void translate(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
  (void)id;
  struct Block* const block = malloc(sizeof *block);
  if (block == NULL) {
    abort();
  }
  block->count = qemu_plugin_tb_n_insns(tb);
  const struct qemu_plugin_insn* const end = qemu_plugin_tb_get_insn(tb, block->count - 1);
  block->begin = qemu_plugin_insn_vaddr(qemu_plugin_tb_get_insn(tb, 0));
  block->end = qemu_plugin_insn_vaddr(end) + qemu_plugin_insn_size(end);
  block->function = function_at(block->begin);
  block->calls = is_call(end);
  qemu_plugin_register_vcpu_tb_exec_cb(tb, run, QEMU_PLUGIN_CB_NO_REGS, block);
}

static void tell(qemu_plugin_id_t id, void* data) {
  (void)id;
  (void)data;
  for (unsigned n = 0; n < function_count; ++n) {
    const struct Function* const one = &functions[n];
    fprintf(out, "function %" PRIx64 " %" PRIu64 " %" PRIu64 " %" PRIu64 "\n", one->address,
            one->most, one->calls, one->most_of_step);
  }
  for (unsigned n = 0; n < fact_count; ++n) {
    fprintf(out, "fact %u %" PRIu64 " %" PRIu64 "\n", n, facts[n].most, facts[n].calls);
  }
  fclose(out);
}

// Functions come in order, and before what is said of them.
static bool read_line(const char* line) {
  uint64_t address = 0;
  unsigned fact = 0;
  if (sscanf(line, "function %" SCNx64, &address) == 1) {
    const bool fits = function_count < kMostFunctions &&
                      (function_count == 0 || functions[function_count - 1].address < address);
    if (fits) {
      functions[function_count++].address = address;
    }
    return fits;
  }
  const bool within = sscanf(line, "within %u %" SCNx64, &fact, &address) == 2;
  const bool counted = !within && sscanf(line, "calls %u %" SCNx64, &fact, &address) == 2;
  const bool root = !within && !counted && sscanf(line, "root %" SCNx64, &address) == 1;
  struct Function* const function = function_at(address);
  if (!(within || counted || root) || function == NULL || fact >= kMostFacts) {
    return false;
  }
  function->within |= (uint64_t)within << fact;
  function->counted |= (uint64_t)counted << fact;
  function->root = function->root || root;
  fact_count = !root && fact >= fact_count ? fact + 1 : fact_count;
  return true;
}

int qemu_plugin_install(qemu_plugin_id_t id, const struct qemu_info_t* info, int count,
                        char** words) {
  (void)info;
  FILE* in = NULL;
  for (int n = 0; n < count; ++n) {
    if (strncmp(words[n], "in=", 3) == 0) {
      in = fopen(words[n] + 3, "r");
    } else if (strncmp(words[n], "out=", 4) == 0) {
      out = fopen(words[n] + 4, "w");
    }
  }
  if (in == NULL || out == NULL) {
    qemu_plugin_outs("function_plugin: in=FILE,out=FILE\n");
    return -1;
  }
  char line[kMostWords];
  while (fgets(line, sizeof line, in) != NULL) {
    if (!read_line(line)) {
      qemu_plugin_outs("function_plugin: no such line: ");
      qemu_plugin_outs(line);
      return -1;
    }
  }
  fclose(in);
  qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
  qemu_plugin_register_atexit_cb(id, tell, NULL);
  return 0;
}
