// SPDX-License-Identifier: Apache-2.0
// What a click does: one door to the daemon, so that every refusal is shown in one place.

export interface Actions {
  light(mood: string): void;
  lightLike(file: File): void;
  cancel(job: number): void;
  undo(): void;
  blackout(on: boolean): void;
  placed(fixture: string): void;
  fader(fixture: string, intensity: number): void;
  release(fixture: string): void;
  lock(fixture: string, on: boolean): void;
  master(level: number): void;
  dismiss(): void;
  signIn(token: string): void;
}
