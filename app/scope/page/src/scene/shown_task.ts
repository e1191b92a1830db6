// SPDX-License-Identifier: Apache-2.0
/// Which of its tasks an excavator is at, so that no other's path is in the picture.

import type {ExcavatorMachine, FrameStore, Setup} from '../model/api';

/// 'dig': the digging path. A number: that one of `tasks`. 'none': the machine has neither.
export type ShownTask = 'dig' | 'none' | number;

/// By the number that OperatorCommand.Task has.
const kDig = 1;
const kProgram = 3;
export const kAssist = 7;
/// A stopped operator asks for nothing: what was asked for before is searched this often.
const kProbes = 64;

export class TaskChoice {
  private last: ShownTask | null = null;
  private probed_revision = -1;

  constructor(private readonly machine: ExcavatorMachine, private readonly setup: Setup) {}

  /// What the operator asks for; between tasks the last one, before the first the next.
  at(store: FrameStore, now_s: number): ShownTask {
    const asked = this.asked(store, now_s);
    if (asked !== null) {
      this.last = asked;
      return asked;
    }
    return this.last ?? this.probe(store) ?? this.usual();
  }

  private asked(store: FrameStore, time_s: number): ShownTask | null {
    if (store.database === null) {
      return null;
    }
    const task = store.reading('OperatorCommand.Task', time_s);
    if (task.state !== 'valid') {
      return null;
    }
    if (task.value === kDig) {
      return 'dig';
    }
    const number = store.reading('OperatorCommand.TaskNumber', time_s);
    // Assist follows the design of the task with that number.
    return (task.value === kProgram || task.value === kAssist) && number.state === 'valid' &&
      this.machine.tasks[number.value] ? number.value : null;
  }

  private probe(store: FrameStore): ShownTask | null {
    if (this.probed_revision === store.revision) {
      return null;
    }
    this.probed_revision = store.revision;
    const span = store.until_s - store.from_s;
    for (let i = 0; i <= kProbes && this.last === null; ++i) {
      this.last = this.asked(store, store.from_s + span * i / kProbes);
    }
    return this.last;
  }

  private usual(): ShownTask {
    const program = this.setup.sim?.task === 'autodig' || this.setup.source.mode === 'plan';
    if (program && this.machine.tasks.length > 0) {
      return 0;
    }
    return this.machine.dig.path.length > 0 ? 'dig' : 'none';
  }
}
