// SPDX-License-Identifier: Apache-2.0
/// What the parts of the page know of each other. SI units unless the name says otherwise; times in
/// seconds as the log has them (candump's stamps, which may be seconds since 1970).
///
/// Frames. The ground frame: x forward, y to the left, z up; an excavator's origin is where its
/// swing axis meets the ground, a dozer's is its track ground line at the start of the grade.
/// Planar link frames of an excavator are those of its profile: x along the link, from pin to pin.

import type {SurfaceGrid} from './surface_grid';

export type Kind = 'excavator' | 'dozer';
export type Vector2 = readonly [number, number];
export type Vector3 = readonly [number, number, number];

// ---- What the server (or the file that is a report) says before the first frame --------------

export interface Setup {
  source: Source;
  machines: readonly Machine[];  ///< Every shipped profile and what was given; chosen by hash.
  buses?: readonly NamedBus[];   ///< On which a machine may have been put: its hash is then both.
  words: Words;
  version?: string;  ///< Of the program that says this; a file that is opened tells none.
  sim?: SimSetup;  ///< With mode 'sim' alone.
  run?: Run;       ///< With modes 'report' and 'plan'.
}

export interface Source {
  /// 'can': a real or virtual bus, which is only heard. 'log': a file. 'sim': simulated, in real
  /// time. 'report': a log inside the page. 'plan': no frames, only `run.pose`.
  mode: 'can' | 'log' | 'sim' | 'report' | 'plan';
  name: string;     ///< Interface, file name, or task.
  bytes?: number;   ///< Of a log, for the progress of loading.
  /// Where a server's log is got from, by HTTP: a browser takes that many times as fast as messages.
  get?: string;
  bitrate: number;  ///< Of the bus, bit/s, for its load; assumed where it cannot be asked.
}

export interface Words {
  fault: Readonly<Record<string, string>>;  ///< By the number that EcuStatus.Fault has.
  /// By bit of EcuHealth.WhyNotArmed, from bit 0.
  why_not_armed: readonly string[];
}

export type Machine = ExcavatorMachine | DozerMachine;

interface AnyMachine {
  name: string;  ///< Of its profile.
  hash: number;  ///< ProfileHash on the bus.
}

export interface Cylinder {
  count: number;
  bore_m: number;
  rod_m: number;
  closed_length_m: number;  ///< Pin to pin, closed.
  stroke_m: number;
  base_m: Vector2;  ///< Pin on the link nearer to the body, in that link's frame.
  eye_m: Vector2;   ///< Pin on the moved link, in its frame. The bucket's: unused.
}

export interface ExcavatorMachine extends AnyMachine {
  kind: 'excavator';
  boom_m: number;    ///< Pin to pin.
  arm_m: number;
  bucket_m: number;  ///< Pin to teeth.
  bucket_width_m?: number;      ///< Of the edge; like the next one where the profile says it.
  bucket_capacity_m3?: number;  ///< Loose soil, heaped.
  boom_foot_m: Vector2;  ///< Boom foot pin: forward of the swing axis, above the ground.
  cylinders: {boom: Cylinder; arm: Cylinder; bucket: Cylinder};
  linkage: {
    rocker_pivot_m: Vector2;  ///< Arm frame.
    rocker_m: number;
    coupler_m: number;
    lug_m: Vector2;  ///< Bucket frame.
  };
  has_swing: boolean;
  bus?: Bus;  ///< That it speaks in the place of ours, or beside it.
  imus?: {boom: Imu; arm: Imu; bucket: Imu};  ///< The profile's, or where an IMU usually is.
  pumps: number;
  relief_pa: number;
  assist_window_m?: number;  ///< So near over its design task Assist holds the edge.
  dig: Dig;
  tasks: readonly Task[];  ///< By the number that TaskStatus has.
}

/// What tells a machine's links on a bus that is not ours.
export interface Bus {
  messages: readonly BusMessage[];
}

export interface NamedBus extends Bus {
  name: string;
  hash: number;
}

export interface BusMessage {
  id: number;
  extended: boolean;
  length: number;
  signals: readonly BusSignal[];
}

/// value = raw * scale + offset, m or rad.
export interface BusSignal {
  tells: 'stroke' | 'joint_angle' | 'slope';
  of: number;        ///< Boom, arm, bucket; of a slope the platform too.
  start: number;     ///< Motorola: the highest bit, as a DBC counts.
  width: number;     ///< 1 .. 32.
  motorola: boolean;
  signed: boolean;
  scale: number;
  offset: number;
  least: number;     ///< Beyond these it is no value.
  most: number;
}

/// A sensor of a link, for where its frames stand in a stroke's place.
export interface Imu {
  address: number;     ///< J1939 source address.
  at_m: Vector2;       ///< Frame of its link, or of the rocker, from its pin.
  turn_rad: number;    ///< Of its long axis against x of that frame.
  backwards: boolean;
  on_rocker: boolean;
}

/// The closed path of the digging task, and the contour field around it.
export interface Dig {
  path: readonly Vector3[];  ///< x, z of the ground frame in m, and attitude in rad there.
  speed_mps: number;
  field: readonly (readonly [number, number, number, number])[];  ///< x, z, vx, vz.
  ground_z_m: number;        ///< Surface of the soil before the first pass.
}

export interface Pose {
  position_m: Vector3;   ///< Of the teeth, ground frame.
  attitude_rad: number;  ///< From the teeth to the bucket pin against the horizontal.
}

export interface Task {
  name: string;
  steps: readonly {
    kind: string;        ///< As the profile's words have it: dig, lift, ...
    straight: boolean;   ///< A line of the teeth; else straight in drive space.
    from: Pose;
    to: Pose;
    from_drives: readonly number[];  ///< boom, arm, bucket strokes in m, swing in rad.
    to_drives: readonly number[];
    duration_s: number;
    raised_from_m: number;  ///< By the design, of its beginning and its end.
    raised_to_m: number;
  }[];
  fences: readonly Fence[];
  /// The surface to dig to, where the task has one; its fence is the last of `fences`.
  design: {through_m: Vector3; up: Vector3} | null;
  surface?: SurfaceGrid | null;  ///< The same as heights, where it is no plane.
}

/// A plane: what is left to the machine is normal . p <= offset_m. Else an upright box or cylinder.
export interface Fence {
  words: string;
  normal?: Vector3;
  offset_m?: number;
  round?: boolean;
  centre_m?: Vector3;
  half_m?: Vector3;  ///< Half of the sides, the last upwards; of a cylinder the radius.
  turn_rad?: number;
}

export interface DozerMachine extends AnyMachine {
  kind: 'dozer';
  blade: {
    pivot_m: Vector2;  ///< Body frame, x forward, z up, origin at the tracks' ground line.
    arm_m: Vector2;    ///< Pivot to the blade's foot, at home.
    cutting_edge_m: number;  ///< Pivot to cutting edge.
    base_m: Vector2;         ///< Cylinder base.
    length_home_m: number;
    edge_min_m: number;  ///< Reach of the edge against the ground line, body level.
    edge_max_m: number;
    cylinders: number;
    bore_m: number;
    rod_m: number;
  };
  track_contact_m: number;
  half_gauge_m: number;
  mass_centre_height_m: number;
  design: readonly Vector2[];  ///< x, z; x rises.
  tilt?: Tilt;                 ///< Of a blade that tilts, as the next.
  cross?: readonly Vector2[];  ///< x and the design's slope across there, left up positive.
  /// x and the track's curvature in plan there, 1/m, to the left positive; none: it is straight. x
  /// is then the station along it.
  curvature?: readonly Vector2[];
  length_m: number;            ///< The grade is made from x = 0 to here.
}

/// A blade that turns about its own longitudinal axis, through the middle of its edge. Pins as seen
/// from behind with the blade level: y to the left, z up, from that axis.
export interface Tilt {
  edge_width_m: number;    ///< End to end.
  angle_most_rad: number;  ///< Either way against the body; left end up is positive.
  base_m: Vector2;         ///< Cylinder's pin on the push frame.
  eye_m: Vector2;          ///< On the blade.
}

/// A run that is over: what its report shows beside the frames.
export interface Run {
  title: string;
  subtitle: string;
  summary: readonly {label: string; value: string | number; unit: string; note: string}[];
  limits_share: readonly {name: string; share: number}[];
  /// What only a simulation knows. A value that is not known is null. Lines of one unit on the plot
  /// of that name (see view/plots.ts), or on a plot of its own by a name that is not there.
  truth: {
    time_s: readonly number[];
    note?: string;  ///< What these lines are, where they are no simulation's.
    lines: readonly {plot: string; title?: string; label: string; unit: string;
      values: readonly (number | null)[]}[];
  };
  /// Drives over truth.time_s, where there are no frames: strokes in m, swing in rad.
  pose?: {drives: readonly (readonly number[])[]};
  /// Way that the true teeth or edge took, ground frame, over truth.time_s.
  way?: readonly Vector3[];
  built?: Built;
  log?: string;  ///< candump text, gzip, base64.
}

/// An area as it was built: places of a grid, ground frame, and heights over the design along its
/// normal.
export interface Built {
  cell_m: number;               ///< Of the grid.
  x_m: readonly number[];
  y_m: readonly number[];
  off_mm: readonly number[];    ///< The surface, loose soil and all.
  firm_mm: readonly number[];   ///< Ground that nobody has cut.
}

export interface SimSetup {
  task: 'dig' | 'grade' | 'autodig';
  can: {soil: boolean; obstacle: boolean};  ///< What this machine can be given.
  faults: readonly SimFault[];
}

export interface SimFault {
  id: string;      ///< What a control message names it by.
  number: number;  ///< Of the table of faults.
  words: string;
  reaction: string;  ///< What the controller is meant to do, in words.
  once: boolean;     ///< Happens and is over; else stays until it is taken back.
}

// ---- Messages on the WebSocket: JSON as text, candump lines as binary ------------------------

export type FromServer =
  | ({kind: 'setup'} & Setup)
  | {kind: 'dropped'; frames: number}  ///< Lost for this page since it connected, in all.
  | {kind: 'bus'; up: boolean; words: string}
  | {kind: 'end'}                      ///< Of a log: all of it is here. The page says so itself.
  | ({kind: 'sim'} & SimState)
  | {kind: 'refused'; why: string};

export interface SimState {
  running: boolean;
  pace: number;   ///< Simulated over real time.
  speed: number;  ///< Operator's speed override, 0.05 .. 1.
  soil: boolean;
  obstacle: boolean;
  faults: readonly string[];  ///< Ids of those that are on.
}

/// Only with mode 'sim'; the server refuses the rest.
export type ToServer =
  | {do: 'run'} | {do: 'stop'} | {do: 'restart'} | {do: 'clear'}
  | {do: 'pace' | 'speed'; value: number}
  | {do: 'soil' | 'obstacle'; value: boolean}
  | {do: 'fault'; id: string; value: boolean};

// ---- Frames ------------------------------------------------------------------------------------

export interface SignalDef {
  readonly name: string;
  readonly message: MessageDef;
  readonly unit: string;
  readonly factor: number;
  readonly offset: number;
  readonly min: number;
  readonly max: number;
  readonly states: ReadonlyMap<number, string>;  ///< VAL_ of the DBC.
  readonly description: string;
  /// The raw value in the 8 bytes that begin at `at`.
  raw(bytes: Uint8Array, at: number): number;
  /// 'error' and 'not available' as the DBC's attributes have them.
  state(raw: number): 'valid' | 'error' | 'notAvailable';
}

export interface MessageDef {
  readonly name: string;
  readonly id: number;  ///< 29 bit.
  readonly sender: string;
  readonly cycle_ms: number;  ///< 0: none.
  readonly data_id: number;   ///< 0: without end-to-end protection.
  readonly max_delta: number;
  readonly signals: ReadonlyMap<string, SignalDef>;
}

export interface Database {
  readonly kind: Kind;
  readonly version: number;
  readonly messages: ReadonlyMap<string, MessageDef>;
  readonly by_id: ReadonlyMap<number, MessageDef>;  ///< By identity_of (dbc.ts).
  signal(path: string): SignalDef;  ///< 'BoomStroke.BoomStroke'; throws where there is none.
}

export interface Reading {
  value: number;  ///< Physical, in the signal's unit; NaN unless valid.
  raw: number;
  state: 'valid' | 'error' | 'notAvailable' | 'never';
  age_s: number;  ///< Since its frame; Infinity with 'never'.
}

/// All frames of one message, oldest first.
export interface Rows {
  readonly count: number;
  time(index: number): number;
  /// Index of the last frame at or before `time_s`; -1 if there is none.
  at(time_s: number): number;
  /// Its 8 bytes, at an offset in a buffer. Valid until frames are added.
  bytes(index: number): {buffer: Uint8Array; at: number};
}

/// A curve over a window, few enough points for the screen: within each bucket least and greatest.
export interface Curve {
  time_s: Float64Array;
  value: Float64Array;  ///< NaN: a gap.
}

export interface FrameStore {
  readonly database: Database | null;  ///< Until the first frames tell which machine it is.
  readonly from_s: number;   ///< Of the oldest frame that is kept.
  readonly until_s: number;  ///< Of the newest.
  readonly frames: number;   ///< Seen, kept or not.
  readonly revision: number; ///< Changes whenever frames came or went.
  rows(message: string): Rows;
  reading(signal: string, time_s: number): Reading;
  curve(signal: string, from_s: number, until_s: number, buckets: number): Curve;
  /// Every frame's bits in the second before, over the bitrate.
  bus_load(time_s: number, bitrate: number): number;
  /// Whether a message is none of the bus: what the page made of the IMUs' frames.
  is_estimate(message: string): boolean;
  /// Times at which a fault begins, as EcuStatus has it, with its number.
  faults(): readonly {time_s: number; code: number}[];
  /// When the controller was first anything but Silent; Infinity: not yet. What it reports before
  /// is what it waits for, and no fault.
  readonly ready_s: number;
  readonly health: LogHealth;
}

export interface LogHealth {
  lines: number;
  malformed: number;
  first_malformed: {line: number; text: string} | null;
  foreign: number;         ///< Frames that the DBC does not have.
  backwards: number;       ///< Stamps a little before the one before.
  lost: number;            ///< Frames that the log itself says it lacks.
  breaks: number;          ///< Gaps and steps of its clock.
  first_break: {line: number; by_s: number} | null;
  profile_hash: number | null;     ///< As the controller or the machine says.
  dbc_version: number | null;
}

export type Integrity = 'ok' | 'crc' | 'repeated' | 'lost' | 'sequence' | 'silent' | 'unprotected';

export interface MessageState {
  message: MessageDef;
  age_s: number;
  stale: boolean;    ///< Older than three of its cycles.
  counter: number;   ///< -1: has none.
  integrity: Integrity;
  wrong: number;     ///< Frames with a wrong CRC or counter in the last second.
  rate_hz: number;   ///< Over the last second.
}

// ---- Where the page looks ---------------------------------------------------------------------

/// One for the whole page; changes come as calls of the listeners.
export interface Playhead {
  now_s: number;       ///< What everything shows.
  follow: boolean;     ///< At the newest frame, as it comes.
  playing: boolean;
  rate: number;        ///< Of replay.
  window: readonly [number, number];  ///< What the plots show.
  seek(time_s: number): void;
  on_change(listener: () => void): void;
}
