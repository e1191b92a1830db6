// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {greatest_of} from '../src/view/plots/greatest';

const curve = (values: readonly number[]) =>
  ({time_s: Float64Array.from(values, (_, k) => k), value: Float64Array.from(values)});
const at = (values: readonly number[], window: readonly [number, number] = [0, 99]) =>
  greatest_of(curve(values), window, 50);

test('the worst error is found in the window, whatever its sign, and not on the way to the path', () => {
  assert.deepEqual(at([1, 2, -9, 3]), {time_s: 2, value: -9});
  // The way there falls all the time; then the path's own.
  assert.deepEqual(at([300, 200, 100, 40, 20, 5, 4, 6, 12, 7]), {time_s: 8, value: 12});
  assert.deepEqual(at([300, 100, 10, 12, 80, 20]), {time_s: 4, value: 80}, 'off again');
  assert.deepEqual(at([1, 9, 3, 5, 4], [2, 4]), {time_s: 3, value: 5});
  assert.deepEqual(at([300, 250, 200]), {time_s: 0, value: 300}, 'never there');
  assert.deepEqual(at([NaN, 1, NaN, 2, 1]), {time_s: 3, value: 2});
  assert.equal(at([NaN]), null);
  assert.equal(at([1, 2], [5, 6]), null);
});
