// SPDX-License-Identifier: Apache-2.0
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {gzipSync} from 'node:zlib';
import {Intake, type Connect} from '../src/feed/intake';
import type {Order, Posted, Told} from '../src/feed/orders';
import {make_reader, type AnyWorker} from '../src/feed/reader';
import {ServerSocket} from '../src/feed/socket';
import {SteeringSocket} from '../src/feed/steering_socket';
import {PageStore} from '../src/model/store';
import {bytes_of, line, protected_bytes} from './make';

const steer: Connect = (url, batches, hear) => new SteeringSocket(url, batches, hear);
const BOOM = 0x0cff2080;
const boom_lines = (from: number, count: number): string => Array.from({length: count}, (_, i) =>
  line(0.01 * (from + i), BOOM, protected_bytes(65312, (from + i) % 15, from + i))).join('');

/// What was told, and a wait for a told thing.
class Ear {
  readonly told: Told[] = [];
  readonly store = new PageStore();
  private waiting: {kind: (told: Told) => boolean; done: () => void}[] = [];

  readonly hear = (told: Told): void => {
    this.told.push(told);
    if (told.told === 'block') {
      this.store.append(told.block);
    }
    this.waiting = this.waiting.filter(({kind, done}) => !kind(told) || done());
  };

  next(kind: (told: Told) => boolean): Promise<void> {
    return new Promise((done) => this.waiting.push({kind, done}));
  }

  of<T extends Told['told']>(kind: T): Extract<Told, {told: T}>[] {
    return this.told.filter((told) => told.told === kind) as Extract<Told, {told: T}>[];
  }
}

const is_end = (told: Told): boolean => told.told === 'message' && told.message.kind === 'end';
const is_closed = (told: Told): boolean => told.told === 'closed';

test('a file, packed or not, and the log in a page', async () => {
  const text = boom_lines(0, 40000) + 'rubbish\n';
  const packed = gzipSync(text);
  const orders: Order[] = [
    {order: 'file', file: new Blob([text])},
    {order: 'file', file: new Blob([packed])},
    {order: 'packed', base64: packed.toString('base64')},
  ];
  for (const order of orders) {
    const ear = new Ear();
    new Intake(ear.hear, steer).obey(order);
    await ear.next(is_end);
    assert.equal(ear.store.frames, 40000);
    assert.equal(ear.store.health.malformed, 1);
    assert.equal(ear.of('block').filter(({block}) => block.restart).length, 1);
    const last = ear.of('block').pop()!;
    assert.equal(last.text_bytes, text.length);
  }
});

test('a log that is cut off or no log says so, with what there was', async () => {
  const packed = gzipSync(boom_lines(0, 30000));
  const bad: Order[] = [
    {order: 'packed', base64: packed.subarray(0, packed.length - 2000).toString('base64')},
    {order: 'packed', base64: '!!!!'},
    {order: 'file', file: new Blob([Uint8Array.of(0x1f, 0x8b, 1, 2, 3)])},
  ];
  for (const order of bad) {
    const ear = new Ear();
    new Intake(ear.hear, steer).obey(order);
    await ear.next(is_closed);
    const [{why, again_s}] = ear.of('closed');
    assert.match(why, /could not be read to its end: ./);
    assert.equal(again_s, null);
  }
});

test('a second file takes the place of the first', async () => {
  const ear = new Ear();
  const intake = new Intake(ear.hear, steer);
  intake.obey({order: 'file', file: new Blob([boom_lines(0, 100000)])});
  intake.obey({order: 'file', file: new Blob([boom_lines(500, 20)])});
  await ear.next(is_end);
  assert.equal(ear.store.frames, 20);
  assert.equal(ear.of('message').length, 1);
  intake.obey({order: 'send', text: '{}'});
  const {message} = ear.of('message').pop()!;
  assert.deepEqual(message.kind, 'refused');
});

/// A WebSocket whose other end is the test.
class FakeSocket {
  static readonly OPEN = 1;
  static all: FakeSocket[] = [];
  binaryType = '';
  readyState = 0;
  sent: string[] = [];
  onopen?: () => void;
  onmessage?: (event: {data: unknown}) => void;
  onclose?: (event: {reason: string}) => void;

  constructor(readonly url: string, readonly protocol: string) {
    FakeSocket.all.push(this);
  }

  send(text: string): void { this.sent.push(text); }
  close(): void { this.drop(''); }

  open(): void {
    this.readyState = 1;
    this.onopen?.();
  }

  say(message: unknown): void { this.onmessage?.({data: JSON.stringify(message)}); }
  frames(text: string): void { this.onmessage?.({data: bytes_of(text).buffer}); }

  drop(reason: string): void {
    this.readyState = 3;
    this.onclose?.({reason});
  }
}

async function connected(
  setup: object, run: (ear: Ear, intake: Intake) => Promise<void>, connect = steer) {
  const scope = globalThis as {WebSocket?: unknown};
  const before = scope.WebSocket;
  scope.WebSocket = FakeSocket;
  FakeSocket.all = [];
  const ear = new Ear();
  const intake = new Intake(ear.hear, connect);
  try {
    intake.obey({order: 'socket', url: 'ws://127.0.0.1:1/frames'});
    FakeSocket.all[0].open();
    FakeSocket.all[0].say(setup);
    await run(ear, intake);
  } finally {
    intake.obey({order: 'file', file: new Blob([])});  // no connection is left to be tried again
    scope.WebSocket = before;
  }
}

const live = {kind: 'setup', source: {mode: 'can', name: 'vcan0', bitrate: 500000}, machines: [],
  words: {fault: {}, why_not_armed: []}};
const log = {...live, source: {...live.source, mode: 'log', get: '/log'}};
const is_block = (told: Told): boolean => told.told === 'block';

async function reconnected(ear: Ear, setup: object): Promise<FakeSocket> {
  const before = FakeSocket.all.length;
  FakeSocket.all[before - 1].drop('');
  while (FakeSocket.all.length === before) {
    await new Promise((done) => setTimeout(done, 20));
  }
  const socket = FakeSocket.all[before];
  socket.open();
  socket.say(setup);
  assert.equal(ear.of('opened').length, before + 1);
  return socket;
}

test('a page that only looks has its own protocol, and no way to say a word', async () => {
  await connected(live, async (ear, intake) => {
    const [socket] = FakeSocket.all;
    assert.equal(socket.protocol, 'graben-look');
    socket.frames(boom_lines(0, 10));
    await ear.next(is_block);
    assert.equal(ear.store.frames, 10);
    intake.obey({order: 'send', text: '{"do":"run"}'});
    assert.deepEqual(socket.sent, []);
    assert.equal(ear.of('message')[0].message.kind, 'refused');
  }, (url, batches, hear) => new ServerSocket(url, batches, hear));
});

test('a live bus: batches, messages, and what the server kept after a lost connection', async () => {
  await connected(live, async (ear, intake) => {
    const [socket] = FakeSocket.all;
    assert.equal(socket.protocol, 'graben-scope');
    assert.equal(socket.binaryType, 'arraybuffer');
    assert.equal(ear.of('setup')[0].setup.source.name, 'vcan0');
    for (let i = 0; i < 50; ++i) {
      socket.frames(boom_lines(10 * i, 10));
    }
    socket.say({kind: 'dropped', frames: 3});
    socket.say({kind: 'no such kind'});
    await ear.next(is_block);
    assert.equal(ear.of('block').length, 1, 'one block of all that came together');
    assert.equal(ear.store.frames, 500);
    assert.deepEqual(ear.of('message').map(({message}) => message), [{kind: 'dropped', frames: 3}]);
    intake.obey({order: 'send', text: '{"do":"run"}'});
    assert.deepEqual(socket.sent, ['{"do":"run"}']);
    socket.frames('(0000000005.000000) vcan0 0CFF20');
    const again = await reconnected(ear, live);
    assert.deepEqual(ear.of('closed')[0],
      {told: 'closed', why: 'the server does not answer', again_s: 1});
    // All that the server has kept comes again, and what came meanwhile with it: none is twice there.
    again.frames(boom_lines(100, 510));
    await ear.next(is_block);
    assert.equal(ear.store.frames, 510);
    assert.ok(Math.abs(ear.store.until_s - ear.store.from_s - 5.09) < 0.02);
    assert.equal(ear.store.health.malformed, 0);
    assert.equal(ear.of('setup').length, 1, 'the same setup again says nothing new');
  });
});

/// A server whose file is `text`, cut short the first time.
function serve_file(text: string): {asked: string[]; end: () => void} {
  const asked: string[] = [];
  const before = globalThis.fetch;
  globalThis.fetch = async (url) => {
    asked.push(String(url));
    const whole = new TextEncoder().encode(text);
    return new Response(new ReadableStream({
      start(control) {
        control.enqueue(whole.subarray(0, asked.length === 1 ? 5000 : undefined));
        if (asked.length > 1) control.close();
      },
    }));
  };
  return {asked, end: () => {
    globalThis.fetch = before;
  }};
}

test('a log is a file, got from its beginning again, and at its end that is all', async () => {
  const file = serve_file(`${boom_lines(0, 300)}(0000000009.000000) vcan0 0CFF2080#00`);
  await connected(log, async (ear) => {
    await ear.next(is_block);
    assert.ok(ear.store.frames > 50 && ear.store.frames < 200, `${ear.store.frames}`);
    const again = await reconnected(ear, log);
    await ear.next(is_end);
    assert.equal(ear.store.frames, 301);
    assert.deepEqual(file.asked, ['http://127.0.0.1:1/log', 'http://127.0.0.1:1/log']);
    again.drop('over');
    assert.deepEqual(ear.of('closed')[1], {told: 'closed', why: 'over', again_s: null});
  }).finally(file.end);
});

test('a log that the server does not give is said', async () => {
  const before = globalThis.fetch;
  globalThis.fetch = async () => new Response('', {status: 404});
  await connected(log, async (ear) => {
    await ear.next(is_closed);
    assert.deepEqual(ear.of('closed')[0], {told: 'closed', again_s: null,
      why: 'the log could not be read to its end: the server answers 404'});
  }).finally(() => {
    globalThis.fetch = before;
  });
});

test('another setup after a reconnect begins anew', async () => {
  await connected(live, async (ear) => {
    FakeSocket.all[0].frames(boom_lines(0, 100));
    await ear.next(is_block);
    const other = {...live, source: {...live.source, name: 'vcan1'}};
    const again = await reconnected(ear, other);
    again.frames(boom_lines(700, 5));
    await ear.next(is_block);
    assert.equal(ear.store.frames, 5);
    assert.equal(ear.of('setup')[1].setup.source.name, 'vcan1');
  });
});

class FakeWorker implements AnyWorker {
  onmessage: AnyWorker['onmessage'] = null;
  onerror: AnyWorker['onerror'] = null;
  orders: Order[] = [];
  ended = false;
  postMessage(order: Order): void { this.orders.push(order); }
  terminate(): void { this.ended = true; }
}

test('where no worker can be made, the page reads by itself', async () => {
  const ear = new Ear();
  const reader = make_reader(() => { throw new Error('not from a file'); }, steer, ear.hear);
  reader.obey({order: 'file', file: new Blob([boom_lines(0, 30)])});
  await ear.next(is_end);
  assert.equal(ear.store.frames, 30);
});

test('a worker that fails before it is ready is replaced; later it is said', async () => {
  const ear = new Ear();
  const worker = new FakeWorker();
  const reader = make_reader(() => worker, steer, ear.hear);
  reader.obey({order: 'file', file: new Blob([boom_lines(0, 30)])});
  assert.equal(worker.orders.length, 1);
  worker.onerror?.({message: 'blocked', preventDefault: () => undefined} as ErrorEvent);
  await ear.next(is_end);
  assert.equal(ear.store.frames, 30);
  assert.ok(worker.ended);

  const other = new Ear();
  const ready = new FakeWorker();
  make_reader(() => ready, steer, other.hear);
  ready.onmessage?.({data: {told: {told: 'ready'}, source: 0}} as MessageEvent<Posted>);
  ready.onerror?.({message: 'out of memory', preventDefault: () => undefined} as ErrorEvent);
  assert.match(other.of('closed')[0].why, /out of memory/);
});

test('what an older source still had on its way is not heard', async () => {
  const posted: Posted[] = [];
  const ear = new Ear();
  const worker = new FakeWorker();
  const intake = new Intake((told, _, source) => void posted.push({told, source}), steer);
  const reader = make_reader(() => worker, steer, ear.hear);
  const deliver = () => posted.splice(0).forEach((data) =>
    worker.onmessage?.({data} as MessageEvent<Posted>));
  const read = async (text: string): Promise<void> => {
    reader.obey({order: 'file', file: new Blob([text])});
    intake.obey(worker.orders.pop()!);
    while (!posted.some(({told}) => is_end(told))) {
      await new Promise((done) => setTimeout(done, 5));
    }
  };
  await read(boom_lines(0, 30));
  const late = posted.splice(0);
  await read(boom_lines(500, 20));
  posted.unshift(...late);
  deliver();
  assert.equal(ear.of('message').length, 1);
  assert.deepEqual(ear.of('block').map(({block}) => block.columns[0]?.time_s[0]), [5]);
  assert.equal(ear.store.frames, 20);
});
