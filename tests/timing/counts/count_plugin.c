// SPDX-License-Identifier: Apache-2.0
// QEMU plugin: guest instructions executed from the entry of graben_count_begin to the entry of
// graben_count_end, a line for each such section in the file that its argument out=FILE names.
//
//   qemu-x86_64 -plugin libcount_plugin.so,out=FILE program
//
// Debian's QEMU 7.2 exports the plugin interface and ships no header for it. What is used of it is
// declared here, as version 1 of the interface has it.

#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info_t;
enum { QEMU_PLUGIN_CB_NO_REGS = 0 };
enum { QEMU_PLUGIN_INLINE_ADD_U64 = 0 };
typedef void (*tb_trans_cb)(qemu_plugin_id_t, struct qemu_plugin_tb*);
typedef void (*exec_cb)(unsigned cpu, void* data);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, tb_trans_cb);
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb*, int op, void* at,
                                              uint64_t value);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn*, exec_cb, int flags,
                                            void* data);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t index);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn*);
void qemu_plugin_outs(const char*);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;
__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t,
                                                               const struct qemu_info_t*, int,
                                                               char**);

static FILE* sections;
static uint64_t executed;
static uint64_t at_begin;

static void begin(unsigned cpu, void* data) {
  (void)cpu;
  (void)data;
  at_begin = executed;
}

static void end(unsigned cpu, void* data) {
  (void)cpu;
  (void)data;
  fprintf(sections, "%" PRIu64 "\n", executed - at_begin);
}

// Blocks are counted as a whole when they begin: a block is left early only by an exception of the
// guest, and there is none within a section. Both markers are one block each, so what is counted of
// them is the same every time.
static void translate(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  (void)id;
  struct qemu_plugin_insn* const first = qemu_plugin_tb_get_insn(block, 0);
  qemu_plugin_register_vcpu_tb_exec_inline(block, QEMU_PLUGIN_INLINE_ADD_U64, &executed,
                                           qemu_plugin_tb_n_insns(block));
  const char* const symbol = qemu_plugin_insn_symbol(first);
  if (symbol == NULL) {
    return;
  }
  if (strcmp(symbol, "graben_count_begin") == 0) {
    qemu_plugin_register_vcpu_insn_exec_cb(first, begin, QEMU_PLUGIN_CB_NO_REGS, NULL);
  } else if (strcmp(symbol, "graben_count_end") == 0) {
    qemu_plugin_register_vcpu_insn_exec_cb(first, end, QEMU_PLUGIN_CB_NO_REGS, NULL);
  }
}

int qemu_plugin_install(qemu_plugin_id_t id, const struct qemu_info_t* info, int count,
                        char** words) {
  (void)info;
  if (count != 1 || strncmp(words[0], "out=", 4) != 0) {
    qemu_plugin_outs("count_plugin: one argument, out=FILE\n");
    return -1;
  }
  sections = fopen(words[0] + 4, "w");
  if (sections == NULL) {
    qemu_plugin_outs("count_plugin: the file does not open\n");
    return -1;
  }
  // QEMU may end without closing it.
  setvbuf(sections, NULL, _IOLBF, 0);
  qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
  return 0;
}
