// SPDX-License-Identifier: Apache-2.0
// What a click does: one door to the daemon, so that every refusal is shown in one place.
import type { Learnt } from './state';

export type Nudge = 'brighter' | 'softer' | 'warmer' | 'contrast';

export interface Actions {
  light(mood: string): void;
  /** A photograph of one's own: kept among the moods, then lit like. */
  lightLike(file: File): void;
  forget(mood: string): void;
  cancel(job: number): void;
  workLight(): void;
  nudge(what: Nudge, stops: number): void;
  undo(): void;
  save(name: string): void;
  recall(look: number): void;
  rename(look: number, name: string): void;
  remove(look: number): void;
  blackout(on: boolean): void;
  motionStop(on: boolean): void;
  placed(fixture: string): void;
  fader(fixture: string, intensity: number): void;
  release(fixture: string): void;
  lock(fixture: string, on: boolean): void;
  measured(fixture: string, reading: Record<string, unknown>): void;
  master(name: string, level: number): void;
  raise(universe: number, levels: Map<number, number>): void;
  learn(lamp: Record<string, unknown>): Promise<Learnt | null>;
  reload(): void;
  show(tab: 'studio' | 'technician'): void;
  dismiss(): void;
  signIn(token: string): void;
}
