// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {PagePlayhead} from '../src/model/playhead';

function live(from_s = 0, until_s = 100) {
  const extent = {from_s, until_s};
  const head = new PagePlayhead(extent, true);
  head.frames_came();
  return {extent, head};
}

function log(from_s = 100, until_s = 160) {
  const extent = {from_s, until_s};
  const head = new PagePlayhead(extent, false);
  head.frames_came();
  return {extent, head};
}

test('live it stays at the newest frame, with the last 30 s', () => {
  const {extent, head} = live();
  assert.deepEqual([head.now_s, ...head.window], [100, 70, 100]);
  extent.until_s = 101;
  head.frames_came();
  assert.deepEqual([head.now_s, ...head.window], [101, 71, 101]);
});

test('on a silent bus time goes on, where it is told to', () => {
  const {extent, head} = live();
  for (let i = 0; i < 100; ++i) {
    head.tick(0.02);
  }
  assert.equal(head.now_s, 100);
  head.clock_rate = 1;
  head.tick(0.2);
  assert.equal(head.now_s, 100);  // frames come in batches
  head.tick(0);
  head.follow = false;
  head.follow = true;
  assert.equal(head.now_s, 100);
  for (let i = 0; i < 40; ++i) {
    head.tick(0.02);
  }
  head.tick(0);
  assert.ok(Math.abs(head.now_s - 101) < 1e-9);
  extent.until_s = 100.5;
  head.frames_came();
  assert.equal(head.now_s, 100.5);
});

test("the page's own lateness is no silence of the bus", () => {
  const {extent, head} = live();
  head.clock_rate = 1;
  head.tick(5);  // hidden, or drawing: what came meanwhile is looked at after this
  assert.equal(head.now_s, 100);
  extent.until_s = 105;
  head.frames_came();
  head.tick(0.02);
  assert.equal(head.now_s, 105);
  // Nothing came for two of its frames: that is silence, however slow the page is.
  head.tick(1);
  head.tick(1);
  assert.ok(head.now_s > 105.9);
});

test('to seek is to stop following; the window stays while it holds the time', () => {
  const {extent, head} = live();
  head.seek(85);
  assert.deepEqual([head.now_s, head.follow, ...head.window], [85, false, 70, 100]);
  extent.until_s = 120;
  head.frames_came();
  assert.deepEqual([head.now_s, ...head.window], [85, 70, 100]);
  head.seek(10);
  assert.equal(head.now_s, 10);
  assert.ok(head.window[0] <= 10 && head.window[1] >= 10);
  assert.equal(head.window[1] - head.window[0], 30);
  head.follow = true;
  assert.deepEqual([head.now_s, ...head.window], [120, 90, 120]);
});

test('to seek is clamped to what there is, and moves with what is forgotten', () => {
  const {extent, head} = live();
  head.seek(-5);
  assert.equal(head.now_s, 0);
  head.seek(1e9);
  assert.equal(head.now_s, 100);
  head.seek(NaN);
  assert.equal(head.now_s, 100);
  head.seek(3);
  extent.from_s = 20;
  head.frames_came();
  assert.equal(head.now_s, 20);
});

test('of a log all is shown, as it grows', () => {
  const {extent, head} = log();
  assert.deepEqual([head.now_s, ...head.window], [100, 100, 160]);
  extent.until_s = 400;
  head.frames_came();
  assert.deepEqual([head.now_s, ...head.window], [100, 100, 400]);
});

test('it plays at its rate, stops at the end, and begins anew from there', () => {
  const {head} = log();
  head.rate = 4;
  head.playing = true;
  head.tick(2);
  assert.equal(head.now_s, 108);
  head.tick(100);
  assert.deepEqual([head.now_s, head.playing], [160, false]);
  head.playing = true;
  assert.equal(head.now_s, 100);
  head.rate = -1;
  assert.equal(head.rate, 4);
});

test('a zoom stays inside, keeps its width, and turns pages while it plays', () => {
  const {head} = log();
  head.window = [150, 170];
  assert.deepEqual([...head.window], [140, 160]);
  head.window = [110, 120];
  head.seek(119);
  assert.deepEqual([...head.window], [110, 120]);
  head.playing = true;
  head.tick(2);
  assert.deepEqual([head.now_s, ...head.window], [121, 120, 130]);
  head.seek(150);
  assert.deepEqual([...head.window], [145, 155]);
  head.window = [12, 11];
  assert.deepEqual([...head.window], [145, 155]);
  head.window = [115, 115];
  assert.ok(head.window[1] > head.window[0]);
});

test('a zoom as wide as all there is, is all there is, and grows with it', () => {
  const {extent, head} = log();
  head.window = [110, 120];
  head.window = [90, 500];
  extent.until_s = 200;
  head.frames_came();
  assert.deepEqual([...head.window], [100, 200]);
  const empty = new PagePlayhead({from_s: 0, until_s: 0}, true);
  empty.follow = false;
  empty.window = [0, 0];
  assert.ok(empty.window[1] > empty.window[0]);
});

test('listeners hear of every change', () => {
  const {head} = log();
  let heard = 0;
  head.on_change(() => ++heard);
  head.seek(120);
  head.playing = true;
  head.tick(0.1);
  head.rate = 2;
  head.window = [110, 130];
  assert.equal(heard, 5);
  head.playing = true;
  assert.equal(heard, 5);
});
