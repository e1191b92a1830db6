// SPDX-License-Identifier: Apache-2.0
/// `graben export --mcap`, read by the reader of MCAP's own authors and compared with the log, line by
/// line, by the DBC.
///   check_mcap.mjs GRABEN FOLDER DBC_FOLDER

import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {open} from 'node:fs/promises';
import {join} from 'node:path';
import {McapIndexedReader, McapStreamReader} from '@mcap/core';

const [graben, out, dbc_folder] = process.argv.slice(2);

function run(words, status = 0) {
  const done = spawnSync(graben, words, {cwd: out, encoding: 'utf8'});
  assert.equal(done.status, status, `${words.join(' ')}: ${done.stdout}${done.stderr}`);
  return done.stdout + done.stderr;
}

const readable = async (file) => {
  const handle = await open(file, 'r');
  return {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await handle.read(bytes, 0, Number(length), Number(offset));
      return bytes;
    },
    close: () => handle.close(),
  };
};

/// Messages of a DBC: name by id, and of each signal place, scale and range.
function read_dbc(file) {
  const messages = new Map();
  let last;
  for (const line of readFileSync(file, 'utf8').split('\n')) {
    const message = /^BO_ (\d+) (\w+): 8 (\w+)/.exec(line);
    const signal = /^ SG_ (\w+) : (\d+)\|(\d+)@1\+ \(([^,]+),([^)]+)\) \[([^|]+)\|([^\]]+)\] "([^"]*)"/.exec(line);
    if (message) {
      last = {name: message[2], sender: message[3], signals: new Map()};
      messages.set(Number(message[1]) & 0x1fffffff, last);
    } else if (signal) {
      const [start, width, factor, offset, min, max] = signal.slice(2, 8).map(Number);
      last.signals.set(signal[1], {start, width, factor, offset, min, max, unit: signal[8]});
    }
  }
  return messages;
}

/// From the DBC's unit to the one that the name ends with.
const PER_UNIT = {mm: 1e-3, MPa: 1e6, 'per mille': 1e-3, '%': 1e-2, mrad: 1e-3, 'mm/s': 1e-3, 'mrad/s': 1e-3,
  rpm: Math.PI / 30, 'L/min': 1e-3 / 60, kN: 1e3, kg: 1, 'm/s2': 1, us: 1, m: 1, rad: 1, s: 1, '': 1};

function value_of(signal, data) {
  const raw = Number((data >> BigInt(signal.start)) & ((1n << BigInt(signal.width)) - 1n));
  const value = raw * signal.factor + signal.offset;
  return value >= signal.min - 1e-9 && value <= signal.max + 1e-9 ? value : undefined;
}

/// What a JSON schema of ours can ask for.
function assert_schema(schema, value, where) {
  if (schema.type === 'object') {
    for (const [key, inner] of Object.entries(value)) {
      assert.ok(schema.properties[key], `${where}.${key} is not in the schema`);
      assert_schema(schema.properties[key], inner, `${where}.${key}`);
    }
  } else {
    assert.equal(typeof value, schema.type === 'integer' ? 'number' : schema.type, where);
  }
}

async function read_all(file) {
  const source = await readable(file);
  const reader = await McapIndexedReader.Initialize({readable: source});
  const messages = [];
  const decoder = new TextDecoder();
  const schemas = new Map([...reader.schemasById.values()].map(({id, encoding, data}) => {
    assert.equal(encoding, 'jsonschema');
    return [id, JSON.parse(decoder.decode(data))];
  }));
  let last = 0n;
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    assert.equal(channel.messageEncoding, 'json');
    assert.ok(message.logTime >= last, 'stamps go back');
    last = message.logTime;
    const value = JSON.parse(decoder.decode(message.data));
    assert_schema(schemas.get(channel.schemaId), value, channel.topic);
    messages.push({topic: channel.topic, time_ns: message.logTime, value});
  }
  assert.equal(BigInt(messages.length), reader.statistics.messageCount);
  // A second seek, as a tool does that jumps.
  const middle = messages[Math.floor(messages.length / 2)].time_ns;
  let late = 0;
  for await (const message of reader.readMessages({startTime: middle})) {
    assert.ok(message.logTime >= middle);
    late += 1;
  }
  assert.equal(late, messages.filter(({time_ns}) => time_ns >= middle).length);
  await source.close();
  return {messages, channels: reader.channelsById.size};
}

/// From its first byte to its last, as one who cannot seek: every checksum.
function read_stream(file) {
  const reader = new McapStreamReader({validateCrcs: true});
  reader.append(readFileSync(file));
  let count = 0;
  for (let record; (record = reader.nextRecord());) count += record.type === 'Message' ? 1 : 0;
  assert.ok(reader.done(), 'the file has no end');
  return count;
}

function compare(log, dbc, messages) {
  const lines = readFileSync(log, 'utf8').trimEnd().split('\n');
  const frames = messages.filter(({topic}) => !['/graben/state', '/graben/events'].includes(topic));
  let at = 0;
  let signals = 0;
  for (const line of lines) {
    const [, s, us, id, hex] = /^\((\d+)\.(\d{6})\) \S+ ([0-9A-F]+)#([0-9A-F]*)/.exec(line);
    const message = dbc.get(parseInt(id, 16));
    if (message === undefined || id.length !== 8) continue;
    const found = frames[at++];
    const topic = `/${message.sender.toLowerCase()}/${message.name}`;
    assert.equal(found.topic, topic);
    assert.equal(found.time_ns, BigInt(s) * 1_000_000_000n + BigInt(us) * 1000n, line);
    const data = hex.match(/../g).reverse().reduce((all, byte) => (all << 8n) | BigInt(`0x${byte}`), 0n);
    for (const [name, signal] of message.signals) {
      if (name === 'Crc' || name === 'Counter') continue;
      const want = value_of(signal, data);
      const key = Object.keys(found.value).find((one) => one === name || one.startsWith(`${name}_`));
      if (want === undefined) {
        assert.equal(key, undefined, `${topic}.${name} is not valid on the bus`);
        continue;
      }
      const scale = PER_UNIT[signal.unit];
      assert.ok(scale !== undefined, `unit ${signal.unit} of ${topic}.${name}`);
      assert.ok(key !== undefined, `${topic}.${name} is missing: ${line}`);
      assert.ok(Math.abs(found.value[key] - want * scale) <= 1e-6 * Math.max(1, Math.abs(want * scale)),
        `${topic}.${key}: ${found.value[key]}, on the bus ${want} ${signal.unit}`);
      signals += 1;
    }
  }
  assert.equal(at, frames.length);
  return signals;
}

/// Each frame of an id that `wanted` has: on its topic, with the values that its own formulas make of the bytes.
function compare_foreign(log, messages, wanted) {
  const seen = new Map();
  const found = new Map();
  for (const {topic, value} of messages) {
    if (!found.has(topic)) found.set(topic, []);
    found.get(topic).push(value);
  }
  for (const line of readFileSync(log, 'utf8').trimEnd().split('\n')) {
    const [, id, hex] = / ([0-9A-F]+)#([0-9A-F]*)/.exec(line);
    if (!(id in wanted)) continue;
    const [topic, values] = wanted[id];
    const at = seen.get(topic) ?? 0;
    seen.set(topic, at + 1);
    const got = found.get(topic)?.[at];
    assert.ok(got, `${topic} has no message ${at}`);
    const bytes = hex.match(/../g).map((byte) => parseInt(byte, 16));
    const word = (byte) => bytes[byte] + 256 * bytes[byte + 1];
    for (const [key, formula] of Object.entries(values)) {
      const want = formula(bytes, word);
      if (want === undefined) {
        assert.ok(!(key in got), `${topic}.${key} is there: ${line}`);
      } else {
        assert.ok(Math.abs(got[key] - want) <= 1e-6 * Math.max(1, Math.abs(want)), `${topic}.${key}: ${got[key]}, on the bus ${want}`);
      }
    }
  }
  for (const [topic] of Object.values(wanted)) {
    assert.ok(seen.get(topic) > 100, `${topic}: ${seen.get(topic)} frames`);
    assert.equal(seen.get(topic), found.get(topic).length, topic);
  }
}

const within = (least, most, value) => (value >= least && value <= most ? value : undefined);
const DEGREE = Math.PI / 180;

/// Of a bus of the machine's own, found by what the log says or told; of IMUs; and what is left out is said.
async function foreign_buses() {
  run(['dig', '--bus', 'zx200', '--out', 'zx200']);
  const log = join(out, 'zx200', 'dig.log');
  const wanted = {
    '18FF7DE8': ['/zx200/FrontAngle', {BoomAngle_rad: (_, word) => within(-1.3, 1.3, 10 - 4e-4 * word(0)),
      BucketAngle_rad: (_, word) => within(-3.2, 1, 10 - 4e-4 * word(4))}],
    '18FF79E8': ['/zx200/Pressure1', {BoomBottomPressure_Pa: (b) => within(-1e6, 41e6, 2e5 * b[0] - 1e7)}],
    '18FF7BE8': ['/zx200/PilotPressure1', {BoomUpPilot: (b) => within(0, 1.02, 4e-3 * b[0]),
      BoomDownPilot: (b) => within(-1.02, 0, -4e-3 * b[1])}],
    '18FF84E8': ['/zx200/MachineState', {ControlState: (b) => b[2], EngineState_radps: (b) => within(0, 188.5, 188.5 * (b[5] & 1))}],
    '18FF640A': ['/zx200/PilotPressureCmd1', {BoomUp: (b) => 4e-3 * b[0], BucketDump: (b) => 4e-3 * b[5]}],
    '18FF660A': ['/zx200/MachineSettingCmd', {EngineSpeed: (b) => b[0], FrontSignalSwitch: (b) => b[3] >> 4}],
  };
  for (const [told, words] of [[[], 'bus profile zx200, as the log says'], [['--bus', 'zx200'], 'bus profile zx200\n']]) {
    const said = run(['export', log, '--mcap', 'zx200.mcap', '--force', ...told]);
    assert.ok(said.includes(words) && said.includes('neither our DBC nor bus profile zx200 has: 0x18FF78E8, 0x18FF7EE8, 0x18FF7FE8'), said);
    const {messages} = await read_all(join(out, 'zx200.mcap'));
    assert.equal(read_stream(join(out, 'zx200.mcap')), messages.length);
    compare_foreign(log, messages, wanted);
  }
  // A log that does not say which: what is left out, why, and what would explain it.
  const mute = readFileSync(log, 'utf8').split('\n').filter((line) => !line.includes(' 18FF3482#')).join('\n');
  writeFileSync(join(out, 'mute.log'), mute);
  const said = run(['export', 'mute.log', '--mcap', 'mute.mcap']);
  assert.ok(/left out: \d+ frames with ids that our DBC does not have: .*bus profile zx200 has most of them: --bus zx200/.test(said), said);
  const other = run(['export', log, '--mcap', 'other.mcap', '--bus', 'encoders']);
  assert.ok(other.includes('bus profile zx200 has most of them'), other);
  assert.ok(run(['export', log, '--mcap', 'no.mcap', '--bus', 'zx20'], 1).includes("did you mean 'zx200'?"));
  assert.ok(!existsSync(join(out, 'no.mcap')), 'a refused export has left a file');

  run(['dig', '--bus', 'encoders', '--out', 'encoders']);
  assert.ok(!run(['export', 'encoders/dig.log', '--mcap', 'encoders.mcap']).includes('left out'));
  const {messages: encoders} = await read_all(join(out, 'encoders.mcap'));
  assert.ok(encoders.some(({topic, value}) => topic === '/encoders/Heartbeat1' && value.NodeState === 5));
  assert.ok(encoders.some(({topic, value}) => topic === '/encoders/BoomPosition' && Object.keys(value).length > 0));

  run(['dig', '--sensors', 'imu', '--out', 'imu']);
  assert.ok(!run(['export', 'imu/dig.log', '--mcap', 'imu.mcap']).includes('left out'));
  const {messages: imus} = await read_all(join(out, 'imu.mcap'));
  compare_foreign(join(out, 'imu', 'dig.log'), imus, {
    '0CF02AE2': ['/sensor/E2/ARI', {PitchRate_radps: (_, word) => DEGREE * (word(0) / 128 - 250)}],
    '08F02DE4': ['/sensor/E4/ACS', {Vertical_mps2: (_, word) => word(4) / 100 - 320, LateralMerit: (b) => ((b[6] & 3) < 2 ? b[6] & 3 : undefined)}],
  });
  console.log(`bus of the machine's own, encoders, IMUs: ${encoders.length + imus.length} messages`);
}

function refusals(log) {
  const refuse = (needle, ...words) => {
    const said = run(['export', ...words], 1);
    assert.ok(said.includes(needle), `${words}: ${said}`);
  };
  const text = readFileSync(log, 'utf8');
  // What is whole is kept, and the rest is told.
  const told = (words, ...options) => {
    const said = run(['export', ...options], 0);
    assert.ok(said.includes(words), `${words}: ${said}`);
  };
  writeFileSync(join(out, 'last.log'), text.slice(0, 5000));
  told('last.log: its last line is cut', 'last.log', '--mcap', 'last.mcap');
  writeFileSync(join(out, 'cut.log'), `${text.slice(0, 5000)}\n${text.slice(text.indexOf('\n', 5000) + 1, 9000)}`);
  told("cut.log: 1 line is none of candump's", 'cut.log', '--mcap', 'cut.mcap');
  writeFileSync(join(out, 'words.log'), 'no log\n');
  refuse('words.log', 'words.log', '--mcap', 'words.mcap');
  assert.ok(!existsSync(join(out, 'words.mcap')), 'a refused log has left a file');
  refuse('none.log', 'none.log', '--mcap', 'none.mcap');
  writeFileSync(join(out, 'there.mcap'), 'kept');
  refuse('--force', 'run/dig.log', '--mcap', 'there.mcap');
  assert.equal(readFileSync(join(out, 'there.mcap'), 'utf8'), 'kept');
  refuse('would overwrite', 'run/dig.log', '--mcap', 'run/dig.log', '--force');
  refuse("can't be written", 'run/dig.log', '--mcap', 'there.mcap/dig.mcap');
  const lines = text.split('\n');
  writeFileSync(join(out, 'back.log'), [...lines.slice(500, 1500), ...lines.slice(0, 100)].join('\n') + '\n');
  told('back.log: its clock goes back by', 'back.log', '--mcap', 'back.mcap');
}

rmSync(out, {recursive: true, force: true});
mkdirSync(out, {recursive: true});
for (const [command, kind] of [['dig', 'excavator'], ['grade', 'dozer']]) {
  run([command, '--out', 'run']);
  const log = join(out, 'run', `${command}.log`);
  const said = run(['export', log, '--mcap', `${command}.mcap`]);
  const file = join(out, `${command}.mcap`);
  const {messages, channels} = await read_all(file);
  assert.equal(read_stream(file), messages.length);
  const signals = compare(log, read_dbc(join(dbc_folder, `${kind}.dbc`)), messages);
  const modes = messages.filter(({topic}) => topic === '/graben/events')
    .map(({value}) => value.message).filter((text) => text.startsWith('mode '));
  assert.deepEqual(modes.slice(0, 4), ['mode Silent', 'mode Ready', 'mode Armed', 'mode Active'], modes);
  assert.ok(messages.some(({topic, value}) => topic === '/graben/state' && value.Limit !== 'none'));
  assert.ok(said.includes(`${messages.length} messages on ${channels} channels`), said);
  console.log(`${command}: ${messages.length} messages, ${signals} values as on the bus, `
    + `${channels} channels, ${(statSync(file).size / 1e6).toFixed(1)} MB`);
}
refusals(join(out, 'run', 'dig.log'));
await foreign_buses();
