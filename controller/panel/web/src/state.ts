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
  look: number | null;
  error: Refusal | null;
}
export interface Camera {
  name: string;
  health: 'good' | 'waiting' | 'lost' | 'none';
  picture: string;
  stream: string;
}
export interface Output {
  universe: number;
  health: string;
  rate_hz: number;
  late: number;
}
export interface State {
  version: number;
  studio: { name: string; ready: boolean; stage: string };
  hand: { connected: boolean; refused: boolean; real_time: boolean };
  caution: string;
  blackout: boolean;
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
  attainable: boolean;
  own: boolean;
  picture: string;
}

/** Everything the page shows at one moment. */
export interface Scene {
  state: State | null;
  moods: Mood[];
  connected: boolean;
  /** When the connection was lost, else null. */
  lostSince: number | null;
  /** What the last click was refused for. */
  refusal: Refusal | null;
}
