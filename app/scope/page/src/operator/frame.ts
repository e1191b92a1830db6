// SPDX-License-Identifier: Apache-2.0
/// What both pictures of the operator's view draw at one moment, found once.

import type {DozerMachine, ExcavatorMachine, Machine} from '../model/api';
import {dozer_soil, excavator_soil, soil_history} from '../scene/soil';
import {dozer_state, excavator_state} from '../scene/machine_state';
import type {HeightField} from '../scene/height_field';
import {type ShownTask, TaskChoice} from '../scene/shown_task';
import type {TerrainHistory} from '../scene/terrain_history';
import {type SceneColours, scene_colours} from '../scene/theme';
import {assist_of} from './assist';
import type {PageState} from '../view/basics/page_state';

export type MachineNow =
  | {kind: 'excavator'; machine: ExcavatorMachine; at: ReturnType<typeof excavator_state>}
  | {kind: 'dozer'; machine: DozerMachine; at: ReturnType<typeof dozer_state>};

export interface Frame {
  now: MachineNow;
  task: ShownTask;
  assists: boolean;  ///< Task Assist follows that task's design.
  ground: HeightField;
  colours: SceneColours;
  old: boolean;  ///< The edge is not where it is drawn any more.
}

/// Of a picture's time, for frames that the soil has not seen yet.
const BUDGET_MS = 4;

export class FrameMaker {
  private machine: Machine | null = null;
  private setup: PageState['setup'] = null;
  private choice: TaskChoice | null = null;
  private history: TerrainHistory | null = null;

  /// Null while nobody knows the machine.
  at(state: PageState, dark: boolean): Frame | null {
    const {machine, setup, store, playhead: {now_s}} = state;
    if (machine === null || setup === null || store.database?.kind !== machine.kind) {
      return null;
    }
    if (machine !== this.machine || setup !== this.setup || this.history?.outlived(store) !== false) {
      this.machine = machine;
      this.setup = setup;
      this.history = soil_history(machine.kind === 'dozer' ? dozer_soil(machine)
        : excavator_soil(machine, () => undefined));
      this.choice = machine.kind === 'excavator' ? new TaskChoice(machine, setup) : null;
    }
    this.history!.advance(store, now_s, BUDGET_MS);
    this.history!.field.show(now_s, () => undefined);
    const now: MachineNow = machine.kind === 'dozer'
      ? {kind: 'dozer', machine, at: dozer_state(machine, store, now_s)}
      : {kind: 'excavator', machine, at: excavator_state(machine, store, now_s)};
    return {
      now, assists: assist_of(store, now_s) !== null,
      task: this.choice?.at(store, now_s) ?? 'none', ground: this.history!.field,
      colours: scene_colours(dark),
      old: state.is_gone || (now.kind === 'dozer' ? now.at.stale.blade : now.at.stale.bucket)};
  }
}
