// SPDX-License-Identifier: Apache-2.0
// The real programs on the shipped studio: virtual studio, output process and daemon, on ports and
// a universe of their own so that two runs on one machine do not meet.
import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../..', import.meta.url));

export function freePort() {
  return new Promise((found) => {
    const server = createServer();
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => found(port));
    });
  });
}

/** A program that has printed `line`; its output so far is the fault when it ends before that. */
function started(program, args, environment, line) {
  const child = spawn(program, args, { env: { ...process.env, ...environment } });
  let said = '';
  return new Promise((ready, failed) => {
    const hear = (piece) => {
      said += piece;
      const match = line.exec(said);
      if (match) ready({ child, match, output: () => said });
    };
    child.stdout.on('data', hear);
    child.stderr.on('data', hear);
    child.on('error', failed);
    child.on('exit', (code) => failed(new Error(`${program} ended (${code}): ${said}`)));
  });
}

function ended({ child }) {
  return new Promise((gone) => {
    if (child.exitCode !== null || child.signalCode !== null) return gone();
    child.on('exit', gone);
    child.kill('SIGTERM');
  });
}

export async function startStudio(bin, { stagehand = 'never' } = {}) {
  const folder = await mkdtemp(join(tmpdir(), 'chiaro-web-'));
  const cameraPort = await freePort();
  const universe = 1000 + (cameraPort % 60000);
  const yaml = (await readFile(join(root, 'config/studios/portrait.yaml'), 'utf8'))
    .replaceAll('127.0.0.1:8091', `127.0.0.1:${cameraPort}`)
    .replaceAll('universe: 1,', `universe: ${universe},`)
    .replaceAll('universe 1:', `universe ${universe}:`);
  const studio = join(folder, 'studio.yaml');
  await writeFile(studio, yaml);
  const environment = {
    CHIARO_CONFIG: join(root, 'config'),
    CHIARO_STATE: join(folder, 'state'),
    CHIARO_RUNTIME: join(folder, 'runtime'),
  };
  const programs = [];
  const start = async (name, args, line) => {
    const program = await started(join(bin, name), args, environment, line);
    programs.push(program);
    return program;
  };
  const daemonPort = await freePort();
  const daemonUrl = `http://127.0.0.1:${daemonPort}`;
  const starters = {
    simulator: () => start('chiaro-sim', [studio, '--port', cameraPort, '--rate', '5', '--daemon', daemonUrl,
      '--stagehand', stagehand, '--stand-time', '0.1'].map(String), /./),
    hand: () => start('chiaro-output', [studio, '--no-real-time'], /./),
    daemon: () => start('chiarod', [studio, '--port', String(daemonPort)], /panel: (\S+)/),
  };
  const parts = {};
  for (const name of ['simulator', 'hand', 'daemon']) parts[name] = await starters[name]();
  return {
    url: parts.daemon.match[1],
    file: studio,
    universe,
    state: async () => (await fetch(`${daemonUrl}/api/v1/state`)).json(),
    /** `name`: simulator, hand or daemon; at once and without a goodbye. */
    async kill(name) {
      const { child } = parts[name];
      child.removeAllListeners('exit');
      const gone = new Promise((done) => child.once('exit', done));
      child.kill('SIGKILL');
      await gone;
    },
    async restart(name) {
      parts[name] = await starters[name]();
    },
    output: () => programs.map((program) => program.output()).join('\n'),
    async stop() {
      for (const program of programs.reverse()) {
        program.child.removeAllListeners('exit');
        await ended(program);
      }
      await rm(folder, { recursive: true, force: true });
    },
  };
}
