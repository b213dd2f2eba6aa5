// SPDX-License-Identifier: Apache-2.0
// `npm run dev` serves the page against a running daemon; `npm run build` makes what it serves.
import { defineConfig } from 'vite';

export default defineConfig({
  build: { target: 'es2022', outDir: 'dist', emptyOutDir: true, reportCompressedSize: false },
  server: { proxy: { '/api': { target: 'http://127.0.0.1:8090', ws: true } } },
});
