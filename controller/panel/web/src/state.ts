// SPDX-License-Identifier: Apache-2.0
// The daemon's state as controller/panel/state.h documents it: what the page reads of it.

export interface Refusal {
  what: string;
  where: string;
  remedy: string;
}
export interface Problem extends Refusal {
  warning: boolean;
}
export type Values = Record<string, number>;

export interface Instruction {
  words: string;
  to: Values;
}
export interface Fixture {
  name: string;
  role: string;
  mount: string;
  words: string;
  level: string;
  colour: string;
  /** This lamp alone, at the face: "640 lx (59 fc)". */
  light: string;
  lux: number;
  output_cd: number;
  measured: boolean;
  patch: { universe: number; address: number; slots: number } | null;
  wanted: Values;
  placed: Values;
  sent: Values;
  manual: Values;
  limits: Record<string, [number, number]>;
  locked: boolean;
  controlled: boolean;
  by_hand: string[];
  instruction: Instruction | null;
}
export interface Look {
  id: number;
  name: string;
  mood: string;
  verdict: string;
  verdict_when_placed: string;
  remedy: string;
  ratio: string;
  light: string;
  nudges: Values;
  /** What lamps alone cannot do of the last nudge. */
  advice: string[];
  can_nudge: boolean;
  kept: boolean;
  edition: number;
  fade: number;
  picture: string;
  placed_picture: string;
  reference: string;
  trials: number;
  seconds: number;
}
export interface Design {
  job: number;
  mood: string;
  title: string;
  status: 'queued' | 'running' | 'done' | 'failed' | 'cancelled';
  stage: string;
  trial: number;
  trials: number;
  best: number;
  seconds: number;
  /** The lamps show a first answer already; places are still being looked for. */
  lit: boolean;
  look: number | null;
  error: Refusal | null;
}
export interface Camera {
  name: string;
  health: 'good' | 'waiting' | 'lost' | 'none';
  frames: number;
  reconnects: number;
  picture: string;
  stream: string;
}
export interface Output {
  universe: number;
  health: string;
  rate_hz: number;
  frames: number;
  late: number;
  missed: number;
  failed: number;
  jitter_us_p50: number;
  jitter_us_p99: number;
  jitter_us_p999: number;
}
/** What is in the slots of one universe, and whose they are. */
export interface Slots {
  universe: number;
  slots: number[];
  owners: { fixture: string; first: number; last: number }[];
}
/** A look that was found or saved. */
export interface LookEntry {
  id: number;
  name: string;
  mood: string;
  verdict: string;
  created: string;
  live: boolean;
  kept: boolean;
  picture: string;
}
/** What came of learning a lamp. */
export interface Learnt {
  profile: string;
  profile_file: string;
  profile_yaml: string;
  studio_file: string;
  studio_lines: string;
  added: boolean;
}
export interface State {
  version: number;
  studio: { name: string; file: string; ready: boolean; stage: string };
  hand: { connected: boolean; refused: boolean; real_time: boolean };
  caution: string;
  blackout: boolean;
  /** What moves by motor. */
  motion: { stopped: boolean; armed: boolean; axes_waiting: number };
  masters: Values;
  look: Look | null;
  design: Design | null;
  fixtures: Fixture[];
  instructions: (Instruction & { fixture: string })[];
  outputs: Output[];
  cameras: Camera[];
  problems: Problem[];
  can_undo: boolean;
}
export interface Mood {
  name: string;
  title: string;
  sentence: string;
  tags: string[];
  words: string[];
  /** How the sitter is turned, in words; '' = towards the camera. */
  turn: string;
  attainable: boolean;
  own: boolean;
  picture: string;
}

/** Everything the page shows at one moment. */
export interface Scene {
  state: State | null;
  moods: Mood[];
  looks: LookEntry[];
  tab: 'studio' | 'technician';
  /** What the camera saw when the last mood was clicked. */
  before: string;
  /** The photograph that is on its way to the daemon; '' when none is. */
  sending: string;
  connected: boolean;
  /** When the connection was lost, else null. */
  lostSince: number | null;
  /** What the last click was refused for. */
  refusal: Refusal | null;
}
