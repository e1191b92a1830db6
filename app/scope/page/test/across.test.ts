// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {test} from 'node:test';
import {Vector3} from 'three';
import type {DozerMachine, Vector2} from '../src/model/api';
import {type AcrossState, design_line, dozerAcross, slope_of, tiltAngle} from '../src/model/dozer_across';
import {dozerPose} from '../src/model/dozer';
import {PlanTrack} from '../src/model/plan_track';
import {designHeight, fresh} from '../src/model/wanted';
import {DozerModel} from '../src/scene/dozer_model';
import {dozer_behind} from '../src/scene/figure';
import {cut, HeightField} from '../src/scene/height_field';
import {blade_walk} from '../src/scene/edges';
import {SharedMaterials} from '../src/scene/materials';
import {dozer_across_now} from '../src/scene/machine_state';
import {dozer_soil, soil_history} from '../src/scene/soil';
import {behind_span, behind_words, ground_behind, off_digits, tilts} from '../src/view/panels/behind_view';
import {DOZER_9T, EXCAVATOR_22T} from './machines';
import {type Run, run_of, store_of_run} from './runs';

const near = (a: number, b: number, tolerance: number, what: string): void =>
  assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a}, not ${b}`);

const TILT = {edge_width_m: 2.55, angle_most_rad: 0.16, base_m: [0.05, 0.5] as Vector2, eye_m: [0.7, 0.42] as Vector2};
const TILTING: DozerMachine = {...DOZER_9T, tilt: TILT, cross: [[-5, 0], [40, 0]]};
/// The stroke that gives a tilt, by the cosine rule anew.
function stroke_at(tilt_rad: number): number {
  const length = (angle: number): number => {
    const [y, z] = TILT.eye_m;
    return Math.hypot(y * Math.cos(angle) - z * Math.sin(angle) - TILT.base_m[0],
      y * Math.sin(angle) + z * Math.cos(angle) - TILT.base_m[1]);
  };
  return length(tilt_rad) - Math.min(length(TILT.angle_most_rad), length(-TILT.angle_most_rad));
}

/// With the blade level in the machine.
const HOME: AcrossState = {position_m: 5, height_m: -0.35, pitch_rad: 0, blade_stroke_m: 0.2, tilt_stroke_m: stroke_at(0),
  roll_rad: 0, offset_m: 0, heading_rad: 0};

test('a tilt\u2019s stroke is the angle that its pins have then', () => {
  for (const tilt_rad of [-0.16, -0.1, -0.01, 0, 0.03, 0.16]) {
    near(tiltAngle(TILT, stroke_at(tilt_rad)), tilt_rad, 1e-9, 'tilt');
  }
  near(Math.abs(tiltAngle(TILT, 9)), 0.16, 1e-9, 'beyond its end');
  // With the pins on the other side extension turns it the other way.
  const other = {...TILT, base_m: [-0.05, 0.5] as Vector2, eye_m: [-0.7, 0.42] as Vector2};
  near(tiltAngle(other, 0.03), -tiltAngle(TILT, 0.03), 1e-9, 'mirrored');
});

test('roll and tilt raise the left end, and the right one when negative', () => {
  const at = (tilt_rad: number, roll_rad: number) =>
    dozerAcross(TILTING, {...HOME, tilt_stroke_m: stroke_at(tilt_rad), roll_rad})!;
  const level = at(0, 0);
  near(level.left.at_m[1], level.right.at_m[1], 1e-9, 'level');
  near(level.left.at_m[0], -1.275, 1e-9, 'left is left');
  for (const [tilt, roll] of [[0.1, 0], [0, 0.1], [-0.1, 0], [0, -0.1], [0.08, -0.08]] as const) {
    const {left, right} = at(tilt, roll);
    near(slope_of([left.at_m, right.at_m]), Math.tan(tilt + roll), 2e-3, `tilt ${tilt}, roll ${roll}`);
  }
  // A roll moves the middle of a blade below the tracks to the side: its own longitudinal axis is in the body.
  const low = dozerAcross(TILTING, {...HOME, blade_stroke_m: 0.3, roll_rad: 0.1})!;
  assert.ok(low.middle.place_m[2] < -0.35 && low.middle.place_m[1] > 0, 'below, so to the left');
  assert.equal(dozerAcross(DOZER_9T, HOME), null, 'without a tilt');
  assert.equal(dozerAcross(TILTING, {...HOME, roll_rad: NaN}), null);
});

test('heights over the design are straight up, and none beside the grade', () => {
  const banked: DozerMachine = {...TILTING, cross: [[-5, 0.05], [40, 0.05]]};
  const {left, middle, right} = dozerAcross(banked, HOME)!;
  near(left.off_m - middle.off_m, -0.05 * 1.275, 1e-9, 'left');
  near(right.off_m - middle.off_m, 0.05 * 1.275, 1e-9, 'right');
  near(middle.off_m, middle.place_m[2] - designHeight(DOZER_9T.design, middle.place_m[0]), 1e-12, 'middle');
  const across = dozerAcross(banked, HOME)!;
  near(slope_of(design_line(across, 0)), 0.05, 1e-9, 'design');
  const [from, to] = design_line(across, 0.4);
  near(to[0] - from[0], 2.55 + 0.8, 1e-9, 'beyond both ends');
  near(slope_of([from, to]), 0.05, 1e-9, 'as straight there');
  for (const position_m of [-9, 40]) {
    assert.ok(Number.isNaN(dozerAcross(banked, {...HOME, position_m})!.left.off_m));
  }
});

test('a place beside a curved track is its station and offset', () => {
  const steps = Array.from({length: 401}, (_, i): Vector2 => [i * 0.05, 0.05]);
  const track = new PlanTrack(steps);
  // Of a circle of 20 m about the left: ahead of a body on it, as far to the right as its chord leaves it.
  const [station, offset] = track.place_of([5, 0], 0, [2.2, 0]);
  near(offset, 20 - Math.hypot(20, 2.2), 1e-4, 'offset');
  near(station, 5 + 20 * Math.atan(2.2 / 20), 1e-4, 'station');
  const [back, left] = track.place_of([5, 0.5], 0, [0, 1]);
  near(back, 5, 1e-9, 'beside');
  near(left, 1.5, 1e-9, 'left');
  const turned = track.place_of([5, 0], 0.1, [2, 0]);
  assert.ok(turned[1] > track.place_of([5, 0], 0, [2, 0])[1] + 0.19, 'turned to the left');
  near(track.place_of([-3, 0.2], 0, [1, 0])[1], 0.2, 1e-9, 'straight before it');
});

const DESIGNS = join(process.env.GRABEN_TOOL!, '../../../share/graben/designs');
const tilting_run = (...design: string[]): Run =>
  run_of('grade', '--profile', 'dozer_9t_tilt', '--datum', '54.3', '--design', ...design);
let made: readonly Run[] | undefined;
/// Of curves and of a straight track, banked to both sides by turns.
const runs = (): readonly Run[] => (made ??= [
  tilting_run(`${DESIGNS}/curved.xml`, '--alignment', 'way'),
  tilting_run(`${DESIGNS}/banked.xml`, '--track', '100,200,131,200')]);
const dozer_of = ({setup}: Run): DozerMachine => setup.machines[0] as DozerMachine;

test('both ends are off the design by what the controller says and the simulation knows', () => {
  for (const run of runs()) {
    const machine = dozer_of(run);
    const store = store_of_run(run);
    const {truth} = run.setup.run!;
    const worst = truth.lines.find(({plot, label}) => plot === 'error' && label === 'true')!.values;
    const off_truth: number[] = [];
    const off_told: number[] = [];
    let banked = 0;
    truth.time_s.forEach((time_s, k) => {
      const {across, stale} = dozer_across_now(machine, store, time_s);
      const told = 1e-3 * fresh(store, 'EcuGrade.CrossError', time_s);
      if (across === null || stale || !Number.isFinite(across.left.off_m) || !Number.isFinite(told) ||
          fresh(store, 'EcuStatus.Mode', time_s) !== 3) {
        return;
      }
      const [left, right] = [1e3 * across.left.off_m, 1e3 * across.right.off_m];
      off_truth.push(Math.abs(Math.max(Math.abs(left), Math.abs(right)) - Math.abs(worst[k]!)));
      off_told.push(Math.abs(left - right - 1e3 * told * TILT.edge_width_m));
      banked += Number(Math.abs(slope_of([across.left.at_m, across.right.at_m])) > 0.03);
    });
    const [truth_mm, told_mm] = [off_truth, off_told].map((list) => list.sort((a, b) => a - b));
    assert.ok(truth_mm!.length > 1000 && banked > 300, `${truth_mm!.length}, ${banked}`);
    const at = (list: number[], share: number): number => list[Math.floor(share * (list.length - 1))]!;
    console.log(`# ${machine.name}: truth ${at(truth_mm!, 0.5)} ${at(truth_mm!, 0.95)} ${at(truth_mm!, 1)}, ` +
      `told ${at(told_mm!, 0.5)} ${at(told_mm!, 0.95)} ${at(told_mm!, 1)} mm`);
    // The page has the last frame of each; the slope is told of where the body will be.
    assert.ok(at(truth_mm!, 0.5) < 0.3 && at(truth_mm!, 1) < 1.2 && at(told_mm!, 0.95) < 1);
  }
});

test('the ground is left as the tilted edge had it', () => {
  for (const run of runs()) {
    const machine = dozer_of(run);
    const store = store_of_run(run);
    const history = soil_history(dozer_soil(machine));
    assert.ok(history.advance(store, store.until_s, Infinity));
    // Where the edge is steepest.
    const slope_at = (time_s: number): number => {
      const {across} = dozer_across_now(machine, store, time_s);
      return across === null || Number.isNaN(across.left.off_m) ? 0 :
        Math.abs(slope_of([across.left.at_m, across.right.at_m]));
    };
    const now_s = run.setup.run!.truth.time_s.reduce((best, time_s) =>
      (slope_at(time_s) > slope_at(best) ? time_s : best));
    history.field.show(now_s, () => undefined);
    const {across} = dozer_across_now(machine, store, now_s);
    // On a curve the outermost cells below the edge itself are not passed yet.
    const ground = ground_behind(history.field, across!, [-1, 1]);
    const [a, b] = [across!.left.at_m, across!.right.at_m];
    assert.ok(Math.abs(slope_of([a, b])) > 0.02, `${slope_of([a, b])}`);
    for (const [u, z] of ground) {
      near(z, a[1] + (u - a[0]) / (b[0] - a[0]) * (b[1] - a[1]), 0.015, `${u}`);
    }
    // Beside its ends nobody was.
    const [[, aside]] = ground_behind(history.field, across!, [-1.9, -1.85]);
    near(aside, 0, 1e-9, 'aside');
    assert.ok(blade_walk(machine)(store, -1).next() >= 0);
  }
});

test('an edge with a slope cuts deeper at its lower end', () => {
  const field = new HeightField({x_m: 0, y_m: -2, cell_m: 0.1, columns: 41, rows: 41}, () => 0);
  const edge = {x_m: 1, y_m: 0, z_m: -0.2, heading_rad: 0, left_up: 0.1};
  cut(field, 0, edge, {...edge, x_m: 2}, 2);
  near(field.latest_at(1.5, 0.9), -0.11, 1e-6, 'left');
  near(field.latest_at(1.5, 0), -0.2, 1e-6, 'middle');
  near(field.latest_at(1.5, -0.9), -0.29, 1e-6, 'right');
  assert.equal(field.latest_at(1.5, 1.1), 0);
});

test('from behind the left is left, and what is high is up', () => {
  const rolled = dozerAcross(TILTING, {...HOME, roll_rad: 0.1, tilt_stroke_m: stroke_at(-0.1)})!;
  const shapes = dozer_behind(TILTING, rolled);
  assert.ok(shapes.length > 10);
  const points = shapes.flatMap(({outline}) => outline);
  // Rolled left up: what is at the left is higher than what is as far at the right.
  const lowest = (side: number): number => Math.min(...points.filter(([u]) => side * u > 0.7).map(([, z]) => z));
  assert.ok(lowest(-1) > lowest(1) + 0.1, `${lowest(-1)} ${lowest(1)}`);
  const span = behind_span(1.275, rolled);
  assert.ok(span.u[0] < -1.7 && span.u[1] > 1.7 && span.v[0] < rolled.middle.at_m[1] - 0.3);
  assert.ok(span.v[1] > rolled.body_m + 1.2);
  assert.deepEqual(behind_span(1, null).u.map((u) => Math.sign(u)), [-1, 1]);
});

test('in space the edge is where it is computed, from end to end', () => {
  const model = new DozerModel(TILTING, new SharedMaterials());
  for (const [roll_rad, tilt, pitch_rad] of [[0.1, 0, 0], [0, 0.12, 0.1], [-0.07, 0.05, -0.1]] as const) {
    const state = {...HOME, roll_rad, pitch_rad, tilt_stroke_m: stroke_at(tilt)};
    const across = dozerAcross(TILTING, state)!;
    model.pose(dozerPose(TILTING, state)!, across);
    model.node.updateMatrixWorld(true);
    for (const [end, side] of [['left', 1], ['middle', 0], ['right', -1]] as const) {
      const at = model.edge.parent!.localToWorld(
        model.edge.position.clone().add(new Vector3(0, side * 0.5 * TILT.edge_width_m, 0)));
      [at.x, at.y, at.z].forEach((value, i) => near(value, across[end].place_m[i]!, 1e-9, `${end} ${i}`));
    }
  }
});

test('only a machine whose blade tilts is shown from behind', () => {
  assert.deepEqual([null, DOZER_9T, EXCAVATOR_22T, TILTING].map(tilts), [false, false, false, true]);
});

const plain = (words: string): string => words.replace(/\u00a0/g, ' ');

test('words say which side is up and how far the ends are off', () => {
  assert.deepEqual([0.0124, -0.0031, 0.0002, NaN].map(off_digits).map(plain), ['+12 mm', '\u22123 mm', '0 mm', '\u2013']);
  const across = dozerAcross({...TILTING, cross: [[-5, 0.05], [40, 0.05]]},
    {...HOME, roll_rad: -0.02, tilt_stroke_m: stroke_at(0.05)})!;
  const {ends, slopes} = behind_words({across, stale: false});
  assert.ok(ends.startsWith(`Off the design: left ${off_digits(across.left.off_m)}, right `), ends);
  assert.equal(plain(slopes), 'Roll 1.1° right up, blade\u2019s tilt 2.9° left up, edge 3.0 % left up, design 5.0 % left up');
  assert.ok(behind_words({across, stale: true}).ends.endsWith('(old)'));
  assert.equal(behind_words({across: null, stale: true}).ends, 'Roll and tilt are not known');
  const off = dozerAcross(TILTING, {...HOME, position_m: 60})!;
  const beside = behind_words({across: off, stale: false});
  assert.equal(beside.ends, 'The edge is beside the grade');
  assert.equal(plain(beside.slopes), 'Roll 0.0°, blade\u2019s tilt 0.0°, edge 0.0 %');
});
