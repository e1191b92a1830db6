// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {ExcavatorMachine, Task} from '../src/model/api';
import type {SurfaceGrid} from '../src/model/surface_grid';
import {excavator_state} from '../src/scene/machine_state';
import {HeightField} from '../src/scene/height_field';
import {TaskChoice} from '../src/scene/shown_task';
import {assist_words} from '../src/operator/assist';
import {off_of} from '../src/operator/cut_fill';
import {e2e_crc} from '../src/model/integrity';
import {built_as, design_lines, design_of, of_surface} from '../src/operator/design';
import {EXCAVATOR_12T} from './machines';
import {line, store_of} from './make';
import {EXCAVATOR, id, SETUP, stroke} from './status';
import {graben_log} from './tool';

const near = (found: number, wanted: number, within = 1e-9): void =>
  assert.ok(Math.abs(found - wanted) <= within, `${found} is not ${wanted}`);

/// Heights of `z` over the machine's frame, on a grid that lies turned by `turn` about a place of it.
function grid_of(z: (x: number, y: number) => number | null, turn = 0, side = 80): SurfaceGrid {
  const [step_m, unit_m, base_m] = [0.25, 0.0005, -1];
  const middle = 0.5 * step_m * (side - 1);
  const heights: (number | null)[] = [];
  let before = 0;
  for (let row = 0; row < side; ++row) {
    for (let column = 0; column < side; ++column) {
      const [u, v] = [column * step_m - middle, row * step_m - middle];
      const height = z(Math.cos(turn) * u + Math.sin(turn) * v, Math.cos(turn) * v - Math.sin(turn) * u);
      const count = height === null ? null : Math.round((height - base_m) / unit_m);
      heights.push(count === null ? null : count - before);
      before = count ?? before;
    }
  }
  return {columns: side, rows: side, step_m, unit_m, base_m, machine_m: [middle, middle],
    heading_rad: turn, heights};
}

test('a surface has the height of each place, turned or not, and none beyond its border', () => {
  for (const turn of [0, 0.7, -2]) {
    const at = of_surface(grid_of((x, y) => -1 + 0.1 * x - 0.05 * y, turn));
    near(at(3, 2), -0.8, 0.0005);
    near(at(-4.13, 5.5), -1.688, 0.0005);
    assert.ok(Number.isNaN(at(15, 0)) && Number.isNaN(at(0, -15)), `turned by ${turn}`);
  }
  const hole = of_surface(grid_of((x) => (x > 4 && x < 5 ? null : 0)));
  near(hole(3, 0), 0);
  near(hole(6, 0), 0);
  assert.ok(Number.isNaN(hole(4.5, 0)) && Number.isNaN(hole(3.999, 0)), 'one of its four is none');
});

test('in the section it is a line for each stretch that has a height', () => {
  const at = of_surface(grid_of((x) => (x > 4 && x < 5 ? null : -0.2 * x)));
  const lines = design_lines(at, 0, [0, 8]);
  assert.equal(lines.length, 2);
  near(lines[0]![10]![1], -0.2 * lines[0]![10]![0], 0.0005);
  assert.ok(lines[1]![0]![0] >= 5 && lines[1]!.at(-1)![0] > 7.9);
});

const STEPLESS: Task = {name: 'site', steps: [], fences: [], design: null};

test('a plane is a design, a task without one has none', () => {
  const plane = design_of({...STEPLESS, design: {through_m: [5, 0, -1], up: [-0.1, 0, 1]}})!;
  near(plane(7, 3), -0.8);
  assert.equal(design_of(STEPLESS), null);
  assert.equal(design_of(null), null);
});

test('off a surface is told of the lowest part of the edge', () => {
  const store = store_of(graben_log('autodig'));
  const time_s = store.from_s + 5;
  const told = (z: (x: number, y: number) => number | null): number | undefined => {
    const machine: ExcavatorMachine = {...EXCAVATOR_12T, bucket_width_m: 1.2,
      tasks: [{...STEPLESS, surface: grid_of(z)}]};
    return off_of(machine, store, time_s, 0)?.off_m;
  };
  const {pose} = excavator_state(EXCAVATOR_12T, store, time_s);
  const [x, y, z] = pose!.position_m;
  near(told(() => -1)!, z + 1, 0.0006);
  // Across the edge it rises: its lower end counts, half of the width to one side.
  const aside = (px: number, py: number): number =>
    (py - y) * Math.cos(pose!.swing_rad) - (px - x) * Math.sin(pose!.swing_rad);
  near(told((px, py) => -1 + 0.5 * aside(px, py))!, z + 1 - 0.3, 0.002);
  near(told((px, py) => -1 - 0.5 * aside(px, py))!, z + 1 - 0.3, 0.002);
  assert.equal(told(() => null), undefined);
});

function protected_line(at_s: number, message: string, bytes: number[]): string {
  bytes[0] = e2e_crc(EXCAVATOR.messages.get(message)!.data_id!, new Uint8Array(bytes), 0);
  return line(at_s, id(message), bytes);
}

/// The operator asks for task 7, number 1; EcuMotion says this of Assist.
function frames(assist: number, task = 7, at_s = 1): string {
  return stroke(at_s) + protected_line(at_s, 'OperatorCommand', [0, 0xf0, 0x01, task, 0, 1, 0xff, 0xff]) +
    line(at_s, id('EcuMotion'), [0, 0, 0, 0, 0, 0, 0xf0 | assist, 0xff]);
}

test('what Assist does and waits for is said, and nothing of another task', () => {
  const said = [0, 1, 2, 3, 4, 5].map((state) => assist_words(store_of(frames(state)), 1));
  assert.equal(new Set(said).size, 6);
  assert.match(said[2]!, /once the arm's lever moves/);
  assert.match(said[3]!, /holds: boom and bucket/);
  assert.match(said[5]!, /beyond the border/);
  assert.equal(assist_words(store_of(frames(3, 4)), 1), null);
  assert.equal(assist_words(store_of(frames(3)), 9), null, 'what is old is not said');
  assert.equal(assist_words(store_of(frames(14)), 1), null);
});

test('the design of Assist is that of the task with its number', () => {
  const machine: ExcavatorMachine = {...EXCAVATOR_12T, tasks: [STEPLESS, STEPLESS]};
  assert.equal(new TaskChoice(machine, SETUP).at(store_of(frames(3)), 1), 1);
});

test('ground that was cut is told of, and how it stands to its design', () => {
  const field = new HeightField({x_m: 4, y_m: -1, cell_m: 0.5, columns: 5, rows: 5}, () => 0);
  field.lower(1, 7, -0.4);
  field.raise(1, 8, 0.4);
  field.show(2, () => undefined);
  const made: number[][] = [];
  field.each_cut((...at) => made.push(at));
  assert.equal(made.length, 1);
  assert.deepEqual(made[0]!.slice(0, 2), [5, -0.5]);
  near(made[0]![2]!, -0.4, 1e-6);
  assert.deepEqual([0.031, 0.029, -0.029, -0.031].map(built_as), ['over', 'on', 'on', 'under']);
});
