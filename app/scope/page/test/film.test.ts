// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import type {SceneFrame} from '../src/view/page/scene_frame';
import {offer_film} from '../src/view/page/film';
import {page, status, stroke} from './status';

test('a moment of a film is shown when all is drawn, with the soil of a long log in it', async () => {
  let frames = 0;
  Object.assign(globalThis, {window: {}, requestAnimationFrame: (then: () => void) => setTimeout(() => {
    ++frames;
    then();
  })});
  const state = page(stroke(0) + status(0, 3, 0, 0, 1) + status(10, 3, 0, 0, 1));
  let drawn = 0;
  const scene = {settled: () => frames >= 40} as unknown as SceneFrame;
  offer_film(state, scene, () => ++drawn);
  const film = (globalThis as unknown as {window: Window}).window.grabenFilm!;
  assert.equal(film.state(), 'ready');
  await film.show(4);
  assert.equal(state.playhead.now_s, 4);
  assert.equal(drawn, 1);
  assert.ok(frames >= 40 && frames <= 41, `after ${frames} frames`);
});
