// A task's run as the tool would write it, made of formulas: dig, lift, swing, dump and the way
// back, with a pump at its limit while it swings. Printed as JSON when called by itself.
import {pathToFileURL} from 'node:url';

// Radius from the swing axis, height, swing, attitude of the planned teeth at the steps' ends.
const POSES = [
  {radius: 7.4, height: 0.0, swing: 0.0, attitude: 2.27},
  {radius: 4.6, height: -0.9, swing: 0.0, attitude: 1.05},
  {radius: 5.2, height: 1.9, swing: 0.0, attitude: 0.55},
  {radius: 6.3, height: 2.6, swing: 1.45, attitude: 0.6},
  {radius: 6.9, height: 2.4, swing: 1.57, attitude: 2.4},
  {radius: 7.4, height: 0.0, swing: 0.0, attitude: 2.27},
];
const STEPS = [['dig', 'line', 9], ['lift', 'drives', 4], ['swing', 'drives', 6],
  ['dump', 'drives', 2.5], ['return', 'drives', 7]];
const PERIOD_S = 0.05;

const ramp = (share) => share - Math.sin(2 * Math.PI * share) / (2 * Math.PI);
const mix = (a, b, share) => a + (b - a) * share;
const teeth = ({radius, height, swing}) =>
  [radius * Math.cos(swing), radius * Math.sin(swing), height];

/// Between two poses; a straight line of the teeth is straight in x, y, z, all else in its drives.
function poseAt(step, share) {
  const [a, b] = [POSES[step], POSES[step + 1]];
  return Object.fromEntries(Object.keys(a).map((key) => [key, mix(a[key], b[key], share)]));
}

/// Strokes that have the size of an excavator's, not its geometry.
const drives = (pose) => [0.45 + 0.09 * pose.height, 0.95 - 0.09 * pose.radius,
  0.75 - 0.2 * pose.attitude, pose.swing];

const transpose = (rows) => rows[0].map((_, k) => rows.map((row) => row[k]));

/// Backwards in time: nothing is known before the first sample.
const rate = (list) => list.map((value, i) => (i === 0 ? 0 : (value - list[i - 1]) / PERIOD_S));

function samples() {
  const list = [];
  let from = 0;
  STEPS.forEach(([, kind, duration], step) => {
    const count = Math.round(duration / PERIOD_S);
    for (let i = 0; i < count; ++i) {
      const share = i / count;
      const late = ramp(Math.max(share - 0.006, 0));
      const t = from + i * PERIOD_S;
      const shake = 0.004 * Math.sin(7 * t) * Math.sin(Math.PI * share);
      const planned = poseAt(step, ramp(share));
      const real = poseAt(step, late);
      real.height += shake;
      list.push({t, kind, share, planned, real, shake,
        slow: step === 2 && share > 0.25 && share < 0.75});
    }
    from += count * PERIOD_S;
  });
  return list;
}

function series(list) {
  const onLine = (value) => ({kind}, i) => (kind === 'line' ? value(list[i]) : null);
  const planned = transpose(list.map(({planned: pose}) => drives(pose)));
  const real = transpose(list.map(({real: pose}) => drives(pose)));
  const spool = real.map((row) => rate(row).map((v) => Math.max(-1, Math.min(1, 2.2 * v))));
  const pressure = list.map(({t, slow}) => (slow ? 31e6 : 14e6) + 1.5e6 * Math.sin(3 * t));
  return {
    time_s: list.map(({t}) => t),
    teeth_m: transpose(list.map(({real: pose}) => teeth(pose))),
    planned_m: transpose(list.map(({planned: pose}) => teeth(pose))),
    attitude_rad: list.map(({real: pose, shake}) => pose.attitude + shake),
    planned_attitude_rad: list.map(({planned: pose}) => pose.attitude),
    error_true_m: list.map(onLine(({shake}) => Math.abs(shake))),
    error_measured_m: list.map(onLine(({shake, t}) => Math.abs(shake + 0.001 * Math.sin(31 * t)))),
    progress: list.map(({share}) => ramp(share)),
    lambda: list.map(({slow, share}) => (
      slow ? 1 - 0.4 * Math.sin(Math.PI * (2 * share - 0.5)) : 1)),
    limit: list.map(({slow}) => (slow ? 1 : 0)), limit_names: ['none', 'pump flow: Pump 1'],
    planned, real,
    velocity_wanted: planned.map(rate), velocity_real: real.map(rate),
    spool_command: spool,
    spool_real: spool.map((row) => row.map((v, i) => row[Math.max(i - 1, 0)])),
    pump_expected_pa: [pressure], pump_real_pa: [pressure.map((p, i) => p + 4e5 * Math.sin(i))],
    cycle_time_us: list.map((_, i) => 90 + 20 * Math.abs(Math.sin(i * 1.7))),
  };
}

export function autodigRun() {
  const list = samples();
  let from = 0;
  const steps = STEPS.map(([name, kind, duration], i) => {
    const step = {name, kind, from_s: from, until_s: from + duration, from_m: teeth(POSES[i]),
      to_m: teeth(POSES[i + 1])};
    from += duration;
    return step;
  });
  return {
    kind: 'autodig', title: 'Graben: task of an excavator', subtitle: 'excavator_12t, seed 1',
    summary: [{label: 'Distance from the line, max', value: '4.0', unit: 'mm', note: 'true teeth'}],
    limits_share: [{name: 'none', share: 0.894}, {name: 'pump flow: Pump 1', share: 0.106}],
    steps, fences: [{words: 'ceiling at 3.0 m'}, {words: 'wall at y = −2.0 m'}],
    design: {words: 'level at −0.90 m, teeth stay above it'}, series: series(list),
  };
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  console.log(JSON.stringify(autodigRun()));
}
