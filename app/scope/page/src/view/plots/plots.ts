// SPDX-License-Identifier: Apache-2.0
/// Which plots there are, by machine. Their names are those that Run.truth.lines[].plot may name;
/// such a line is added, dashed, converted to the plot's unit.

import type {FrameStore, Kind, Machine, Run} from '../../model/api';
import {followed_trace, moved_trace} from './motion_trace';
import {in_unit, signal_trace, truth_trace, unit_factor, type Trace} from './traces';

export interface Line {
  label: string;
  colour: string;  ///< Name of a custom property of the theme.
  /// 'wanted': broad and dotted. 'real': strong. 'beside': thin. 'truth': dashed.
  style: 'wanted' | 'real' | 'beside' | 'truth';
  digits: number;
  trace: Trace;
  own?: string;   ///< The signal, of a line that the reader has put there.
  unit?: string;  ///< Where it is another one than the plot's.
}

export interface PlotSpec {
  name: string;
  title: string;
  unit: string;
  note: string;
  lines: readonly Line[];
  /// Least range of the vertical axis; without it the curves alone decide.
  least?: readonly [number, number];
  strip?: boolean;  ///< With the limits as a coloured strip below.
  /// So far the vertical axis is straight, beyond it goes by powers of ten.
  straight_to?: number;
  /// An error: where it was greatest is told; it is one of the path's from once below this on.
  arrived?: number;
}

const DRIVES = [
  {name: 'Boom', colour: 'boom'},
  {name: 'Arm', colour: 'arm'},
  {name: 'Bucket', colour: 'bucket'},
] as const;

function wanted(label: string, colour: string, signal: string, digits: number): Line {
  return {label, colour: `${colour}-soft`, style: 'wanted', digits, trace: signal_trace(signal)};
}

function real(label: string, colour: string, signal: string, digits: number): Line {
  return {label, colour, style: 'real', digits, trace: signal_trace(signal)};
}

function beside(label: string, colour: string, signal: string, digits: number): Line {
  return {label, colour, style: 'beside', digits, trace: signal_trace(signal)};
}

/// The same lines, whose frames have another unit than the plot.
function told_in(from: string, to: string, digits: number, lines: readonly Line[]): Line[] {
  const factor = unit_factor(from, to) ?? NaN;
  return lines.map((line) => ({...line, digits, trace: in_unit(line.trace, factor)}));
}

/// What lambda leaves of the wanted velocity, and what becomes of it.
function velocities(kind: Kind, label: string, colour: string): Line[] {
  const drive = label.toLowerCase();
  return [
    {label: `${label} wanted`, colour: `${colour}-soft`, style: 'wanted', digits: 0,
      trace: followed_trace(kind, drive)},
    {label, colour, style: 'real', digits: 0, trace: moved_trace(kind, drive)},
  ];
}

/// As `graben compare` has it.
const ARRIVED_MM = 20;

const LAMBDA: PlotSpec = {
  name: 'lambda', title: 'Lambda and what holds it', unit: '',
  note: 'Share of the wanted velocity that is followed',
  lines: [real('lambda', 'lambda', 'EcuStatus.Lambda', 3)], least: [0, 1], strip: true,
};

/// Messages that only a machine with a swing has.
const SWING_MESSAGES = ['SwingState', 'SwingCommand', 'SwingValveState'];

function excavator_plots(count: number, came: ReadonlySet<string>): PlotSpec[] {
  const pumps = [1, 2].slice(0, count);
  const has_swing = SWING_MESSAGES.some((message) => came.has(message));
  const spools = DRIVES.flatMap(({name, colour}) => [
    wanted(`${name} command`, colour, `SpoolCommand.${name}Duty`, 0),
    real(name, colour, `ValveState.${name}Spool`, 0),
  ]);
  if (has_swing) {
    spools.push(wanted('Swing command', 'swing', 'SwingCommand.SwingDuty', 0),
      real('Swing', 'swing', 'SwingValveState.SwingSpool', 0));
  }
  const plots: PlotSpec[] = [LAMBDA, {
    name: 'error', title: 'Path error', unit: 'mm', least: [0, 5], straight_to: 10, arrived: ARRIVED_MM,
    note: 'Measured tip from the path; axis straight to 10 mm',
    lines: [real('Path error', 'error', 'EcuHydraulics.PathError', 1)],
  }, {
    name: 'spools', title: 'Spools', unit: 'per mille', lines: spools, least: [-100, 100],
    note: 'Command dotted, feedback whole; positive extends',
  }, {
    name: 'velocities', title: 'Cylinder velocities', unit: 'mm/s', least: [-20, 20],
    note: 'Lambda times wanted dotted, real whole',
    lines: DRIVES.flatMap(({name, colour}) => velocities('excavator', name, colour)),
  }];
  if (has_swing) {
    plots.push({
      name: 'swing', title: 'Swing rate', unit: 'deg/s', least: [-2, 2],
      note: 'Lambda times wanted dotted, real whole; to the left is positive',
      lines: told_in('mrad/s', 'deg/s', 1, velocities('excavator', 'Swing', 'swing')),
    });
  }
  plots.push({
    name: 'pumps', title: 'Pump pressures', unit: 'MPa', least: [0, 5],
    note: 'That the solution expects',
    lines: pumps.map((pump) => real(
      `Pump ${pump} expected`, `pump${pump}`, `EcuHydraulics.Pump${pump}ExpectedPressure`, 2)),
  }, {
    name: 'chambers', title: 'Chamber pressures', unit: 'MPa', least: [0, 5],
    note: 'Measured; cap side strong, rod side thin', lines: chambers(has_swing),
  }, {
    name: 'swash', title: 'Swash', unit: '%', least: [0, 100],
    note: 'Command dotted, measured whole',
    lines: pumps.flatMap((pump) => [
      wanted(`Pump ${pump} command`, `pump${pump}`, `PumpCommand.Pump${pump}Swash`, 1),
      real(`Pump ${pump}`, `pump${pump}`, `PumpState.Pump${pump}Swash`, 1),
    ]),
  });
  if (came.has('EcuTipLoad')) {
    plots.push({
      name: 'tip_force', title: 'Tip force', unit: 'kN', least: [-1, 1],
      note: "Of the ground on the teeth, by the cylinders' pressures; thin its standard deviation",
      lines: [
        real('Outwards', 'first', 'EcuTipLoad.TipForceOutwards', 1),
        real('Up', 'second', 'EcuTipLoad.TipForceUp', 1),
        beside('Deviation', 'error', 'EcuTipLoad.TipForceDeviation', 1),
      ],
    }, {
      name: 'payload', title: 'Payload', unit: 'kg', least: [0, 100],
      note: 'Of the bucket while it is lifted free; thin its standard deviation',
      lines: [
        real('Payload', 'first', 'EcuTipLoad.PayloadMass', 0),
        beside('Deviation', 'error', 'EcuTipLoad.PayloadDeviation', 0),
      ],
    });
  }
  if (came.has('EcuLearntValves')) {
    plots.push({
      name: 'learnt', title: 'Learnt dead bands', unit: '%', least: [-2, 2],
      note: "From the profile's, of the spool's travel; extending strong, retracting thin",
      lines: DRIVES.flatMap(({name, colour}) => [
        real(`${name} extends`, colour, `EcuLearntValves.${name}ExtendEdge`, 1),
        beside(`${name} retracts`, colour, `EcuLearntValves.${name}RetractEdge`, 1),
      ]),
    });
  }
  return plots;
}

function chambers(has_swing: boolean): Line[] {
  const lines = DRIVES.flatMap(({name, colour}) => [
    real(`${name} cap`, colour, `${name}Pressure.${name}CapPressure`, 2),
    beside(`${name} rod`, colour, `${name}Pressure.${name}RodPressure`, 2),
  ]);
  return has_swing
    ? [...lines, real('Swing left', 'swing', 'SwingState.SwingLeftPressure', 2),
      beside('Swing right', 'swing', 'SwingState.SwingRightPressure', 2)]
    : lines;
}

function dozer_plots(): PlotSpec[] {
  const sides = ['Left', 'Right'] as const;
  return [LAMBDA, {
    name: 'error', title: 'Grade error', unit: 'mm', least: [-5, 5], straight_to: 10, arrived: ARRIVED_MM,
    note: 'Edge against the grade, above is positive; axis straight to 10 mm',
    lines: [real('Grade error', 'error', 'EcuGrade.GradeError', 1)],
  }, {
    name: 'speeds', title: 'Travel speed', unit: 'km/h', least: [0, 2],
    note: 'Wanted dotted, real whole, limit of flow and transmission thin',
    lines: told_in('mm/s', 'km/h', 2, [
      wanted('Wanted', 'travel', 'EcuMotion.WantedSpeed', 0),
      beside('Limit', 'error', 'EcuMotion.SpeedLimit', 0),
      real('Real', 'travel', 'BodyVelocity.Forward', 0),
      beside('Left track', 'left', 'TrackSpeed.LeftTrack', 0),
      beside('Right track', 'right', 'TrackSpeed.RightTrack', 0),
    ]),
  }, {
    name: 'flow', title: 'Implement flow', unit: 'L/min', least: [0, 100],
    note: 'That the grade requires of what there is',
    lines: [wanted('Available', 'available', 'EcuGrade.AvailableFlow', 1),
      real('Required', 'required', 'EcuGrade.RequiredFlow', 1)],
  }, {
    name: 'spools', title: 'Blade spool', unit: 'per mille', least: [-100, 100],
    note: 'Command dotted, feedback whole; positive lowers',
    lines: [wanted('Blade command', 'blade', 'SpoolCommand.BladeDuty', 0),
      real('Blade', 'blade', 'ValveState.BladeSpool', 0)],
  }, {
    name: 'velocities', title: 'Blade cylinder velocity', unit: 'mm/s', least: [-20, 20],
    note: 'Wanted dotted, real whole; positive lowers',
    lines: velocities('dozer', 'Blade', 'blade'),
  }, {
    name: 'displacements', title: 'Pump displacements', unit: 'per mille', least: [0, 100],
    note: 'Command dotted, measured whole; forward is positive',
    lines: sides.flatMap((side) => [
      wanted(`${side} command`, side.toLowerCase(), `PumpDisplacementCommand.${side}Pump`, 0),
      real(side, side.toLowerCase(), `${side}Transmission.Pump`, 0),
    ]),
  }, {
    name: 'motors', title: 'Motor displacements', unit: '%', least: [0, 100],
    note: 'Command dotted, measured whole',
    lines: sides.flatMap((side) => [
      wanted(`${side} command`, side.toLowerCase(), `MotorDisplacementCommand.${side}Motor`, 1),
      real(side, side.toLowerCase(), `${side}Transmission.Motor`, 1),
    ]),
  }, {
    name: 'lines', title: 'Transmission pressures', unit: 'MPa', least: [0, 5],
    note: 'Higher one of each path\'s two lines',
    lines: sides.map((side) => real(
      side, side.toLowerCase(), `${side}Transmission.LinePressure`, 2)),
  }];
}

/// What of a machine its plots go by.
export interface Plotted {
  kind: Kind;
  pumps: number;
}

const SECOND_PUMP = ['PumpState.Pump2Swash', 'PumpCommand.Pump2Swash',
  'EcuHydraulics.Pump2ExpectedPressure'];

/// Of a machine whose profile is not known, the frames alone tell what it has.
export function plotted(machine: Machine | null, store: FrameStore): Plotted | null {
  const kind = machine?.kind ?? store.database?.kind ?? null;
  if (kind !== 'excavator') {
    return kind === null ? null : {kind, pumps: 2};
  }
  const second = () => SECOND_PUMP.some((signal) =>
    store.reading(signal, store.until_s).state === 'valid');
  return {kind, pumps: machine?.kind === 'excavator' ? machine.pumps : second() ? 2 : 1};
}

/// Why there is no plot.
export function empty_words({frames, database}: FrameStore): string {
  return frames === 0 ? 'No frames yet: nothing to plot.'
    : database === null ? 'No frame of an excavator or a dozer yet: nothing to plot.'
      : 'No message that is plotted has come yet.';
}

/// All plots of a machine, of the lines whose frames came, with what a run knows beside them.
export function plots_of(
  of: Plotted | null, run: Run | undefined, came: ReadonlySet<string>,
): PlotSpec[] {
  const all = of === null ? []
    : of.kind === 'excavator' ? excavator_plots(of.pumps, came) : dozer_plots();
  const plots = all.map((plot) => ({
    ...plot, lines: plot.lines.filter(({trace}) => came.has(trace.message ?? '')),
  })).filter(({lines}) => lines.length > 0);
  return run === undefined ? plots : with_truth(run.built === undefined ? plots
    : plots.map(without_greatest), run);
}

/// Of an area what is left of the ground counts: where the teeth were farthest off says nothing of it.
function without_greatest(plot: PlotSpec): PlotSpec {
  const {arrived, ...rest} = plot;
  return arrived === undefined ? plot : rest;
}

const TRUTH_COLOURS = ['true', 'first', 'second', 'error', 'lambda'];

const DRIVE_NAMES = ['boom', 'arm', 'bucket', 'swing', 'blade', 'left', 'right', 'pump1', 'pump2'];

/// A line named after a drive has its colour.
function colour_of(label: string, line: number): string {
  const first = label.toLowerCase().replace(/^pump ([12])/, 'pump$1').split(/[^a-z0-9]/)[0]!;
  return DRIVE_NAMES.includes(first) ? first : TRUTH_COLOURS[line % TRUTH_COLOURS.length]!;
}

/// Four figures that tell something.
function digits_for(values: readonly (number | null)[]): number {
  const most = values.reduce<number>((max, value) => Math.max(max, Math.abs(value ?? 0)), 0);
  return most > 0 ? Math.max(0, Math.min(4, 3 - Math.floor(Math.log10(most)))) : 2;
}

function with_truth(plots: PlotSpec[], run: Run): PlotSpec[] {
  const all = plots.map((plot) => ({...plot, lines: [...plot.lines]}));
  const planned = run.truth.note
    ?? (run.pose === undefined ? 'Known to the simulation' : 'As planned');
  for (const line of run.truth.lines) {
    let plot = all.find(({name, unit}) =>
      name === line.plot && unit_factor(line.unit, unit) !== null);
    if (plot === undefined) {
      const title = line.title ?? line.plot.charAt(0).toUpperCase() + line.plot.slice(1);
      plot = {name: line.plot, title, unit: line.unit, note: planned, lines: []};
      all.push(plot);
    }
    const factor = unit_factor(line.unit, plot.unit) ?? 1;
    plot.lines.push({
      label: line.label,
      style: all.indexOf(plot) < plots.length || /, (limit|second)$/.test(line.label) ? 'truth' : 'real',
      colour: colour_of(line.label, plot.lines.length),
      digits: plot.lines[0]?.digits ?? digits_for(line.values),
      trace: truth_trace(run, line, factor),
    });
  }
  return all;
}
