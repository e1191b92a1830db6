// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {fake_document} from './dom';
import {bytes_of} from './make';
import {page, status, stroke} from './status';
import {CandumpParser} from '../src/model/candump';
import {bookmarks_of} from '../src/model/moment';
import {Moments} from '../src/view/panels/moments';

fake_document();

/// An address bar; `given` is what it has when the page is opened.
function address(given: string): {hash: string} {
  const location = {hash: given};
  Object.assign(globalThis, {
    location, addEventListener: () => undefined,
    history: {replaceState: (_state: unknown, _title: string, hash: string) => {
      location.hash = hash;
    }}});
  return location;
}

const LOG = stroke(0) + status(0, 3, 0, 0, 1) + status(10, 3, 0, 0, 1);

test("what the page itself has written into its address leads nobody away from where he looks", () => {
  const bar = address('');
  const state = page(LOG);
  const moments = new Moments(state);
  state.playhead.seek(5);
  moments.update(state);
  assert.equal(bar.hash, '#t=5');
  // The key comes before the next picture.
  state.playhead.seek(state.extent.from_s);
  moments.opens(state);
  assert.equal(state.playhead.now_s, 0);
  // So it is where the server comes back with a new setup.
  state.playhead.seek(7);
  state.setup = {...state.setup!};
  moments.opens(state);
  assert.equal(state.playhead.now_s, 7);
});

test('an address that was given is followed once, when all is there', () => {
  const bar = address('#t=4');
  const state = page(LOG);
  const moments = new Moments(state);
  state.loaded_share = 0.5;
  assert.ok(moments.opens(state));
  moments.update(state);
  assert.deepEqual([state.playhead.now_s, bar.hash], [10, '#t=4'], 'not yet, and it is kept');
  state.loaded_share = 1;
  assert.ok(moments.opens(state));
  assert.equal(state.playhead.now_s, 4);
  state.playhead.seek(2);
  assert.ok(moments.opens(state), 'nothing else opens it');
  assert.equal(state.playhead.now_s, 2);
});

test('a live run is followed to a moment only once its past has come', () => {
  const bar = address('#t=8&o=0');
  const state = page(stroke(0) + status(0, 3, 0, 0, 1) + status(3, 3, 0, 0, 1));
  state.setup = {...state.setup!, source: {...state.setup!.source, mode: 'sim'}};
  state.link = {state: 'open', words: ''};
  state.playhead.follow = true;
  const moments = new Moments(state);
  assert.ok(moments.opens(state));
  moments.update(state);
  assert.deepEqual([state.playhead.follow, bar.hash], [true, '#t=8&o=0'], 'its past is not there');
  const parser = new CandumpParser();
  parser.feed(bytes_of(status(9, 3, 0, 0, 1)));
  parser.end();
  state.onFrames({...parser.take(), restart: false}, 0);
  assert.ok(moments.opens(state));
  moments.update(state);
  assert.deepEqual([state.playhead.now_s, state.playhead.follow], [8, false]);
  assert.match(bar.hash, /^#t=8&w=[^&]*&o=0$/);
});

test("an address's seconds are counted from the frame that it names", () => {
  const bar = address('#t=8&o=-4&b=5 here');
  const state = page(LOG);
  const moments = new Moments(state);
  moments.opens(state);
  assert.equal(state.playhead.now_s, 4);
  moments.mark();
  assert.deepEqual(bookmarks_of(bar.hash).map(({time_s}) => time_s), [1, 4]);
});
